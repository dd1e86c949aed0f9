#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

namespace aisle::slam {

/// For each pixel of an image, which of the 24 others of its 5x5 window are darker than it: a
/// census transform (Zabih and Woodfill 1994), which neither gain nor offset of a camera changes.
/// Eight of the bits in each plane. The image's border is repeated.
using CensusPlanes = std::array<cv::Mat1b, 3>;
CensusPlanes CensusTransform(const cv::Mat1b& image);

/// What it costs to say that a left pixel has a disparity: how many bits of the census differ, over
/// 3x3 pixels, a quarter of it: 0 to 54. Costs of the rows from `top` up to, not including,
/// `bottom`: rows * columns * disparities numbers, disparities (0 to disparities - 1, a multiple of
/// 32) innermost. Beyond the left edge of the right image its first column is repeated, beyond the
/// edges of a window its border.
void CensusCosts(const CensusPlanes& left, const CensusPlanes& right, int top, int bottom,
                 int disparities, std::uint8_t* costs);

}  // namespace aisle::slam
