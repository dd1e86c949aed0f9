#include "harness/report/page/overview_section.h"

#include "harness/report/markup/html.h"
#include "harness/report/page/parts.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// "7/9 ok" or "7/9 ok, 1 lost" beside the median of those that have an error; the status of a run
/// that is alone. Nothing where all is well.
std::string StatusMark(const SystemRuns& system) {
  std::size_t good = 0, lost = 0;
  for (const RunRecord* run : system.runs) {
    good += run->status == RunStatus::kOk ? 1 : 0;
    lost += run->status == RunStatus::kLost ? 1 : 0;
  }
  if (good == system.runs.size()) return "";
  const std::string mark = system.runs.size() == 1
                               ? Name(system.runs.front()->status)
                               : fmt::format("{}/{} ok{}", good, system.runs.size(),
                                             lost > 0 ? fmt::format(", {} lost", lost) : "");
  return fmt::format(" <span class=\"fail\">{}</span>", mark);
}

std::optional<double> MedianOf(const SystemRuns& system, const char* score) {
  const std::vector<double> values = ScoresOf(system.runs, score);
  return values.empty() ? std::nullopt : std::optional(Quantile(values, 0.5));
}

std::string ErrorCell(const SystemRuns& system, const std::optional<double>& least_m) {
  const auto ate_m = MedianOf(system, "ate_rmse_m"), coverage = MedianOf(system, "coverage");
  std::string cell = ate_m ? fmt::format("{:.2f}", 100 * *ate_m) : "-";
  if (coverage && *coverage < 0.9995) cell += fmt::format(" ({:.1f} %)", 100 * *coverage);
  const bool is_best = ate_m && ate_m == least_m && AreWholeDrives(system.runs);
  return fmt::format("<td class=\"{}\">{}{}", is_best ? "best" : "", cell, StatusMark(system));
}

std::string SceneRow(const SceneRuns& scene,
                     const std::vector<std::pair<std::string, int>>& systems, SceneLinks links) {
  std::optional<double> least_m;
  for (const SystemRuns& system : scene.systems) {
    const auto ate_m = MedianOf(system, "ate_rmse_m");
    if (!ate_m || !AreWholeDrives(system.runs)) continue;
    if (!least_m || *ate_m < *least_m) least_m = ate_m;
  }
  std::string row = fmt::format("<tr><td><a href=\"{}\">{}</a><td class=\"left\">{}",
                                LinkTo(scene, links), Escape(scene.scene), Escape(scene.twin));
  for (const auto& [name, style] : systems) {
    const auto system = std::find_if(scene.systems.begin(), scene.systems.end(),
                                     [&, n = name](const SystemRuns& s) { return s.system == n; });
    row += system == scene.systems.end() ? "<td class=\"soft\">" : ErrorCell(*system, least_m);
  }
  return row + "\n";
}

/// What it is, in its own terms.
std::string Description(const SystemSpec& system,
                        const std::map<std::string, std::string>& sentences) {
  if (system.external) return "<code>" + Escape(system.external->command) + "</code>";
  const auto sentence = sentences.find(system.like);
  std::string text = sentence == sentences.end() ? "" : Escape(sentence->second);
  if (system.like != system.name || text.empty()) {
    const std::string like = system.like == system.name ? "ours" : "like " + Escape(system.like);
    text = text.empty() ? like : fmt::format("{} ({})", like, text);
  }
  for (const auto& [path, value] : system.options) {
    text += fmt::format(", {} {}", Escape(path), Escape(value));
  }
  return text;
}

}  // namespace

std::string OverviewSection(const std::vector<SceneRuns>& scenes, SceneLinks links) {
  const auto systems = SystemsInOrder(scenes);
  std::string text =
      "<h2 id=\"errors\">Absolute trajectory error</h2>\n<div class=\"wide\"><table>"
      "<tr><th>scene<th class=\"left\">twin";
  for (const auto& [name, style] : systems) text += "<th>" + Chip(style) + Escape(name);
  text += "\n";
  for (const SceneRuns& scene : scenes) text += SceneRow(scene, systems, links);
  return text +
         "</table></div>\n<p class=\"soft small\">RMSE over the final track in centimetres, "
         "positions aligned rigidly (SE(3)), never scaled; median over the finished seeds; "
         "coverage where it is incomplete. Bold: the smallest of each row among the systems all of "
         "whose runs finished with a pose for 99 % of the frames.</p>\n";
}

std::string SystemsSection(const std::vector<SceneRuns>& scenes,
                           const std::map<std::string, std::string>& sentences) {
  std::string rows;
  for (const auto& [name, style] : SystemsInOrder(scenes)) {
    for (const SceneRuns& scene : scenes) {
      const auto system = std::find_if(scene.systems.begin(), scene.systems.end(),
                                       [&, n = name](const auto& s) { return s.system == n; });
      if (system == scene.systems.end()) continue;
      const RunRecord& run = *system->runs.front();
      rows += fmt::format("<tr><td>{}<td class=\"left\">{}<td class=\"wrap\">{}\n", NameOf(*system),
                          Escape(run.system_version), Description(run.spec.system, sentences));
      break;
    }
  }
  return "<h2 id=\"systems\">The systems</h2>\n<div class=\"wide\"><table><tr><th>system<th "
         "class=\"left\">version<th class=\"left\">what it is\n" +
         rows + "</table></div>\n";
}

}  // namespace aisle
