#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "simulator/camera/stereo_camera.h"

namespace aisle::sim {

/// The ray of every pixel of a camera: direction (x, y, 1) in the camera frame, row-major. Because
/// z is 1, the parameter t of a hit along the direction is its depth z in metres.
struct PixelRays {
  int width = 0, height = 0;     ///< pixels
  float step_x = 0, step_y = 0;  ///< change of x per column, of y per row, at the optical axis
  std::vector<float> x, y;       ///< width·height each, then kPadding zeros

  static constexpr std::size_t kPadding = 8;  ///< so that a packet may start at any pixel
};

/// The rays through the pixel centres of a rectified camera: x = (u - cx) / fx, y = (v - cy) / fy.
PixelRays MakePixelRays(const StereoCamera& camera);

/// Where one eye stands: T_world_eye of the pair whose rig (left eye) is at `T_world_rig`.
Eigen::Isometry3d EyePose(const StereoCamera& camera, const Eigen::Isometry3d& T_world_rig,
                          Eye eye);

}  // namespace aisle::sim
