#pragma once

#include <Eigen/Core>
#include <string>

namespace aisle::slam {

/// A rectified stereo rig as the SLAM sees it. Camera frame: x right, y down, z forward; the rig
/// frame is the left camera's. The centre of pixel (0, 0) is u = 0, v = 0.
struct StereoCamera {
  int width = 752, height = 480;                          ///< pixels
  double fx = 435.2, fy = 435.2, cx = 367.2, cy = 252.2;  ///< pixels
  double baseline_m = 0.12;  ///< the right camera stands at (+baseline, 0, 0) of the left

  bool operator==(const StereoCamera&) const = default;
};

/// The first broken rule with its value, or an empty string.
std::string Validate(const StereoCamera& camera);

/// A point in front of the rig (metres, rig frame, z > 0) as the rig measures it: (u, v) in the
/// left image and the disparity u_left - u_right, all in pixels.
///
/// Disparity space rather than two columns: the error of where a corner was found moves both
/// columns together, so u and disparity are (nearly) independent while u_left and u_right are not.
Eigen::Vector3d Project(const StereoCamera& camera, const Eigen::Vector3d& point);

/// Metres before the rig. A nearer point is not looked for and says nothing of a motion: its
/// disparity is wider than the images of a usual rig, and a step of a millimetre moves it by
/// pixels.
inline constexpr double kNearestVisible_m = 0.05;

/// Metres before the rig. A nearer point is not believed where it has been computed, placed by two
/// views or carried from one to another: of what is so near a usual rig's two images share a part
/// alone, so that none has been measured well from there.
inline constexpr double kNearestTrusted_m = 0.1;

/// The inverse of Project; needs a positive disparity.
Eigen::Vector3d Backproject(const StereoCamera& camera, const Eigen::Vector3d& uvd);

/// The derivative of Project with respect to the point: rows u, v, disparity.
Eigen::Matrix3d ProjectionJacobian(const StereoCamera& camera, const Eigen::Vector3d& point);

/// Depth along z (metres) of a disparity (pixels, > 0).
inline double DepthOf(const StereoCamera& camera, double disparity) {
  return camera.fx * camera.baseline_m / disparity;
}

/// Whether (u, v) lies on a pixel of the left image.
inline bool InImage(const StereoCamera& camera, double u, double v) {
  return u >= 0 && v >= 0 && u <= camera.width - 1 && v <= camera.height - 1;
}

}  // namespace aisle::slam
