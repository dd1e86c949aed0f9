#include "harness/report/block/score_table.h"

#include "harness/io/input_error.h"
#include "harness/io/nearest_word.h"
#include "harness/record/group.h"
#include "harness/report/block/markdown_text.h"

namespace aisle {
namespace {

/// Of the first run that has the score. Throws InputError where none has.
std::string UnitOf(const Results& results, const std::string& score) {
  std::vector<std::string> known;
  for (const RunRecord& run : results.runs) {
    const auto found = run.scores.find(score);
    if (found != run.scores.end() && found->second.value) return found->second.unit;
    for (const auto& [name, value] : run.scores) known.push_back(name);
  }
  const std::string near = NearestWord(score, known);
  throw InputError(fmt::format("no run has the score '{}'{}{}{}", Printable(score),
                               near.empty() ? "" : "; did you mean ", near,
                               near.empty() ? "" : "?"));
}

/// Four significant digits: what a reader compares.
std::string Cell(const std::vector<const RunRecord*>& runs, const std::string& score) {
  const std::optional<double> median = MedianScore(runs, score);
  if (!median) return "-";
  const std::vector<double> values = ScoresOf(runs, score);
  if (values.size() < 2) return fmt::format("{:.4g}", *median);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return fmt::format("{:.4g} ({:.4g} to {:.4g})", *median, *least, *most);
}

/// Whether such runs are asked for any of the scores: an empty twin has no dynamic penalty. Where
/// they are and have no value, or failed, a reader must see it.
bool AreAsked(const std::vector<const RunRecord*>& runs, const std::vector<std::string>& scores) {
  return std::ranges::any_of(runs, [&](const RunRecord* run) {
    return run->status != RunStatus::kOk || std::ranges::any_of(scores, [&](const auto& score) {
             return run->scores.contains(score);
           });
  });
}

}  // namespace

std::string ScoreTable(const Results& results, const std::vector<std::string>& scores) {
  std::string names = "| scene | twin | system | runs |", rule = "|---|---|---|---|", rows;
  for (const std::string& score : scores) {
    const std::string unit = UnitOf(results, score);
    names += fmt::format(" {}{} |", MarkdownText(score), unit == "1" ? "" : ", " + unit);
    rule += "---|";
  }
  for (const SceneRuns& scene : GroupByScene(results)) {
    for (const SystemRuns& system : scene.systems) {
      if (!AreAsked(system.runs, scores)) continue;
      rows +=
          fmt::format("| {} | {} | {} | {} |", MarkdownText(scene.scene), MarkdownText(scene.twin),
                      MarkdownText(system.system), system.runs.size());
      for (const std::string& score : scores) {
        rows += fmt::format(" {} |", Cell(system.runs, score));
      }
      rows += "\n";
    }
  }
  return fmt::format("{}\n{}\n{}", names, rule, rows);
}

}  // namespace aisle
