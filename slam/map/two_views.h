#pragma once

#include <optional>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"

namespace aisle::slam {

/// Two keyframes and how one lies to the other: what placing points by both of them looks at.
struct TwoViews {
  const Keyframe& here;
  const Keyframe& there;
  const StereoCamera& camera;
  Eigen::Isometry3d T_there_here;

  const Measurement& Here(std::size_t i) const { return here.frame->measurements[i]; }
  const Measurement& There(std::size_t i) const { return there.frame->measurements[i]; }
};

/// The direction of a feature from its rig, z = 1.
Eigen::Vector3d RayOf(const StereoCamera& camera, const Measurement& measurement);

/// Features that name no landmark, those in `used` left out.
std::vector<std::size_t> FreeFeatures(const Keyframe& keyframe, const std::vector<bool>& used);

/// A feature there that may be met on an epipolar line: what every test of it asks for.
struct LineCandidate {
  std::size_t feature;
  Eigen::Vector3d ray;
  double variance_px;
  int level;
};
std::vector<LineCandidate> CandidatesOf(const TwoViews& views,
                                        const std::vector<std::size_t>& features);

/// The candidate that looks most like feature `i` here and lies on its epipolar line: within
/// `distance` bits and at most `ratio` times as far as the second best there.
std::optional<std::size_t> BestOnLine(const TwoViews& views, std::size_t i,
                                      const std::vector<LineCandidate>& candidates, int distance,
                                      double ratio);

/// The sine of the angle between two unit rays, both as seen from here, and the point nearest to
/// both of them (the midpoint of Hartley and Sturm 1997).
struct Intersection {
  double sine = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< metres, rig here; undefined if parallel
};
Intersection Intersect(const TwoViews& views, std::size_t i, std::size_t j);

/// Whether a measurement agrees with a point before its rig (metres), disparity included: 95 % of
/// chi-square.
bool Agrees(const StereoCamera& camera, const Eigen::Vector3d& in_rig,
            const Measurement& measurement);

/// Whether the levels of two features fit a point so far from either rig: what is nearer is seen
/// larger, at a higher level.
bool SizesFit(const TwoViews& views, std::size_t i, std::size_t j, double distance_here,
              double distance_there);

}  // namespace aisle::slam
