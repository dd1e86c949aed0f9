#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace aisle {

/// Where the folder is a recording itself, that and what to do; else empty. Its YAML files are none
/// of ours.
std::string WhatRecording(const std::filesystem::path& folder);

/// The YAML files below a folder, in the order of their names; recordings there are left out, and,
/// told, what is no file of ours.
std::vector<std::string> FilesBelow(const std::string& folder);

}  // namespace aisle
