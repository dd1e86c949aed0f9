#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace aisle {

/// A rectified stereo rig. Camera: x right, y down, z forward; rig = left camera; the right camera
/// stands at (+baseline, 0, 0). The centre of pixel (0, 0) is u = 0, v = 0.
struct StereoCalibration {
  int width = 0, height = 0;              ///< pixels
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  double baseline_m = 0;
};

/// How the rig has moved since the frame before, by other means than images: wheels, say.
struct MotionMeasurement {
  Eigen::Isometry3d T_now_before = Eigen::Isometry3d::Identity();  ///< of the rig
  /// Of a small motion of the rig's frame now: translation (m), then rotation (rad).
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Identity();
};

/// All that a SLAM may see of one instant.
struct StereoFrame {
  std::int64_t id = 0;
  std::int64_t stamp_ns = 0;
  cv::Mat1b left, right;                         ///< 8-bit grey
  std::optional<MotionMeasurement> motion = {};  ///< where the system is told; not of the first
};

/// What truth says of one person, vehicle or mechanism in the left image.
struct ObjectTruth {
  int instance = 0;
  std::string object_class;
  cv::Rect2d box_visible;                              ///< pixels; encloses the pixels that show it
  cv::Rect2d box_full;                                 ///< pixels; as if nothing stood in front
  Eigen::Vector3d center_m = Eigen::Vector3d::Zero();  ///< of the 3-D box, world
  Eigen::Vector3d extent_m = Eigen::Vector3d::Zero();  ///< full sizes of that box along its axes
  Eigen::Isometry3d T_world_object = Eigen::Isometry3d::Identity();  ///< z up, x ahead
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();            ///< world
  double visible_fraction = 0;                                       ///< in [0, 1]
  int visible_pixels = 0;
  int dynamic_pixels = 0;  ///< of them, on a surface that moves now
};

/// Exact truth at the stamp, left camera unless said otherwise. Images may be empty where a source
/// (recorded data) does not know them.
struct FrameTruth {
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
  double smear_ms =
      0;            ///< time over which the exposure draws motion out; 0: an instant, or unknown
  cv::Mat1f depth;  ///< z in metres, inf where nothing was hit
  /// The same at every 16th pixel of every 16th row: what a stored frame keeps of it.
  cv::Mat1f depth_grid;
  cv::Mat1w instance;  ///< 0 where nothing was hit
  cv::Mat1f depth_right;
  cv::Mat1w instance_right;
  /// 255 where the pixel's surface moves in the world now: at some time of the exposure around the
  /// stamp it is faster than the scene's threshold.
  cv::Mat1b dynamic;
  cv::Mat1b dynamic_right;
  cv::Mat1b actor;  ///< 255 on people, vehicles and mechanisms, moving or not
  cv::Mat1b actor_right;
  std::vector<ObjectTruth> objects;
};

/// Pixels an estimator is told to reject, 255 = reject; empty = none. Not truth by itself: the
/// harness makes it from truth for `oracle` and `semantic`, or reads it from files.
struct ExternalMask {
  cv::Mat1b left, right;
  /// How far each left pixel is trusted: 255 fully, 0 hardly at all; empty = fully everywhere.
  cv::Mat1b confidence = {};
};

}  // namespace aisle
