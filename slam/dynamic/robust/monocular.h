#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/robust/dense_frame.h"

// What only the left camera sees as yet: who enters from the left has no disparity. While the rig
// stands or turns about its left camera, the flow of what is static is the same at any distance,
// and tells who moves. About the camera: on the way the camera may move by no more than about one
// hundredth of the baseline (1.2 mm with the default rig), which a rig that turns about another
// point, as a vehicle does about its axle, soon exceeds.

namespace aisle::slam::dynamic {

/// How many pixels of a row, from the left on, may lie beyond the right image: up to the first run
/// of known disparities, single ones being chance matches. 0 in a row that knows of none.
int MonocularColumns(const float* disparity, int columns);

/// The disparities of a frame; and in its monocular columns, where none is known and any would do
/// (the expected place changes by a pixel at most from far to near), the one with which the pixel
/// is static most nearly: of the places on its epipolar line the closest to where the flow leads,
/// in the metric of the texture. `expected`, by the filled disparities, becomes that of these
/// pixels, whatever their disparity.
cv::Mat1f ExplainMonocular(const DenseFrame& now, const cv::Mat2f& flow, const Texture& texture,
                           StaticField* expected);

}  // namespace aisle::slam::dynamic
