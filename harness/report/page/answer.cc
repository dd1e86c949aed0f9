#include "harness/report/page/answer.h"

#include <functional>
#include <set>

#include "harness/common/first_of_many.h"
#include "harness/contract/twin.h"
#include "harness/judge/twins.h"
#include "harness/record/seed_values.h"
#include "harness/report/page/drive_outcome.h"
#include "harness/report/page/parts.h"
#include "harness/score/statistics.h"
#include "harness/systems/traits.h"

namespace aisle {
namespace {

constexpr std::size_t kMostSentences = 3;  ///< more is a table, which stands below

struct SystemError {
  SystemSpec system;
  double ate_m = 0;      ///< of the seeds that have one
  bool is_whole = true;  ///< AreWholeDrives: may be held against another's
  double coverage = 1;   ///< [0, 1], of these seeds
  std::size_t with_error = 0, seeds = 0;
};

/// The systems of one scene as written, in the order of the suite, with their median errors.
struct SceneErrors {
  std::string scene;
  std::vector<SystemError> known;
  std::vector<std::string> lost;  ///< systems of which no run has an error
  std::string drives = {};        ///< how those that steer ended, in words; empty: nobody steers
  double worst_docking_m = 0;
  bool any_touched = false, any_missed = false;  ///< of the drives
};

/// The first system of the scene of which this is true; null for none.
const SystemError* Find(const SceneErrors& errors,
                        const std::function<bool(const SystemSpec&)>& is) {
  const auto at = std::find_if(errors.known.begin(), errors.known.end(),
                               [&](const SystemError& one) { return is(one.system); });
  return at == errors.known.end() ? nullptr : &*at;
}

/// How badly a scene went: a contact is worse than a goal that was missed or a drive without a
/// trajectory, and that is worse than any length.
std::pair<int, double> Badness(const SceneErrors& errors) {
  if (!errors.drives.empty()) {
    return {errors.any_touched ? 2 : errors.any_missed ? 1 : 0, errors.worst_docking_m};
  }
  double worst_m = 0;
  for (const SystemError& one : errors.known) worst_m = std::max(worst_m, one.ate_m);
  return {errors.lost.empty() ? 0 : 1, worst_m};
}

std::vector<SceneErrors> CollectErrors(const Results& results) {
  std::vector<SceneErrors> collected;
  for (const SceneRuns& scene : GroupByScene(results)) {
    if (scene.twin != twin::kLive) continue;
    SceneErrors& of_scene = collected.emplace_back(SceneErrors{scene.scene, {}, {}});
    of_scene.drives = DriveSentence(scene);
    for (const auto& [system, outcome] : OutcomesOf(scene)) {
      of_scene.worst_docking_m = std::max(of_scene.worst_docking_m, outcome.docking_m);
      of_scene.any_touched |= outcome.hit_things + outcome.hit_people + outcome.hit_others > 0;
      of_scene.any_missed |= outcome.missed + outcome.undriven > 0;
    }
    for (const SystemRuns& system : scene.systems) {
      const std::vector<double> errors_m = ScoresOf(system.runs, "ate_rmse_m");
      if (errors_m.empty()) {
        of_scene.lost.push_back(system.system);
        continue;
      }
      const std::vector<double> coverage = ScoresOf(system.runs, "coverage");
      const bool whole = AreWholeDrives(system.runs) && AllHave(system.runs, "ate_rmse_m");
      of_scene.known.push_back({.system = system.runs.front()->spec.system,
                                .ate_m = Quantile(errors_m, 0.5),
                                .is_whole = whole,
                                .coverage = coverage.empty() ? 1 : Quantile(coverage, 0.5),
                                .with_error = errors_m.size(),
                                .seeds = CountSeeds(system.runs)});
    }
  }
  return collected;
}

std::string PercentInWords(double share) {
  const double percent = 100 * share;
  return percent > 99 && percent < 100 ? fmt::format("{:.1f} %", percent)
                                       : fmt::format("{:.0f} %", percent);
}

/// What a rejection wins back of what movers cost the same system without it, beyond one that is
/// told the truth about them; nothing where one of the three is not there.
struct WonBack {
  const SystemError* without = nullptr;
  const SystemError* told = nullptr;  ///< the oracle on the same base
};

WonBack MeasureOf(const SceneErrors& errors, const SystemSpec& system) {
  return {Find(errors, [&](const auto& other) { return IsWithoutRejection(other, system); }),
          Find(errors, [&](const auto& other) {
            const SystemTraits traits = TraitsOf(other);
            return traits.masks == MaskSource::kDynamic && traits.method == "none" &&
                   traits.base == TraitsOf(system).base;
          })};
}

std::string WonBackInWords(const SceneErrors& errors) {
  constexpr double kLeastRatio = 1.5;  ///< below it is the noise of one drive
  std::vector<std::string> parts;
  std::set<std::string> calm;  // systems whom movers cost next to nothing
  for (const SystemError& one : errors.known) {
    const auto [without, told] = MeasureOf(errors, one.system);
    if (without == nullptr || told == nullptr || !told->is_whole) continue;
    if (without->ate_m < kLeastRatio * told->ate_m) {
      calm.insert(without->system.name);
    } else if (&one != told && one.is_whole) {
      const double share = (without->ate_m - one.ate_m) / (without->ate_m - told->ate_m);
      parts.push_back(
          share <= 0 ? one.system.name + " wins nothing back"
                     : fmt::format("{} wins back {} of what movers cost {}", one.system.name,
                                   PercentInWords(std::min(share, 1.0)), without->system.name));
    }
  }
  for (const std::string& name : calm) {
    parts.push_back(fmt::format("movers cost {} next to nothing here", name));
  }
  return parts.empty() ? "" : ": " + Listed(parts);
}

/// " in 8 of 9 seeds", " over the 49 % of the frames it has a pose for": of how much an error is
/// that is not of every run's whole drive.
std::string ExtentInWords(const SystemError& error) {
  constexpr double kWhole = 0.9995;  // what is said as 100 %
  std::string text;
  if (error.with_error < error.seeds) {
    text += fmt::format(" in {} of {} seeds", error.with_error, error.seeds);
  }
  if (!error.is_whole && error.coverage < kWhole) {
    text +=
        fmt::format(" over the {} of the frames it has a pose for", PercentInWords(error.coverage));
  }
  return text;
}

std::string Sentence(const SceneErrors& errors) {
  if (!errors.drives.empty()) return errors.drives;
  std::vector<std::string> parts;
  for (const SystemError& one : errors.known) {
    parts.push_back(fmt::format("{}{} by {}{}", one.system.name, parts.empty() ? " is off" : "",
                                LengthInWords(one.ate_m), ExtentInWords(one)));
  }
  for (const std::string& system : errors.lost) parts.push_back(system + " has no error to tell");
  return fmt::format("On {}, {}{}.", errors.scene, Listed(parts), WonBackInWords(errors));
}

}  // namespace

std::string ReportTitle(const Results& results) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= results.suite.size();) {
    const std::size_t end = std::min(results.suite.find('+', begin), results.suite.size());
    parts.push_back(results.suite.substr(begin, end - begin));
    begin = end + 1;
  }
  return FirstOfMany(parts, " + ");
}

std::string LengthInWords(double metres) {
  if (metres >= 1) return fmt::format("{:.2f} m", metres);
  if (metres >= 0.1) return fmt::format("{:.0f} cm", 100 * metres);
  if (metres >= 0.01) return fmt::format("{:.1f} cm", 100 * metres);
  return fmt::format("{:.1f} mm", 1000 * metres);
}

std::vector<std::string> AnswerInWords(const Results& results) {
  std::vector<SceneErrors> scenes = CollectErrors(results);
  std::erase_if(scenes, [](const SceneErrors& errors) {
    return errors.known.empty() && errors.drives.empty();
  });
  std::stable_sort(scenes.begin(), scenes.end(), [](const SceneErrors& a, const SceneErrors& b) {
    return Badness(a) > Badness(b);
  });
  std::vector<std::string> sentences;
  for (const SceneErrors& errors : scenes) {
    if (sentences.size() == kMostSentences) break;
    sentences.push_back(Sentence(errors));
  }
  if (scenes.size() > kMostSentences) {
    sentences.push_back(fmt::format("These are the {} scenes of {} that went worst.",
                                    kMostSentences, scenes.size()));
  }
  return sentences;
}

}  // namespace aisle
