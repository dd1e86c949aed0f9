#include "harness/record/group.h"

#include "harness/score/statistics.h"

namespace aisle {
namespace {

template <typename T, typename Same>
T& FindOrAdd(std::vector<T>& list, const Same& same, const T& fresh) {
  const auto at = std::find_if(list.begin(), list.end(), same);
  if (at != list.end()) return *at;
  list.push_back(fresh);
  return list.back();
}

}  // namespace

std::vector<SceneRuns> GroupByScene(const Results& results) {
  std::vector<SceneRuns> scenes;
  std::map<std::string, int> colors;
  for (const RunRecord& run : results.runs) {
    const RunSpec& spec = run.spec;
    const int color =
        colors.emplace(spec.system.name, static_cast<int>(colors.size())).first->second;
    SceneRuns& scene = FindOrAdd(
        scenes, [&](const SceneRuns& s) { return s.scene == spec.scene && s.twin == spec.twin; },
        SceneRuns{spec.scene, spec.twin, {}});
    SystemRuns& system = FindOrAdd(
        scene.systems, [&](const SystemRuns& s) { return s.system == spec.system.name; },
        SystemRuns{spec.system.name, color, {}});
    system.runs.push_back(&run);
  }
  return scenes;
}

std::optional<double> MedianScore(const std::vector<const RunRecord*>& runs,
                                  const std::string& score) {
  std::vector<double> values;
  for (const RunRecord* run : runs) {
    const auto at = run->scores.find(score);
    if (at == run->scores.end() || !at->second.value) return std::nullopt;
    values.push_back(*at->second.value);
  }
  if (values.empty()) return std::nullopt;
  return Quantile(values, 0.5);
}

}  // namespace aisle
