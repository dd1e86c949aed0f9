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

/// Says where points appear in a camera's image.
class Projection {
 public:
  explicit Projection(const StereoCamera& camera)
      : camera_(camera), widest_(WidestRay(camera.lens)) {}

  /// The pixel of a point of the camera's frame (metres, z > 0), inside the image or not; none
  /// where the lens shows no such ray, or would show it where another one is.
  std::optional<Eigen::Vector2d> operator()(const Eigen::Vector3d& point_camera) const;

 private:
  StereoCamera camera_;
  double widest_;
};

}  // namespace aisle::sim
