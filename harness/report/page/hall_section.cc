#include "harness/report/page/hall_section.h"

#include "harness/report/markup/html.h"
#include "harness/report/page/parts.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// The runs of each system in one hall.
using HallRuns = std::map<std::string, std::vector<const RunRecord*>>;

/// By hall, in the order of the alphabet; scenes without one first.
std::map<std::string, HallRuns> GroupByHall(const std::vector<SceneRuns>& scenes) {
  std::map<std::string, HallRuns> halls;
  for (const SceneRuns& scene : scenes) {
    for (const SystemRuns& system : scene.systems) {
      for (const RunRecord* run : system.runs) halls[run->hall][system.system].push_back(run);
    }
  }
  return halls;
}

std::string Cell(const HallRuns& hall, const std::string& system) {
  const auto runs = hall.find(system);
  if (runs == hall.end()) return "<td class=\"soft\">";
  const std::vector<double> errors = ScoresOf(runs->second, "ate_rmse_m");
  if (errors.empty()) return "<td>-";
  return fmt::format("<td>{:.2f} <span class=\"soft\">of {}</span>", 100 * Quantile(errors, 0.5),
                     errors.size());
}

}  // namespace

std::string HallSection(const std::vector<SceneRuns>& scenes) {
  const std::map<std::string, HallRuns> halls = GroupByHall(scenes);
  if (halls.size() < 2) return "";
  const auto systems = SystemsInOrder(scenes);
  std::string text = "<h2 id=\"halls\">By hall</h2>\n<div class=\"wide\"><table><tr><th>hall";
  for (const auto& [name, style] : systems) text += "<th>" + Chip(style) + Escape(name);
  text += "\n";
  for (const auto& [hall, runs] : halls) {
    text += "<tr><td>" + (hall.empty() ? "the scene's own" : Escape(hall));
    for (const auto& [name, style] : systems) text += Cell(runs, name);
    text += "\n";
  }
  return text +
         "</table></div>\n<p class=\"soft small\">Median RMSE over the final track in "
         "centimetres, of that many drives that came to an end, a seed of a scene each. Halls meet "
         "different scenes: compare "
         "within a row.</p>\n";
}

}  // namespace aisle
