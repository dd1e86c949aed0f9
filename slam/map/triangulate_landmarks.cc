#include "slam/map/triangulate_landmarks.h"

#include <algorithm>
#include <cmath>

namespace aisle::slam {

PlacePoint PlaceByRays(double worst_depth_ratio) {
  return [worst_depth_ratio](const TwoViews& views, std::size_t i,
                             std::size_t j) -> std::optional<Eigen::Vector3d> {
    const Intersection meeting = Intersect(views, i, j);
    const double sigma_rad =
        std::hypot(views.Here(i).sigma_px, views.There(j).sigma_px) / views.camera.fx;
    if (sigma_rad > worst_depth_ratio * meeting.sine) return std::nullopt;
    return meeting.point;
  };
}

std::vector<Landmark> TriangulateLandmarks(const Map& map, KeyframeId newest,
                                           const std::vector<KeyframeId>& neighbours,
                                           const StereoCamera& camera,
                                           const TriangulateOptions& options,
                                           const PlacePoint& place) {
  std::vector<Landmark> landmarks;
  const Keyframe& here = map.At(newest);
  std::vector<bool> used_here(here.landmarks.size(), false);
  for (int n = 0; n < std::min<int>(options.neighbours, static_cast<int>(neighbours.size())); ++n) {
    const Keyframe& there = map.At(neighbours[static_cast<std::size_t>(n)]);
    const TwoViews views{here, there, camera, there.T_world_rig.inverse() * here.T_world_rig};
    // Nearer than the two cameras are to each other they see better by themselves.
    if (views.T_there_here.translation().norm() < camera.baseline_m) continue;
    std::vector<bool> used_there(there.landmarks.size(), false);
    const std::vector<LineCandidate> candidates =
        CandidatesOf(views, FreeFeatures(there, used_there));
    for (const std::size_t i : FreeFeatures(here, used_here)) {
      const auto j =
          BestOnLine(views, i, candidates, options.descriptor_distance, options.descriptor_ratio);
      if (!j || used_there[*j]) continue;
      const auto point = place(views, i, *j);
      if (!point) continue;
      const Eigen::Vector3d from_there = views.T_there_here * *point;
      if (!Agrees(camera, *point, views.Here(i)) || !Agrees(camera, from_there, views.There(*j)) ||
          !SizesFit(views, i, *j, point->norm(), from_there.norm())) {
        continue;
      }
      used_here[i] = used_there[*j] = true;
      Landmark landmark;
      landmark.position = here.T_world_rig * *point;
      landmark.observations = {{there.id, static_cast<int>(*j)}, {newest, static_cast<int>(i)}};
      landmark.created_by = newest;
      landmark.predicted = landmark.found = 1;
      landmarks.push_back(landmark);
    }
  }
  return landmarks;
}

std::vector<Landmark> TriangulateLandmarks(const Map& map, KeyframeId newest,
                                           const std::vector<KeyframeId>& neighbours,
                                           const StereoCamera& camera,
                                           const TriangulateOptions& options) {
  return TriangulateLandmarks(map, newest, neighbours, camera, options,
                              PlaceByRays(options.worst_depth_ratio));
}

}  // namespace aisle::slam
