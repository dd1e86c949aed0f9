#include "slam/place/adjust_loop.h"

#include <map>

#include "slam/optimize/bundle.h"

namespace aisle::slam {
namespace {

constexpr int kNewPose = 0;

/// The new pose, free; every keyframe that sees the landmarks, fixed; the landmarks, free.
BundleProblem BuildProblem(const Map& map, const Frame& frame, const std::vector<Match>& matches,
                           const std::vector<bool>& inlier, const Eigen::Isometry3d& T_rig_world,
                           const StereoCamera& camera) {
  BundleProblem problem;
  problem.camera = camera;
  problem.poses.push_back({T_rig_world, false});
  std::map<KeyframeId, int> pose_of;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!inlier[i]) continue;
    const Landmark& landmark = map.At(matches[i].landmark);
    const auto point = static_cast<int>(problem.points.size());
    problem.points.push_back(landmark.position);
    problem.observations.push_back(MakeObservation(
        kNewPose, point, frame.measurements[static_cast<std::size_t>(matches[i].feature)]));
    for (const Observation& observation : landmark.observations) {
      const Keyframe& keyframe = map.At(observation.keyframe);
      const auto next = static_cast<int>(problem.poses.size());
      const auto [pose, is_new] = pose_of.emplace(observation.keyframe, next);
      if (is_new) problem.poses.push_back({keyframe.T_world_rig.inverse(), true});
      problem.observations.push_back(MakeObservation(
          pose->second, point,
          keyframe.frame->measurements[static_cast<std::size_t>(observation.feature)]));
    }
  }
  return problem;
}

}  // namespace

std::optional<AdjustedView> AdjustView(const Map& map, const Frame& frame,
                                       const std::vector<Match>& matches,
                                       const std::vector<bool>& inlier,
                                       const Eigen::Isometry3d& T_rig_world,
                                       const StereoCamera& camera) {
  constexpr int kIterations = 10;
  BundleProblem problem = BuildProblem(map, frame, matches, inlier, T_rig_world, camera);
  if (problem.points.empty()) return std::nullopt;
  if (!Solve(problem, WithProjection(problem), {kIterations, true}).usable) return std::nullopt;
  if (!Solve(problem, WithinBounds(problem), {kIterations, false}).usable) return std::nullopt;
  AdjustedView view{problem.poses[kNewPose].T_rig_world, 0};
  for (const BundleProblem::Observation& observation : problem.observations) {
    view.inliers +=
        observation.pose == kNewPose && Chi2(problem, observation) <= observation.chi2_bound;
  }
  return view;
}

}  // namespace aisle::slam
