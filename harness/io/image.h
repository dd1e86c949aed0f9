#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace aisle {

/// Writes PNG, JPEG, PFM or OpenEXR (colours as B, G, R) by the name's ending, aside and renamed.
/// Throws MachineError.
void WriteImage(const std::filesystem::path& path, const cv::Mat& image);

/// Writes a PFM of three channels: the vectors' first, second and third numbers, in this order (as
/// colours OpenCV would turn them round). Throws MachineError.
void WriteVectorPfm(const std::filesystem::path& path, const cv::Mat3f& vectors);

/// Throws InputError for a file that a picture cannot be written to by its ending, which must be
/// PNG's or JPEG's: asked before the picture is made.
void CheckImageName(const std::filesystem::path& path);

/// A PNG as 8-bit grey: colours are weighed as the eye does, 16 bits lose their lower byte. The
/// size is read from its header before anything is decoded. Throws InputError when it is no PNG, is
/// larger than 16384 pixels either way, or has an index beyond its palette.
cv::Mat1b ReadGreyPng(const std::filesystem::path& path);

/// A mask of any PNG: 255 where a pixel is not black, 0 else. Grey (8 or 16 bits), colours, and
/// palettes as DAVIS has them, whose entry 0 is black. Throws InputError as ReadGreyPng does.
cv::Mat1b ReadMaskPng(const std::filesystem::path& path);

/// A PFM or OpenEXR image of three channels: linear, B, G, R. Throws InputError.
cv::Mat3f ReadLinearImage(const std::filesystem::path& path);

}  // namespace aisle
