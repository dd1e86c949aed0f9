#pragma once

#include "slam/stereo/patch_alignment.h"

namespace aisle::slam {

/// As AlignAlongRow, as ORB-SLAM2 (Mur-Artal and Tardos 2017) has it: whole columns by the least
/// sum of absolute differences, each patch less its central pixel, then the lowest point of the
/// parabola through the best column's sum and its neighbours'. Cheaper, and drawn towards whole
/// columns. `sigma` is zero: nothing is known of it.
std::optional<RowAlignment> AlignByParabola(const cv::Mat1b& left, cv::Point2d left_pixel,
                                            const cv::Mat1b& right, double right_column,
                                            const StereoOptions& options);

}  // namespace aisle::slam
