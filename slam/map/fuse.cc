#include "slam/map/fuse.h"

#include <algorithm>

#include "slam/map/landmarks_of.h"
#include "slam/map/match_by_projection.h"
#include "slam/map/two_views.h"

namespace aisle::slam {
namespace {

bool SeenBy(const Landmark& landmark, KeyframeId keyframe) {
  return std::any_of(
      landmark.observations.begin(), landmark.observations.end(),
      [&](const Observation& observation) { return observation.keyframe == keyframe; });
}

}  // namespace

MapEdit FuseInto(const Map& map, KeyframeId in, const std::vector<LandmarkId>& candidates,
                 const StereoCamera& camera, int levels, const FuseOptions& options,
                 FuseBound bound) {
  const Keyframe& keyframe = map.At(in);
  const Eigen::Isometry3d T_rig_world = keyframe.T_world_rig.inverse();
  std::vector<const Landmark*> unseen = FindAll(map, candidates);
  std::erase_if(unseen, [&](const Landmark* landmark) { return SeenBy(*landmark, in); });
  const std::vector<Expected> expected =
      ExpectAll(unseen, camera, T_rig_world, keyframe.frame->scale, levels);
  MapEdit edit;
  // No ratio test: a rival feature here is as likely the same landmark at the next level.
  for (const Match& match : MatchByProjection(
           *keyframe.frame, expected, {options.radius_px, options.descriptor_distance, 1.0})) {
    const auto feature = static_cast<std::size_t>(match.feature);
    if (bound == FuseBound::kChi2 && !Agrees(camera, T_rig_world * map.At(match.landmark).position,
                                             keyframe.frame->measurements[feature])) {
      continue;
    }
    const LandmarkId held = keyframe.landmarks[feature];
    if (!held.valid()) {
      edit.links.push_back({match.landmark, {in, match.feature}});
      continue;
    }
    const bool keep_held =
        ObservationWeight(map, map.At(held)) >= ObservationWeight(map, map.At(match.landmark));
    edit.merges.push_back(keep_held ? MapEdit::Merge{match.landmark, held}
                                    : MapEdit::Merge{held, match.landmark});
  }
  return edit;
}

std::vector<KeyframeId> FuseNeighbours(const Map& map, KeyframeId id, const FuseOptions& options) {
  std::vector<KeyframeId> neighbours;
  for (const Covisible& covisible : CovisibleKeyframes(map, id, options.least_shared)) {
    if (std::ssize(neighbours) == options.neighbours) break;
    neighbours.push_back(covisible.keyframe);
  }
  return neighbours;
}

}  // namespace aisle::slam
