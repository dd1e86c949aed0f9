#pragma once

#include "slam/camera/stereo_camera.h"
#include "slam/common/option_fields.h"
#include "slam/map/map.h"

namespace aisle::slam {

struct FuseOptions {
  int neighbours = 10;           ///< keyframes, most covisible first
  int least_shared = 15;         ///< landmarks; fewer make no neighbours
  double radius_px = 3;          ///< search radius in pixels of the predicted level
  int descriptor_distance = 50;  ///< bits; no match beyond
  int levels = 8;                ///< of the pyramid; set from the feature options
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, FuseOptions& options);

/// How near a landmark must come to a feature that it is fused into.
enum class FuseBound {
  kRadius,  ///< that of the search: where poses are not that exact, as those beside a loop
  kChi2,    ///< 95 % of chi-square besides, as neighbours that were adjusted together keep
};

/// Looks for the landmarks of `candidates` in keyframe `in`: where one lands on a free feature the
/// two are linked, where it lands on another landmark's feature the two become one (the better
/// observed is kept).
MapEdit FuseInto(const Map& map, KeyframeId in, const std::vector<LandmarkId>& candidates,
                 const StereoCamera& camera, const FuseOptions& options, FuseBound bound);

/// Keyframes to exchange landmarks with: the most covisible ones.
std::vector<KeyframeId> FuseNeighbours(const Map& map, KeyframeId id, const FuseOptions& options);

}  // namespace aisle::slam
