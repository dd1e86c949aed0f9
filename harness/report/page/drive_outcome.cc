#include "harness/report/page/drive_outcome.h"

#include <algorithm>

#include "harness/contract/stream.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/answer.h"
#include "harness/report/page/parts.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

double ValueOf(const RunRecord& run, const char* score) {
  const auto at = run.scores.find(score);
  return at == run.scores.end() ? 0 : at->second.value.value_or(0);
}

/// "misses its goal" of all runs, "misses its goal in 2 of 9" of some, nothing of none.
void AddWrong(const std::string& what, std::size_t count, std::size_t runs,
              std::vector<std::string>* wrongs) {
  if (count == 0) return;
  wrongs->push_back(count == runs ? what : fmt::format("{} in {} of {}", what, count, runs));
}

std::string Cell(const DriveOutcome& outcome, bool is_best) {
  const std::string docking = !outcome.drove() ? ""
                              : outcome.docking_m < 1
                                  ? fmt::format("{:.1f} mm", 1000 * outcome.docking_m)
                                  : fmt::format("{:.2f} m", outcome.docking_m);
  const std::string wrongs = WrongsInWords(outcome);
  // Rows are sorted by the length, whatever unit it is told in.
  const std::string value =
      outcome.drove() ? fmt::format(" data-value=\"{:.6g}\"", outcome.docking_m) : "";
  return fmt::format("<td class=\"{}\"{}>{}{}", is_best ? "best" : "", value, docking,
                     wrongs.empty() ? ""
                                    : (docking.empty() ? "" : "<br>") +
                                          ("<span class=\"fail\">" + wrongs + "</span>"));
}

bool CanSteer(const SystemRuns& system) {
  const auto& external = system.runs.front()->spec.system.external;
  return !external || IsStream(*external);
}

DriveOutcome OutcomeOf(const std::vector<const RunRecord*>& runs) {
  DriveOutcome outcome{.runs = runs.size()};
  for (const RunRecord* run : runs) {
    const auto end = run->scores.find("docking_error_m");
    if (end == run->scores.end() || !end->second.value) {
      ++outcome.undriven;
      continue;
    }
    const double things = ValueOf(*run, "collisions_static"),
                 people = ValueOf(*run, "collisions_person");
    outcome.missed += ValueOf(*run, "goal_reached") < 1 ? 1 : 0;
    outcome.hit_things += things > 0 ? 1 : 0;
    outcome.hit_people += people > 0 ? 1 : 0;
    outcome.hit_others += ValueOf(*run, "collisions") > things + people ? 1 : 0;
  }
  const std::vector<double> docking = ScoresOf(runs, "docking_error_m");
  if (!docking.empty()) outcome.docking_m = Quantile(docking, 0.5);
  return outcome;
}

}  // namespace

std::vector<std::pair<std::string, DriveOutcome>> OutcomesOf(const SceneRuns& scene) {
  std::vector<std::pair<std::string, DriveOutcome>> outcomes;
  bool any_drove = false;
  for (const SystemRuns& system : scene.systems) {
    const DriveOutcome outcome = OutcomeOf(system.runs);
    any_drove = any_drove || outcome.drove();
    if (outcome.drove() || CanSteer(system)) outcomes.emplace_back(system.system, outcome);
  }
  if (!any_drove) outcomes.clear();
  return outcomes;
}

std::string WrongsInWords(const DriveOutcome& outcome) {
  std::vector<std::string> wrongs;
  AddWrong("never drives", outcome.undriven, outcome.runs, &wrongs);
  AddWrong("misses its goal", outcome.missed, outcome.runs, &wrongs);
  AddWrong("touches what stands", outcome.hit_things, outcome.runs, &wrongs);
  AddWrong("runs into people", outcome.hit_people, outcome.runs, &wrongs);
  AddWrong("runs into vehicles", outcome.hit_others, outcome.runs, &wrongs);
  return Listed(wrongs);
}

std::string DriveSentence(const SceneRuns& scene) {
  std::vector<std::string> parts;
  for (const auto& [system, outcome] : OutcomesOf(scene)) {
    const std::string wrongs = WrongsInWords(outcome);
    parts.push_back(outcome.drove() ? fmt::format("{} ends {} from its goal{}", system,
                                                  LengthInWords(outcome.docking_m),
                                                  wrongs.empty() ? "" : " (" + wrongs + ")")
                                    : fmt::format("{} {}", system, wrongs));
  }
  return parts.empty() ? "" : fmt::format("On {}, {}.", scene.scene, Listed(parts));
}

std::string DriveOverview(const std::vector<SceneRuns>& scenes, SceneLinks links) {
  const auto systems = SystemsInOrder(scenes);
  std::string rows;
  for (const SceneRuns& scene : scenes) {
    std::map<std::string, DriveOutcome> outcomes;
    std::optional<double> least_m;
    for (const auto& [system, outcome] : OutcomesOf(scene)) {
      outcomes[system] = outcome;
      if (outcome.is_clean() && (!least_m || outcome.docking_m < *least_m)) {
        least_m = outcome.docking_m;
      }
    }
    if (outcomes.empty()) continue;
    rows += fmt::format("<tr><td><a href=\"{}\">{}</a><td class=\"left\">{}", LinkTo(scene, links),
                        Escape(scene.scene), Escape(scene.twin));
    for (const auto& [name, style] : systems) {
      const auto at = outcomes.find(name);
      rows += at == outcomes.end()
                  ? "<td class=\"soft\">"
                  : Cell(at->second, at->second.is_clean() && at->second.docking_m == least_m);
    }
    rows += "\n";
  }
  if (rows.empty()) return "";
  std::string text =
      "<h2 id=\"drives\">Where the vehicles ended</h2>\n<div class=\"wide\"><table>"
      "<tr><th>scene<th class=\"left\">twin";
  for (const auto& [name, style] : systems) text += "<th>" + Chip(style) + Escape(name);
  return text + "\n" + rows +
         "</table></div>\n<p class=\"soft small\">The true vehicle's distance from its goal when "
         "its drive was over, median over the seeds that drove, and what went wrong. Bold is the "
         "least of each "
         "row among the systems of which every drive reached its goal and touched nothing.</p>\n";
}

}  // namespace aisle
