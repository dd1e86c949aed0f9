#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "simulator/camera/lens.h"

namespace aisle::sim {

enum class StereoSide { kLeft = 0, kRight = 1 };

/// A stereo pair of parallel, equal cameras. Camera frame: x right, y down, z forward; the rig
/// frame is the left camera's; the right camera stands at (+baseline, 0, 0) in it. The centre of
/// pixel (0, 0) is u = 0, v = 0, as in OpenCV. With a pinhole lens the pair is rectified.
struct StereoCamera {
  int width = 752;                                        ///< pixels
  int height = 480;                                       ///< pixels
  double fx = 435.2, fy = 435.2, cx = 367.2, cy = 252.2;  ///< pixels
  double baseline_m = 0.12;
  Lens lens = {};
};

/// The pixel where a point of the camera's frame (metres, z > 0) appears, inside the image or not.
Eigen::Vector2d Project(const StereoCamera& camera, const Eigen::Vector3d& point_camera);

}  // namespace aisle::sim
