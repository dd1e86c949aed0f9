#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace aisle {

/// Writes PNG or JPEG by the name's ending, aside and renamed. Throws MachineError.
void WriteImage(const std::filesystem::path& path, const cv::Mat& image);

/// An 8-bit grey PNG; the size is read from its header before anything is decoded. Throws
/// InputError when it is no PNG, is not grey, or is larger than 16384 pixels either way.
cv::Mat1b ReadGreyPng(const std::filesystem::path& path);

}  // namespace aisle
