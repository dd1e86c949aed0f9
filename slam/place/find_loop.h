#pragma once

#include <optional>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/optimize/adjust_map.h"
#include "slam/place/place_index.h"
#include "slam/place/place_options.h"

namespace aisle::slam {

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
