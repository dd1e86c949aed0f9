#pragma once

#include <optional>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/common/option_fields.h"
#include "slam/optimize/adjust_map.h"
#include "slam/optimize/align_points.h"
#include "slam/place/place_index.h"

namespace aisle::slam {

/// When a place counts as seen before.
struct LoopOptions {
  int candidates = 3;             ///< keyframes looked at closely, most alike first
  int recent_keyframes = 10;      ///< the newest ones are no loop
  double similarity_ratio = 0.8;  ///< of the similarity to the least alike neighbour
  int descriptor_distance = 50;   ///< bits
  double descriptor_ratio = 0.8;  ///< best to second best
  AlignPointsOptions align;       ///< the pose between the two keyframes
  int least_inliers = 40;         ///< landmarks of the old place that the new view confirms
  double radius_px = 8;           ///< search for those, pixels of the predicted level
  /// Loops that must tell the same correction before it is made, and the landmarks that they must
  /// confirm together: three loops that just suffice, or two clear ones.
  int consistent_loops = 2, consistent_inliers = 120;
  int neighbours = 3;            ///< keyframes before the newest that are asked for its loop, ...
  int neighbour_shared = 30;     ///< ... of those that share so many landmarks with it
  int pending_keyframes = 10;    ///< keyframes after which an unconfirmed loop is forgotten
  double consistency_m = 0.1;    ///< translation by which two corrections may differ
  double consistency_deg = 1.0;  ///< rotation by which two corrections may differ
  double drift_share = 0.02;     ///< of the path in between: no correction may be larger, ...
  double drift_m = 0.3;          ///< ... this aside: racks that look alike stand further apart
  LoopSpreadOptions spread;      ///< of a correction that is made
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, LoopOptions& options);

/// Where keyframe `matched` sees keyframe `current`: found from their features alone, then
/// confirmed by the landmarks around the old place. Nothing if the two do not show one place.
std::optional<LoopEdge> VerifyLoop(const Map& map, KeyframeId current, KeyframeId matched,
                                   const StereoCamera& camera, int levels,
                                   const LoopOptions& options);

/// The best verified loop of a keyframe that the index does not contain yet.
std::optional<LoopEdge> FindLoop(const Map& map, KeyframeId current, const WordVector& words,
                                 const PlaceIndex& index, const StereoCamera& camera, int levels,
                                 const LoopOptions& options);

/// The place of `loop` as the last keyframes before its current one see it, those that do. Asked at
/// once, as Campos et al. (ORB-SLAM3, 2021) do: a rig that stops where it has been before takes no
/// further keyframe that could agree.
std::vector<LoopEdge> SeenBeside(const Map& map, const LoopEdge& loop, const StereoCamera& camera,
                                 int levels, const LoopOptions& options);

/// Whether the two ends of a loop stand in one place already: they see the same, or each the same
/// as a third does. Then it has nothing to close.
bool IsOnePlace(const Map& map, const LoopEdge& loop);

/// The loops that agree with the newest one (pairwise consistency), itself included, or none where
/// they, or the landmarks they confirm, are too few or ask for more than odometry can have drifted.
std::vector<LoopEdge> AgreeingLoops(const Map& map, const std::vector<LoopEdge>& loops,
                                    const LoopOptions& options);

}  // namespace aisle::slam
