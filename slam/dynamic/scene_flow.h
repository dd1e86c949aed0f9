#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/ego_motion.h"
#include "slam/dynamic/point_tracks.h"
#include "slam/dynamic/robust_options.h"

namespace aisle::slam::dynamic {

/// The rig's motion over one gap.
struct GapMotion {
  int gap = 1;  ///< frames
  EgoMotion motion;
  MeasurementNoise noise;  ///< of one measurement, as this gap sees it
};

/// Squared error in units of variance of a point that is taken to be static, three degrees of
/// freedom: r = now - h(T, before), its covariance propagated from both measurements (whose noise
/// grows with the displacement) and from the motion's own. Infinite where the point would be behind
/// the camera.
double SceneFlowChi2(const StereoCamera& camera, const GapMotion& gap,
                     const Eigen::Vector3d& before, const Eigen::Vector3d& now,
                     double noise_per_displacement);

/// Log-odds of moving from that value: a static point has a normal error, a mover any error within
/// what movers do in the image. Unbounded; positive from about 4 deviations on.
double MotionLogOdds(double chi2, const MeasurementNoise& noise);

/// Evidence of every track from all gaps: the largest if any speaks of motion, else the mean of
/// those known, each within the options' limits; 0 for tracks without a past.
std::vector<double> PointEvidence(const std::vector<PointTrack>& tracks, const StereoCamera& camera,
                                  const std::vector<GapMotion>& gaps,
                                  const EvidenceOptions& options);

/// Noise of u, v and disparity from the absolute errors of tracks over a gap under its
/// motion; nothing with fewer than 20 of them. Only tracks that have not been found moving count.
std::optional<MeasurementNoise> MeasureNoise(const std::vector<PointTrack>& tracks,
                                             const StereoCamera& camera, int gap,
                                             const Eigen::Isometry3d& T_now_before);

}  // namespace aisle::slam::dynamic
