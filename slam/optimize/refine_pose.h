#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "slam/camera/se3.h"
#include "slam/camera/stereo_camera.h"
#include "slam/map/frame.h"

namespace aisle::slam {

/// A known point and where it is seen.
struct PointObservation {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< metres, world
  Measurement measurement;
};

/// Squared error in units of its variance; infinite behind the camera.
double Chi2(const StereoCamera& camera, const Eigen::Isometry3d& T_rig_world,
            const PointObservation& observation);

/// Where the rig stands as far as something else than these observations says.
struct PosePrior {
  Eigen::Isometry3d T_rig_world = Eigen::Isometry3d::Identity();
  Matrix6d information = Matrix6d::Zero();  ///< of a small motion of the rig frame
};

struct RefinePoseOptions {
  int rounds = 4;       ///< outliers are told apart anew after each; the last is not robustified
  int iterations = 10;  ///< Levenberg-Marquardt steps a round
  bool trust_start = false;  ///< outliers are told apart at the starting pose too, first of all
  bool start_anew = false;   ///< every round from the starting pose, or from where the last ended
  std::optional<PosePrior> prior = {};  ///< counts as one more observation, never an outlier
};

/// A pose and how it came about.
struct RefinedPose {
  Eigen::Isometry3d T_rig_world = Eigen::Isometry3d::Identity();
  std::vector<bool> inlier;  ///< per observation
  int inliers = 0;
  bool well_posed = false;  ///< whether the inliers fix all six degrees of freedom
  /// Of a small motion of the rig frame (translation metres, rotation radians; see Retract).
  Matrix6d covariance = Matrix6d::Zero();
};

/// The pose that minimises the reprojection error of known points, robust against outliers
/// (Huber 1964 weights at first, then chi-square gates that every observation may pass again).
RefinedPose RefinePose(const StereoCamera& camera, const Eigen::Isometry3d& T_rig_world,
                       const std::vector<PointObservation>& observations,
                       const RefinePoseOptions& options);

}  // namespace aisle::slam
