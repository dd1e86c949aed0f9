#include "harness/record/group.h"

#include "harness/io/hash.h"
#include "harness/record/seed_values.h"
#include "harness/score/statistics.h"
#include "harness/systems/built_in.h"

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
  std::set<std::string> names;
  for (const RunRecord& run : results.runs) names.insert(run.spec.system.name);
  const std::map<std::string, int> styles = StylesOf(names);
  for (const RunRecord& run : results.runs) {
    const RunSpec& spec = run.spec;
    SceneRuns& scene = FindOrAdd(
        scenes, [&](const SceneRuns& s) { return s.scene == spec.scene && s.twin == spec.twin; },
        SceneRuns{spec.scene, spec.twin, {}});
    SystemRuns& system = FindOrAdd(
        scene.systems, [&](const SystemRuns& s) { return s.system == spec.system.name; },
        SystemRuns{spec.system.name, styles.at(spec.system.name), {}});
    system.runs.push_back(&run);
  }
  return scenes;
}

std::map<std::string, int> StylesOf(const std::set<std::string>& systems) {
  constexpr int kOthers = kStyles / 2;
  std::map<std::string, int> styles;
  std::set<int> taken;
  for (const std::string& name : systems) {
    const auto ours = std::ranges::find(Systems(), name, &System::name);
    if (ours != Systems().end()) {
      styles[name] = static_cast<int>(ours - Systems().begin());
      continue;
    }
    const int wanted = static_cast<int>(Hash(name, 0) % kOthers);
    int style = wanted;
    for (int step = 0; step < kOthers && taken.contains(style); ++step) {
      style = (wanted + step) % kOthers;
    }
    taken.insert(style);
    styles[name] = kOthers + style;
  }
  return styles;
}

std::vector<std::pair<std::string, int>> SystemsInOrder(const std::vector<SceneRuns>& scenes) {
  std::vector<std::pair<std::string, int>> systems;
  for (const SceneRuns& scene : scenes) {
    for (const SystemRuns& system : scene.systems) {
      const std::pair named{system.system, system.color};
      if (std::find(systems.begin(), systems.end(), named) == systems.end()) {
        systems.push_back(named);
      }
    }
  }
  return systems;
}

std::vector<double> ScoresOf(const std::vector<const RunRecord*>& runs, const std::string& score) {
  return MediansBySeed(runs, [&](const RunRecord& run) { return ValueOf(run, score); });
}

bool AllHave(const std::vector<const RunRecord*>& runs, const std::string& score) {
  return std::ranges::all_of(
      runs, [&](const RunRecord* run) { return ValueOf(*run, score).has_value(); });
}

std::optional<double> MedianScore(const std::vector<const RunRecord*>& runs,
                                  const std::string& score) {
  if (runs.empty() || !AllHave(runs, score)) return std::nullopt;
  return Quantile(ScoresOf(runs, score), 0.5);
}

bool AreWholeDrives(const std::vector<const RunRecord*>& runs) {
  constexpr double kWhole = 0.99;
  const std::vector<double> coverage = ScoresOf(runs, "coverage");
  return (coverage.empty() || Quantile(coverage, 0.5) >= kWhole) &&
         std::all_of(runs.begin(), runs.end(),
                     [](const RunRecord* run) { return run->status == RunStatus::kOk; });
}

const RunRecord* WorstRun(const std::vector<const RunRecord*>& runs) {
  const auto badness = [](const RunRecord* run) {
    const auto ate = run->scores.find("ate_rmse_m");
    const bool known = ate != run->scores.end() && ate->second.value;
    const bool failed = run->status != RunStatus::kOk;
    return std::pair(failed, known ? *ate->second.value : 0.0);
  };
  const RunRecord* worst = nullptr;
  for (const RunRecord* run : runs) {
    if (worst == nullptr || badness(worst) < badness(run)) worst = run;
  }
  return worst;
}

}  // namespace aisle
