#pragma once

#include <filesystem>
#include <initializer_list>
#include <string_view>

namespace aisle::slam {

/// Writes the parts, one after the other, into a file beside `file`, flushes it to the disk and
/// renames it: under `file` stands what was there before or the whole new one, and nothing lies
/// beside it, whatever fails. Throws std::runtime_error that names the file and the reason.
void WriteAside(const std::filesystem::path& file, std::initializer_list<std::string_view> parts);

}  // namespace aisle::slam
