#include "slam/optimize/adjust_map.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "slam/camera/se3.h"
#include "slam/map/landmarks_of.h"
#include "slam/optimize/pose_graph.h"

namespace aisle::slam {
namespace {

/// A BundleProblem and which parts of a map its indices stand for.
struct MapProblem {
  BundleProblem bundle;
  std::vector<KeyframeId> keyframes;  // of poses
  std::vector<LandmarkId> landmarks;  // of points
  std::vector<MapEdit::Link> links;   // of observations
};

bool IsRoot(const Map& map, KeyframeId id) { return !map.At(id).parent.valid(); }

/// Whether an observation of a landmark counts.
using Counts = std::function<bool(const Landmark& landmark, const Observation& observation)>;

/// The builder: landmarks as seen by the given keyframes, `free` ones and `fixed` ones.
MapProblem BuildProblem(
    const Map& map, const std::vector<KeyframeId>& free, const std::vector<KeyframeId>& fixed,
    const std::vector<LandmarkId>& landmarks, const StereoCamera& camera,
    const Counts& counts = [](const Landmark&, const Observation&) { return true; }) {
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
      if (pose == pose_of.end() || !counts(landmark, observation)) continue;
      const Frame& frame = *map.At(observation.keyframe).frame;
      problem.bundle.observations.push_back(MakeObservation(
          pose->second, point, frame.measurements[static_cast<std::size_t>(observation.feature)]));
      problem.links.push_back({id, observation});
    }
  }
  return problem;
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

/// Keyframes other than `free` that see any of the landmarks, most observations first.
std::vector<KeyframeId> OutsideObservers(const Map& map, const std::vector<KeyframeId>& free,
                                         const std::vector<LandmarkId>& landmarks, int most) {
  std::vector<int> shared = CountSeen(map, landmarks);
  for (const KeyframeId id : free) shared[static_cast<std::size_t>(id.value)] = 0;
  std::vector<std::pair<int, KeyframeId>> ranked;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    if (shared[i] > 0) ranked.push_back({-shared[i], {static_cast<std::int64_t>(i)}});
  }
  std::sort(ranked.begin(), ranked.end());
  ranked.resize(std::min(ranked.size(), static_cast<std::size_t>(most)));
  std::vector<KeyframeId> observers;
  for (const auto& [count, id] : ranked) observers.push_back(id);
  return observers;
}

/// Of every keyframe the oldest one that landmarks hold it together with: from there on each shares
/// kLeastCovisible of them at least with those before it. Such a component of the map adjusts by
/// itself; where it stands to others few landmarks, or none, can tell.
std::map<KeyframeId, KeyframeId> OldestHeldTogether(const Map& map) {
  std::map<KeyframeId, KeyframeId> oldest_of;
  for (const auto& [oldest, keyframe] : map.keyframes()) {
    if (!oldest_of.emplace(oldest, oldest).second) continue;
    std::vector<int> shared(static_cast<std::size_t>(map.NextKeyframeId().value), 0);
    std::set<LandmarkId> known;
    std::vector<KeyframeId> reached = {oldest};
    while (!reached.empty()) {
      const KeyframeId id = reached.back();
      reached.pop_back();
      for (const LandmarkId landmark : map.At(id).landmarks) {
        if (!landmark.valid() || !known.insert(landmark).second) continue;
        for (const Observation& observation : map.At(landmark).observations) {
          if (++shared[static_cast<std::size_t>(observation.keyframe.value)] == kLeastCovisible &&
              oldest_of.emplace(observation.keyframe, oldest).second) {
            reached.push_back(observation.keyframe);
          }
        }
      }
    }
  }
  return oldest_of;
}

/// An adjustment of components by themselves, each of which goes on from where its oldest keyframe
/// stood: it now goes as a whole where the keyframe has gone that the oldest was tracked from.
void CarryComponents(const Map& map, const std::map<KeyframeId, KeyframeId>& oldest_of,
                     MapEdit& edit) {
  std::map<KeyframeId, Eigen::Isometry3d> T_adjusted;  // by keyframe
  for (const MapEdit::Pose& pose : edit.poses) T_adjusted[pose.keyframe] = pose.T_world_rig;
  std::map<KeyframeId, Eigen::Isometry3d> T_new_old;  // by oldest keyframe, but for the roots
  const auto carrying = [&](KeyframeId id) {
    const auto carried = T_new_old.find(oldest_of.at(id));
    return carried == T_new_old.end() ? nullptr : &carried->second;
  };
  for (const auto& [id, oldest] : oldest_of) {
    const KeyframeId parent = map.At(id).parent;
    if (id != oldest || !parent.valid()) continue;
    // The parent is older than all of the component, so that where its own has gone is known.
    const Eigen::Isometry3d& T_parent = map.At(parent).T_world_rig;
    const auto adjusted = T_adjusted.find(parent);
    Eigen::Isometry3d T = adjusted == T_adjusted.end() ? Eigen::Isometry3d::Identity()
                                                       : adjusted->second * T_parent.inverse();
    if (const auto* carried = carrying(parent)) T = *carried * T;
    T_new_old[oldest] = T;
    edit.poses.push_back({oldest, map.At(oldest).T_world_rig});
  }
  for (MapEdit::Pose& pose : edit.poses) {
    if (const auto* carried = carrying(pose.keyframe)) {
      pose.T_world_rig = Normalized(*carried * pose.T_world_rig);
    }
  }
  for (MapEdit::Position& position : edit.positions) {
    const KeyframeId first = map.At(position.landmark).observations.front().keyframe;
    if (const auto* carried = carrying(first)) position.position = *carried * position.position;
  }
}

/// How many of the landmarks any of the keyframes sees.
int CountSeenByAny(const Map& map, const std::vector<LandmarkId>& landmarks,
                   const std::vector<KeyframeId>& keyframes) {
  return static_cast<int>(std::ranges::count_if(landmarks, [&](const LandmarkId id) {
    return std::ranges::any_of(map.At(id).observations, [&](const Observation& observation) {
      return std::ranges::find(keyframes, observation.keyframe) != keyframes.end();
    });
  }));
}

/// A robust pass tells outliers, a plain one (if it has iterations) adjusts without them; then the
/// others are tested again, with a second chance all.
Adjustment AdjustTwice(MapProblem problem, int robust_iterations, int final_iterations,
                       bool second_chance) {
  const BundleSummary first =
      Solve(problem.bundle, WithProjection(problem.bundle), {robust_iterations, true});
  const std::vector<bool> active = WithinBounds(problem.bundle);
  if (final_iterations == 0) return {ToEdit(problem, active), first};
  const BundleSummary summary = Solve(problem.bundle, active, {final_iterations, false});
  if (!summary.usable) return {{}, summary};
  std::vector<bool> kept = WithinBounds(problem.bundle);
  for (std::size_t i = 0; i < kept.size(); ++i) kept[i] = kept[i] && (active[i] || second_chance);
  return {ToEdit(problem, kept), summary};
}

}  // namespace

Adjustment AdjustLocally(const Map& map, KeyframeId around, const StereoCamera& camera,
                         const LocalAdjustmentOptions& options) {
  std::vector<KeyframeId> free = {around};
  for (const Covisible& covisible : CovisibleKeyframes(map, around, options.least_shared)) {
    if (std::ssize(free) < options.free_keyframes) free.push_back(covisible.keyframe);
  }
  // A root is where its part of the map is: it never moves.
  std::vector<KeyframeId> fixed;
  const auto roots = std::stable_partition(free.begin(), free.end(),
                                           [&](KeyframeId id) { return !IsRoot(map, id); });
  fixed.assign(roots, free.end());
  free.erase(roots, free.end());
  const std::vector<LandmarkId> landmarks = LandmarksOf(map, free);
  for (const KeyframeId id : OutsideObservers(map, free, landmarks, options.fixed_keyframes)) {
    if (!std::count(fixed.begin(), fixed.end(), id)) fixed.push_back(id);
  }
  if (free.empty()) return {{}, {0, 0, 0, true, "nothing is free"}};
  // Where too little is seen from outside the oldest free keyframe holds it too: the problem has
  // six free degrees, and one to three landmarks turn them about as their noise will.
  if (CountSeenByAny(map, landmarks, fixed) < kLeastCovisible) {
    const auto oldest = std::min_element(free.begin(), free.end());
    fixed.push_back(*oldest);
    free.erase(oldest);
  }

  return AdjustTwice(BuildProblem(map, free, fixed, landmarks, camera), options.robust_iterations,
                     options.final_iterations, options.second_chance);
}

Adjustment AdjustGlobally(const Map& map, const StereoCamera& camera,
                          const GlobalAdjustmentOptions& options) {
  const std::map<KeyframeId, KeyframeId> oldest_of = OldestHeldTogether(map);
  std::vector<KeyframeId> free, fixed;
  for (const auto& [id, oldest] : oldest_of) {
    (IsRoot(map, id) || id == oldest ? fixed : free).push_back(id);
  }
  if (free.empty()) return {{}, {0, 0, 0, true, "nothing is free"}};
  std::vector<LandmarkId> landmarks;
  for (const Landmark* landmark : map.Landmarks()) landmarks.push_back(landmark->id);
  const Counts within = [&](const Landmark& landmark, const Observation& observation) {
    return oldest_of.at(observation.keyframe) ==
           oldest_of.at(landmark.observations.front().keyframe);
  };
  Adjustment adjustment = AdjustTwice(BuildProblem(map, free, fixed, landmarks, camera, within),
                                      options.robust_iterations, options.final_iterations, true);
  if (adjustment.summary.usable) CarryComponents(map, oldest_of, adjustment.edit);
  return adjustment;
}

Eigen::Isometry3d Correction(const Map& map, const LoopEdge& loop) {
  return map.At(loop.matched).T_world_rig * loop.T_matched_current *
         map.At(loop.current).T_world_rig.inverse();
}

MapEdit MoveRigidly(const Map& map, const std::vector<KeyframeId>& keyframes,
                    const Eigen::Isometry3d& T_new_old) {
  MapEdit edit;
  for (const KeyframeId id : keyframes) {
    edit.poses.push_back({id, Normalized(T_new_old * map.At(id).T_world_rig)});
  }
  for (const LandmarkId id : LandmarksOf(map, keyframes)) {
    edit.positions.push_back({id, T_new_old * map.At(id).position});
  }
  return edit;
}

MapEdit JoinParts(const Map& map, const LoopEdge& loop) {
  const std::map<KeyframeId, KeyframeId> roots = Roots(map);
  const KeyframeId current = roots.at(loop.current), matched = roots.at(loop.matched);
  MapEdit edit;
  if (current == matched) return edit;
  const Eigen::Isometry3d T_new_old = Correction(map, loop);
  const auto& [stays, moves] = std::minmax(current, matched);
  const Eigen::Isometry3d T_world_part = moves == current ? T_new_old : T_new_old.inverse();
  std::vector<KeyframeId> moving;
  KeyframeId parent;  // of the younger root: the newest of the other part that is older
  for (const auto& [id, root] : roots) {
    if (root == moves) moving.push_back(id);
    if (root == stays && id < moves) parent = id;
  }
  edit = MoveRigidly(map, moving, T_world_part);
  edit.parents.push_back({moves, parent});
  return edit;
}

MapEdit SpreadLoops(const Map& map, const std::vector<LoopEdge>& loops,
                    const LoopSpreadOptions& options) {
  PoseGraph graph;
  std::vector<KeyframeId> keyframes;
  std::map<KeyframeId, int> index;
  for (const auto& [id, keyframe] : map.keyframes()) {
    index[id] = static_cast<int>(keyframes.size());
    keyframes.push_back(id);
    graph.poses.push_back({keyframe->T_world_rig.inverse(), IsRoot(map, id)});
  }
  const auto connect = [&](KeyframeId from, KeyframeId to) {
    graph.edges.push_back({index.at(from), index.at(to),
                           map.At(from).T_world_rig.inverse() * map.At(to).T_world_rig,
                           options.sigma_m, options.sigma_rad});
  };
  for (const KeyframeId id : keyframes) {
    const KeyframeId parent = map.At(id).parent;
    if (parent.valid()) connect(parent, id);
    for (const Covisible& covisible : CovisibleKeyframes(map, id, options.strong_shared)) {
      if (covisible.keyframe < id && covisible.keyframe != parent) connect(covisible.keyframe, id);
    }
  }
  for (const ClosedLoop& loop : map.closed_loops()) connect(loop.matched, loop.current);
  for (const LoopEdge& loop : loops) {
    if (!map.Find(loop.matched) || !map.Find(loop.current)) continue;
    graph.edges.push_back({index.at(loop.matched), index.at(loop.current), loop.T_matched_current,
                           options.sigma_m, options.sigma_rad, true});
  }
  MapEdit edit;
  if (!Solve(graph, options.iterations).usable) return edit;
  std::map<KeyframeId, Eigen::Isometry3d> T_new_old;  // of the world around each keyframe
  for (std::size_t i = 0; i < keyframes.size(); ++i) {
    const Eigen::Isometry3d T_world_rig = Normalized(graph.poses[i].T_rig_world.inverse());
    T_new_old[keyframes[i]] = T_world_rig * map.At(keyframes[i]).T_world_rig.inverse();
    if (!graph.poses[i].fixed) edit.poses.push_back({keyframes[i], T_world_rig});
  }
  for (const Landmark* landmark : map.Landmarks()) {
    const KeyframeId first = landmark->observations.front().keyframe;
    edit.positions.push_back({landmark->id, T_new_old.at(first) * landmark->position});
  }
  return edit;
}

}  // namespace aisle::slam
