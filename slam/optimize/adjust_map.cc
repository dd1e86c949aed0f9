#include "slam/optimize/adjust_map.h"

#include <algorithm>
#include <set>

namespace aisle::slam {
namespace {

/// A BundleProblem and which parts of a map its indices stand for.
struct MapProblem {
  BundleProblem bundle;
  std::vector<KeyframeId> keyframes;  // of poses
  std::vector<LandmarkId> landmarks;  // of points
  std::vector<MapEdit::Link> links;   // of sights
};

/// The builder: landmarks as seen by the given keyframes, `free` ones and `fixed` ones.
MapProblem BuildProblem(const Map& map, const std::vector<KeyframeId>& free,
                        const std::vector<KeyframeId>& fixed,
                        const std::vector<LandmarkId>& landmarks, const StereoCamera& camera) {
  MapProblem problem;
  problem.bundle.camera = camera;
  std::map<KeyframeId, int> pose_of;
  const auto add = [&](KeyframeId id, bool is_fixed) {
    pose_of[id] = static_cast<int>(problem.keyframes.size());
    problem.keyframes.push_back(id);
    problem.bundle.poses.push_back({map.At(id).T_world_rig.inverse(), is_fixed});
  };
  for (const KeyframeId id : free) add(id, false);
  for (const KeyframeId id : fixed) add(id, true);
  for (const LandmarkId id : landmarks) {
    const Landmark& landmark = map.At(id);
    const int point = static_cast<int>(problem.landmarks.size());
    problem.landmarks.push_back(id);
    problem.bundle.points.push_back(landmark.position);
    for (const Observation& observation : landmark.observations) {
      const auto pose = pose_of.find(observation.keyframe);
      if (pose == pose_of.end()) continue;
      const Frame& frame = *map.At(observation.keyframe).frame;
      problem.bundle.sights.push_back(MakeSight(
          pose->second, point, frame.measurements[static_cast<std::size_t>(observation.feature)]));
      problem.links.push_back({id, observation});
    }
  }
  return problem;
}

std::vector<bool> WithinBounds(const BundleProblem& problem) {
  std::vector<bool> within;
  for (const BundleProblem::Sight& sight : problem.sights) {
    within.push_back(Chi2(problem, sight) <= sight.chi2_bound);
  }
  return within;
}

MapEdit ToEdit(const MapProblem& problem, const std::vector<bool>& inlier) {
  MapEdit edit;
  for (std::size_t i = 0; i < problem.keyframes.size(); ++i) {
    const BundleProblem::Pose& pose = problem.bundle.poses[i];
    if (!pose.fixed) edit.poses.push_back({problem.keyframes[i], pose.T_rig_world.inverse()});
  }
  for (std::size_t i = 0; i < problem.landmarks.size(); ++i) {
    edit.positions.push_back({problem.landmarks[i], problem.bundle.points[i]});
  }
  for (std::size_t i = 0; i < inlier.size(); ++i) {
    if (!inlier[i]) edit.cuts.push_back(problem.links[i]);
  }
  return edit;
}

std::vector<LandmarkId> LandmarksOf(const Map& map, const std::vector<KeyframeId>& keyframes) {
  std::set<LandmarkId> landmarks;
  for (const KeyframeId id : keyframes) {
    for (const LandmarkId landmark : map.At(id).landmarks) {
      if (landmark.valid()) landmarks.insert(landmark);
    }
  }
  return {landmarks.begin(), landmarks.end()};
}

/// Keyframes other than `free` that see any of the landmarks, most sights first.
std::vector<KeyframeId> OutsideObservers(const Map& map, const std::vector<KeyframeId>& free,
                                         const std::vector<LandmarkId>& landmarks, int most) {
  std::map<KeyframeId, int> sights;
  for (const LandmarkId id : landmarks) {
    for (const Observation& observation : map.At(id).observations) ++sights[observation.keyframe];
  }
  for (const KeyframeId id : free) sights.erase(id);
  std::vector<std::pair<int, KeyframeId>> ranked;
  for (const auto& [id, count] : sights) ranked.emplace_back(-count, id);
  std::sort(ranked.begin(), ranked.end());
  ranked.resize(std::min(ranked.size(), static_cast<std::size_t>(most)));
  std::vector<KeyframeId> observers;
  for (const auto& [count, id] : ranked) observers.push_back(id);
  return observers;
}

}  // namespace

Adjustment AdjustLocally(const Map& map, KeyframeId around, const StereoCamera& camera,
                         const LocalAdjustmentOptions& options) {
  std::vector<KeyframeId> free = {around};
  for (const Covisible& covisible : CovisibleKeyframes(map, around, options.least_shared)) {
    if (std::ssize(free) < options.free_keyframes) free.push_back(covisible.keyframe);
  }
  // The first keyframe is where the world is: it never moves.
  const KeyframeId first = map.keyframes().begin()->first;
  std::vector<KeyframeId> fixed;
  const bool first_is_near = std::erase(free, first) > 0;
  if (first_is_near) fixed.push_back(first);
  const std::vector<LandmarkId> landmarks = LandmarksOf(map, free);
  for (const KeyframeId id : OutsideObservers(map, free, landmarks, options.fixed_keyframes)) {
    if (id != first || !first_is_near) fixed.push_back(id);
  }
  if (free.empty()) return {{}, {0, 0, 0, true, "nothing is free"}};
  // Without anything to hold it the oldest free keyframe does: the problem has six free degrees.
  if (fixed.empty()) {
    const auto oldest = std::min_element(free.begin(), free.end());
    fixed.push_back(*oldest);
    free.erase(oldest);
  }

  MapProblem problem = BuildProblem(map, free, fixed, landmarks, camera);
  Solve(problem.bundle, {}, {options.robust_iterations, true});
  const BundleSummary summary =
      Solve(problem.bundle, WithinBounds(problem.bundle), {options.final_iterations, false});
  if (!summary.usable) return {{}, summary};
  return {ToEdit(problem, WithinBounds(problem.bundle)), summary};
}

}  // namespace aisle::slam
