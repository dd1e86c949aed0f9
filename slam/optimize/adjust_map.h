#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/optimize/bundle.h"
#include "slam/optimize/optimize_options.h"

namespace aisle::slam {

/// What an adjustment asks of the map.
struct Adjustment {
  MapEdit edit;  ///< poses, positions, and cuts of outliers
  BundleSummary summary;
};

/// Adjusts the surroundings of a keyframe; keyframes further out hold them in place, and where
/// those see fewer than kLeastCovisible of the landmarks the oldest of the surroundings does as
/// well. Outliers are told apart after a robust pass, tested again after the final one, and cut.
Adjustment AdjustLocally(const Map& map, KeyframeId around, const StereoCamera& camera,
                         const LocalAdjustmentOptions& options);

/// Adjusts every keyframe but the roots of the map's parts, and every landmark. What shares fewer
/// than kLeastCovisible landmarks with the rest of its part (keyframes made by wheels alone lie in
/// between) keeps its place to the keyframe that its oldest one was tracked from.
Adjustment AdjustGlobally(const Map& map, const StereoCamera& camera,
                          const GlobalAdjustmentOptions& options);

/// A place seen again: where keyframe `current` stands, seen from `matched`.
struct LoopEdge {
  KeyframeId current, matched;
  Eigen::Isometry3d T_matched_current = Eigen::Isometry3d::Identity();
  int inliers = 0;
};

/// Where the loop says the current keyframe ought to be, seen from where it is: T_new_old.
Eigen::Isometry3d Correction(const Map& map, const LoopEdge& loop);

/// Moves keyframes and every landmark that they see by T_new_old, a motion of the world.
MapEdit MoveRigidly(const Map& map, const std::vector<KeyframeId>& keyframes,
                    const Eigen::Isometry3d& T_new_old);

/// Makes one of the two parts of the map that a loop connects: the younger one moves as a whole to
/// where the loop says it is. Nothing where both ends are of one part.
MapEdit JoinParts(const Map& map, const LoopEdge& loop);

/// Spreads the error of loops over the essential graph (Mur-Artal et al. 2015, III-E): spanning
/// tree, strong covisibility, loops that were closed before, and these. Landmarks move with the
/// first keyframe that saw them.
MapEdit SpreadLoops(const Map& map, const std::vector<LoopEdge>& loops,
                    const LoopSpreadOptions& options);

}  // namespace aisle::slam
