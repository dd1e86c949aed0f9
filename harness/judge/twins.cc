#include "harness/judge/twins.h"

#include "harness/contract/twin.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

constexpr const char* kError = "ate_rmse_m";

const SystemRuns* Find(const std::vector<SceneRuns>& scenes, const std::string& scene,
                       const std::string& twin, const std::string& system) {
  for (const SceneRuns& runs : scenes) {
    if (runs.scene != scene || runs.twin != twin) continue;
    for (const SystemRuns& one : runs.systems) {
      if (one.system == system) return &one;
    }
  }
  return nullptr;
}

/// Nothing where it is one of less than whole drives: it cannot be held against others.
std::optional<double> Error(const SystemRuns* runs) {
  return runs == nullptr || !AreWholeDrives(runs->runs) ? std::nullopt
                                                        : MedianScore(runs->runs, kError);
}

std::optional<double> Minus(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(*a - *b) : std::nullopt;
}

/// What is left of a system's options when those that say how it rejects, and on which base, are
/// taken away.
std::map<std::string, std::string> OptionsBesideRejection(const SystemSpec& system) {
  std::map<std::string, std::string> options = OptionsOver(system);
  std::erase_if(options, [](const auto& option) {
    return option.first == "base" || option.first.starts_with("dynamic.");
  });
  return options;
}

}  // namespace

void AddDynamicPenalty(std::vector<RunRecord>* runs) {
  using Key = std::tuple<std::string, std::string, std::uint64_t, int>;
  std::map<Key, Score> empty;
  for (const RunRecord& run : *runs) {
    const auto score = run.scores.find(kError);
    if (run.spec.twin == twin::kEmpty && score != run.scores.end()) {
      empty[{run.spec.scene, run.spec.system.name, run.spec.seed, run.spec.repeat}] = score->second;
    }
  }
  for (RunRecord& run : *runs) {
    const auto twin =
        empty.find({run.spec.scene, run.spec.system.name, run.spec.seed, run.spec.repeat});
    const bool moves = run.spec.twin != twin::kEmpty && run.spec.twin != twin::kFrozen;
    if (!moves || twin == empty.end()) continue;
    const auto live = run.scores.find(kError);
    const bool both = live != run.scores.end() && live->second.value && twin->second.value &&
                      *twin->second.value > 0;
    Score& penalty = run.scores["dynamic_penalty"];
    penalty.unit = std::string(1, '1');
    if (both) {
      penalty.value = *live->second.value / *twin->second.value;
      penalty.n = live->second.n;
      penalty.alignment = live->second.alignment;
    } else {
      penalty.absent = "one of the twins has no ATE";
    }
  }
}

std::string TwinNeededBy(const std::string& score) {
  return score == "dynamic_penalty" ? twin::kEmpty : "";
}

bool IsWithoutRejection(const SystemSpec& other, const SystemSpec& system) {
  const SystemTraits with = TraitsOf(system), without = TraitsOf(other);
  return with.Rejects() && without.IsKnown() && !without.Rejects() && with.base == without.base &&
         OptionsBesideRejection(system) == OptionsBesideRejection(other);
}

std::vector<CostSplit> SplitCosts(const std::vector<SceneRuns>& scenes) {
  std::vector<CostSplit> splits;
  for (const SceneRuns& scene : scenes) {
    if (scene.twin != twin::kLive) continue;
    for (const SystemRuns& system : scene.systems) {
      CostSplit split{.scene = scene.scene,
                      .system = system.system,
                      .color = system.color,
                      .live_m = Error(&system),
                      .empty_m = Error(Find(scenes, scene.scene, twin::kEmpty, system.system)),
                      .occlusion_m = {},
                      .motion_m = {},
                      .rejection_m = {},
                      .penalty = {}};
      const auto frozen = Error(Find(scenes, scene.scene, twin::kFrozen, system.system));
      split.occlusion_m = Minus(frozen, split.empty_m);
      split.motion_m = Minus(split.live_m, frozen);
      for (const SystemRuns& other : scene.systems) {
        const SystemSpec& spec = system.runs.front()->spec.system;
        if (IsWithoutRejection(other.runs.front()->spec.system, spec)) {
          split.rejection_m = Minus(split.live_m, Error(&other));
        }
      }
      if (split.live_m && split.empty_m && *split.empty_m > 0) {
        split.penalty = *split.live_m / *split.empty_m;
      }
      if (split.empty_m || split.motion_m || split.rejection_m) splits.push_back(split);
    }
  }
  return splits;
}

}  // namespace aisle
