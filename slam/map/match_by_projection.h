#pragma once

#include <optional>
#include <span>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/map/map_options.h"

namespace aisle::slam {

/// A landmark and where in a frame it is looked for.
struct Expected {
  const Landmark* landmark = nullptr;
  Eigen::Vector3d uvd = Eigen::Vector3d::Zero();  ///< predicted pixel and disparity
  int level = 0;                                  ///< predicted pyramid level
};

struct Match {
  LandmarkId landmark;
  int feature = -1;
  int distance = 0;  ///< bits
};

/// Where a camera at `T_rig_world` should see the landmark, or nothing where it should not: behind
/// or beyond the image, from too far aside, or too near or far for its size.
std::optional<Expected> Expect(const Landmark& landmark, const StereoCamera& camera,
                               const Eigen::Isometry3d& T_rig_world, double scale, int levels);

/// Those of the landmarks that it should see, in the same order.
std::vector<Expected> ExpectAll(std::span<const Landmark* const> landmarks,
                                const StereoCamera& camera, const Eigen::Isometry3d& T_rig_world,
                                double scale, int levels);

/// Matches landmarks to features of `frame` near where they are expected. A feature goes to the
/// landmark nearest in description (the earlier in the list on a tie). By rising feature.
std::vector<Match> MatchByProjection(const Frame& frame, std::span<const Expected> expected,
                                     const MatchOptions& options);

}  // namespace aisle::slam
