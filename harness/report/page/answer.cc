#include "harness/report/page/answer.h"

#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr std::size_t kMostSentences = 3;  ///< more is a table, which stands below

/// The systems of one scene as written, in the order of the suite, with their median errors.
struct SceneErrors {
  std::string scene;
  std::vector<std::pair<std::string, double>> ate_m;
  std::vector<std::string> lost;  ///< systems of which some run has no error
};

const double* Find(const SceneErrors& errors, const std::string& system) {
  const auto at = std::find_if(errors.ate_m.begin(), errors.ate_m.end(),
                               [&](const auto& entry) { return entry.first == system; });
  return at == errors.ate_m.end() ? nullptr : &at->second;
}

double Worst(const SceneErrors& errors) {
  double worst = errors.lost.empty() ? 0 : 1e9;
  for (const auto& [system, ate_m] : errors.ate_m) worst = std::max(worst, ate_m);
  return worst;
}

std::vector<SceneErrors> CollectErrors(const Results& results) {
  std::vector<std::string> scenes, systems;
  std::map<std::pair<std::string, std::string>, std::vector<std::optional<double>>> errors;
  const auto remember = [](std::vector<std::string>* names, const std::string& name) {
    if (std::find(names->begin(), names->end(), name) == names->end()) names->push_back(name);
  };
  for (const RunRecord& run : results.runs) {
    if (run.spec.twin != "live") continue;
    remember(&scenes, run.spec.scene);
    remember(&systems, run.spec.system.name);
    const auto ate = run.scores.find("ate_rmse_m");
    errors[{run.spec.scene, run.spec.system.name}].push_back(
        ate == run.scores.end() ? std::nullopt : ate->second.value);
  }
  std::vector<SceneErrors> collected;
  for (const std::string& scene : scenes) {
    SceneErrors of_scene{.scene = scene, .ate_m = {}, .lost = {}};
    for (const std::string& system : systems) {
      const auto found = errors.find({scene, system});
      if (found == errors.end()) continue;
      std::vector<double> values;
      for (const std::optional<double>& value : found->second) {
        if (value) values.push_back(*value);
      }
      if (values.size() < found->second.size()) {
        of_scene.lost.push_back(system);
      } else {
        of_scene.ate_m.emplace_back(system, Quantile(values, 0.5));
      }
    }
    collected.push_back(std::move(of_scene));
  }
  return collected;
}

std::string Listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

std::string PercentInWords(double share) {
  const double percent = 100 * share;
  return percent > 99 && percent < 100 ? fmt::format("{:.1f} %", percent)
                                       : fmt::format("{:.0f} %", percent);
}

/// What movers cost the unprotected system beyond one that is told the truth about them, and how
/// much of that each other system wins back. Nothing where movers cost next to nothing.
std::string WonBack(const SceneErrors& errors) {
  constexpr double kLeastRatio = 1.5;  ///< below it is the noise of one drive
  const char* unprotected = nullptr;
  for (const char* name : {"orbslam2", "plain"}) {
    if (unprotected == nullptr && Find(errors, name) != nullptr) unprotected = name;
  }
  const double* oracle = Find(errors, "oracle");
  if (unprotected == nullptr || oracle == nullptr) return "";
  const double base = *Find(errors, unprotected);
  if (base < kLeastRatio * *oracle) {
    return fmt::format(": movers cost {} next to nothing here", unprotected);
  }
  std::vector<std::string> parts;
  for (const auto& [system, ate_m] : errors.ate_m) {
    if (system == "oracle" || system == unprotected || system == "plain") continue;
    parts.push_back(ate_m >= base ? system + " wins nothing back"
                                  : fmt::format("{} wins back {}", system,
                                                PercentInWords(std::min(
                                                    (base - ate_m) / (base - *oracle), 1.0))));
  }
  if (parts.empty()) {
    return fmt::format(": a perfect mask wins back {} of it", PercentInWords(1 - *oracle / base));
  }
  return fmt::format(": of what movers cost {}, {}", unprotected, Listed(parts));
}

std::string Sentence(const SceneErrors& errors) {
  std::vector<std::string> parts;
  for (const auto& [system, ate_m] : errors.ate_m) {
    parts.push_back(
        fmt::format("{}{} by {}", system, parts.empty() ? " is off" : "", LengthInWords(ate_m)));
  }
  for (const std::string& system : errors.lost) parts.push_back(system + " has no error to tell");
  return fmt::format("On {}, {}{}.", errors.scene, Listed(parts), WonBack(errors));
}

}  // namespace

std::string LengthInWords(double metres) {
  if (metres >= 1) return fmt::format("{:.2f} m", metres);
  if (metres >= 0.1) return fmt::format("{:.0f} cm", 100 * metres);
  if (metres >= 0.001) return fmt::format("{:.1f} cm", 100 * metres);
  return fmt::format("{:.1f} mm", 1000 * metres);
}

std::vector<std::string> AnswerInWords(const Results& results) {
  std::vector<SceneErrors> scenes = CollectErrors(results);
  std::erase_if(scenes, [](const SceneErrors& errors) { return errors.ate_m.empty(); });
  std::stable_sort(scenes.begin(), scenes.end(),
                   [](const SceneErrors& a, const SceneErrors& b) { return Worst(a) > Worst(b); });
  std::vector<std::string> sentences;
  for (const SceneErrors& errors : scenes) {
    if (sentences.size() == kMostSentences) break;
    sentences.push_back(Sentence(errors));
  }
  if (scenes.size() > kMostSentences) {
    sentences.push_back(fmt::format("These are the {} scenes with the largest errors of {}.",
                                    kMostSentences, scenes.size()));
  }
  return sentences;
}

}  // namespace aisle
