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

/// Where the rig is expected to have moved: as its wheels measure, or as its inertia carries it on.
/// One more observation beside the images, which stands where those show too little.
struct MotionPrior {
  Eigen::Isometry3d T_now_before = Eigen::Isometry3d::Identity();
  Matrix6d covariance = 1e-4 * Matrix6d::Identity();  ///< of a small motion of the current frame
  bool measured = false;  ///< the images may make it better, but not say something else
  /// What a jolt may add to the covariance, as a sill gives it that wheels go over; zero: no jolts.
  Matrix6d jolt = Matrix6d::Zero();
};

/// Whether the rig can have moved so, as far as a prior tells (99.99 % of chi-square).
bool IsPossible(const Eigen::Isometry3d& T_now_before, const MotionPrior& prior);

/// What is known beforehand of the rig's motion since the last frame.
struct KnownMotion {
  std::optional<MeasuredMotion> expected = {};  ///< as its inertia carries it on
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

/// The motion of the rig between two frames from stereo points: candidates are the prior,
/// standing still and three-point samples; of those that a vehicle can do after what it did
/// before, the one with most trust behind it wins, so a crowd that moves as one does not become the
/// world (RANSAC, Fischler and Bolles 1981). Refined by robust least squares (Geman and McClure
/// 1985). Where no more than half of the trust is behind that and a jolt explains more than half,
/// it was a jolt; the prior itself where nothing is possible.
EgoMotion EstimateEgoMotion(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                            const std::optional<MotionPrior>& prior, const MeasurementNoise& noise,
                            const EgoMotionOptions& options);

/// Only the last step of the refinement, from a motion known to be close.
EgoMotion RefineEgoMotion(const std::vector<StereoMatch>& matches, const StereoCamera& camera,
                          const Eigen::Isometry3d& T_now_before, const MeasurementNoise& noise);

/// Noise of u, v and disparity of one measurement, from the errors that a motion leaves to matches
/// trusted to be static by half or more: of their body, tails of bad ones included as far as a
/// quarter of them allows. Nothing with fewer than 20.
std::optional<MeasurementNoise> MeasureNoise(const std::vector<StereoMatch>& matches,
                                             const StereoCamera& camera,
                                             const Eigen::Isometry3d& T_now_before);

}  // namespace aisle::slam::dynamic
