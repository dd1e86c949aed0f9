#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace aisle::sim {

/// A real camera as its calibration states it. The centre of pixel (0, 0) is u = v = 0.
struct CameraModel {
  int width = 0, height = 0;  ///< pixels; 0 where the file does not say
  double fx = 0, fy = 0, cx = 0, cy = 0;
  /// k1 k2 p1 p2 (k3 (k4 k5 k6)), or an equidistant lens's k1 k2 k3 k4; empty: a pinhole.
  std::vector<double> distortion = {};
  bool equidistant = false;
};

/// A stereo rig as built: two cameras that are neither equal nor quite parallel.
struct StereoModel {
  CameraModel left, right;
  Eigen::Isometry3d T_right_left = Eigen::Isometry3d::Identity();
  /// What the file itself says of each eye's rectification: the turn from the camera as built, and
  /// the projection of the rectified one, whose last column begins with -fx * baseline on the
  /// right.
  struct Stated {
    Eigen::Matrix3d R_rectified_camera = Eigen::Matrix3d::Identity();
    Eigen::Matrix<double, 3, 4> projection = Eigen::Matrix<double, 3, 4>::Zero();
  };
  std::optional<std::array<Stated, 2>> stated = {};
};

/// A stereo rig in one of five dialects, told from what the files hold:
///   Kalibr's camchain (one file), camera_info as YAML (left, right), OpenCV's stereo calibration
///   (intrinsics and extrinsics, or both in one), EuRoC's sensor.yaml (left, right), KITTI's
///   calib.txt (P0 and P1, rectified).
/// Throws std::runtime_error, "file: key: what is wrong and what is expected", also for a baseline
/// that is not metres or has the wrong sign, for a turn that is none or mirrors, and for a size
/// that no image has.
StereoModel ReadStereoModel(const std::vector<std::string>& files);

/// The rectified pair of a rig: what a stereo SLAM sees of it.
struct RectifiedPair {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double baseline_m = 0;
};
/// As stated, else by cv::stereoRectify with alpha 0, which throws std::runtime_error where it
/// cannot; of absurd lenses it may also be absurd, or nan. The sizes must be known. Both eyes have
/// the left one's pinhole: where the right one's is stated to differ (OpenCV without
/// CALIB_ZERO_DISPARITY), its picture is that of the left one's pinhole in its place.
RectifiedPair Rectified(const StereoModel& model);

}  // namespace aisle::sim
