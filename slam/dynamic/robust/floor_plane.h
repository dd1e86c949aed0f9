#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/robust/disparity_tolerance.h"

namespace aisle::slam::dynamic {

/// A plane of disparity: d = x_slope * x + y_slope * y + offset, as equation (8).
struct FloorPlane {
  float x_slope = 0, y_slope = 0, offset = 0;
  float At(int x, int y) const {
    return x_slope * static_cast<float>(x) + y_slope * static_cast<float>(y) + offset;
  }
};

/// The level plane in the lower half of the image that most measurements lie on and few below, by
/// RANSAC (Fischler and Bolles 1981) as v-disparity has it (Labayrade et al. 2002); nothing if it
/// has too few of them. A back close by is a plane as well, but no camera of a vehicle is pitched
/// so far that it were level; a belly is level in parts, and near in all of them. `camera` is that
/// of the disparity.
std::optional<FloorPlane> FindFloor(const cv::Mat1f& disparity, const StereoCamera& camera,
                                    const DisparityTolerance& tolerance);

/// 255 where the (filled) disparity lies on the floor: what touches it there does not belong to it.
cv::Mat1b FloorMask(const cv::Mat1f& filled, const std::optional<FloorPlane>& floor,
                    const DisparityTolerance& tolerance);

}  // namespace aisle::slam::dynamic
