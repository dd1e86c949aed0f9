#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/map/map_options.h"

namespace aisle::slam {

/// How near a landmark must come to a feature that it is fused into.
enum class FuseBound {
  kRadius,  ///< that of the search: where poses are not that exact, as those beside a loop
  kChi2,    ///< 95 % of chi-square besides, as neighbours that were adjusted together keep
};

/// Looks for the landmarks of `candidates` in keyframe `in`: where one lands on a free feature the
/// two are linked, where it lands on another landmark's feature the two become one (the better
/// observed is kept). `levels` are those of the pyramids.
MapEdit FuseInto(const Map& map, KeyframeId in, const std::vector<LandmarkId>& candidates,
                 const StereoCamera& camera, int levels, const FuseOptions& options,
                 FuseBound bound);

/// Keyframes to exchange landmarks with: the most covisible ones.
std::vector<KeyframeId> FuseNeighbours(const Map& map, KeyframeId id, const FuseOptions& options);

}  // namespace aisle::slam
