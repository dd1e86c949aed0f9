#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "slam/camera/measured_motion.h"
#include "slam/camera/se3.h"
#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {

/// A point measured in two frames, each time as (u, v, disparity) in pixels.
struct StereoMatch {
  Eigen::Vector3d before, now;
  double weight = 1;  ///< how far it is trusted to be static, 0 to 1
};

/// Deviations of u, v and disparity of one measurement, pixels.
using MeasurementNoise = Eigen::Vector3d;

/// Where the rig is expected to have moved, and how far it may deviate (metres, radians).
struct MotionPrior {
  Eigen::Isometry3d T_now_before = Eigen::Isometry3d::Identity();
  double sigma_m = 0.01, sigma_rad = 0.01;
  /// Of a small motion of the current frame, where the motion has been measured: it is one more
  /// observation then, and stands where the images show too little.
  std::optional<Matrix6d> information = {};
};

/// What is known beforehand of the rig's motion since the last frame.
struct KnownMotion {
  std::optional<Eigen::Isometry3d> predicted = {};  ///< T_now_before, as the rig has moved before
  std::optional<MeasuredMotion> measured = {};
};

struct EgoMotion {
  bool found = false;
  bool standing = false;  ///< standing still explains the points as well: the motion is identity
  Eigen::Isometry3d T_now_before = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< of a small motion of the current frame, see Retract
  double support = 0;                      ///< summed weight of the matches within the gate
};

/// Squared error of a match under a motion in units of the noise of its two measurements.
double MatchChi2(const StereoCamera& camera, const Eigen::Isometry3d& T_now_before,
                 const StereoMatch& match, const MeasurementNoise& noise);

/// The motion of the rig between two frames from stereo points: candidates are the prediction,
/// standing still and three-point samples; the one with most trust behind it wins, discounted where
/// a vehicle could not do it, so a crowd that moves as one does not become the world (RANSAC,
/// Fischler and Bolles 1981). Refined by robust least squares (Geman and McClure 1985).
EgoMotion EstimateEgoMotion(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                            const std::optional<MotionPrior>& prior, const MeasurementNoise& noise,
                            const EgoMotionOptions& options);

/// Only the last step of the refinement, from a motion known to be close.
EgoMotion RefineEgoMotion(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                          const Eigen::Isometry3d& T_now_before, const MeasurementNoise& noise);

/// Noise of u, v and disparity of one measurement, from the errors that a motion leaves to matches
/// trusted to be static by more than half: of their body, tails of bad ones included as far as a
/// quarter of them allows. Nothing with fewer than 20.
std::optional<MeasurementNoise> MeasureNoise(const std::vector<StereoMatch>& matches,
                                             const StereoCamera& camera,
                                             const Eigen::Isometry3d& T_now_before);

}  // namespace aisle::slam::dynamic
