#include "harness/report/console.h"

#include "harness/io/input_error.h"
#include "harness/judge/gate.h"
#include "harness/report/page/answer.h"

namespace aisle {
namespace {

struct Column {
  const char* title;
  const char* score;
  double factor;  ///< from the score's unit to the column's
  int decimals;
};
// What a person reads in the morning; results.json has the rest.
constexpr Column kColumns[] = {{"ATE [cm]", "ate_rmse_m", 100, 2},
                               {"max [cm]", "ate_max_m", 100, 2},
                               {"RPE 1s [cm]", "rpe_1s_trans_rmse_m", 100, 2},
                               {"covered", "coverage", 100, 1},
                               {"on movers", "features_on_movers", 100, 1},
                               {"step [ms]", "ms_process_mean", 1, 1}};

std::string Cell(const RunRecord& run, const Column& column) {
  const auto score = run.scores.find(column.score);
  if (score == run.scores.end() || !score->second.value) return "-";
  const bool percent = score->second.unit == "1";
  return fmt::format("{:.{}f}{}", *score->second.value * column.factor, column.decimals,
                     percent ? " %" : "");
}

std::vector<std::string> Cells(const RunRecord& run, bool color) {
  std::vector<std::string> cells = {
      Painted(Name(run.status), run.status == RunStatus::kOk ? "32" : "31", color)};
  for (const Column& column : kColumns) cells.push_back(Cell(run, column));
  return cells;
}

std::string RunTable(const std::vector<RunRecord>& runs, const TextLook& look) {
  TextTable::Column name{.title = "run", .width = 0};
  std::vector<TextTable::Column> columns = {{.title = "status", .width = 0, .is_left = true}};
  for (const Column& column : kColumns) columns.push_back({.title = column.title});
  for (const RunRecord& run : runs) {
    name.width = std::max(name.width, RunId(run.spec).size());
    TextTable::Hold(Cells(run, look.color), &columns);
  }
  TextTable table(name, columns, look.width);
  std::string text = table.Heading();
  for (const RunRecord& run : runs) {
    text += table.Row(RunId(run.spec), Cells(run, look.color), Printable(run.status_why, 120));
  }
  return text;
}

/// What was said last stands nearest to the prompt, and is not overlooked.
std::string VerdictLines(const std::vector<Verdict>& verdicts, const TextLook& look) {
  if (verdicts.empty()) return "no limits in this suite: nothing was judged\n";
  std::string failures, without_baseline;
  std::size_t failed = 0;
  for (const Verdict& verdict : verdicts) {
    if (verdict.name == kWithoutBaseline)
      without_baseline = Wrapped(verdict.why, look.width) + "\n";
    if (verdict.passed) continue;
    ++failed;
    constexpr std::size_t kAfterWord = 6;
    failures += Wrapped(fmt::format("{}  {}: {}", Painted("FAIL", "31;1", look.color), verdict.name,
                                    verdict.why),
                        look.width, kAfterWord) +
                "\n";
  }
  const std::string count =
      fmt::format("{} of {} verdicts passed", verdicts.size() - failed, verdicts.size());
  if (failed == 0) return Painted(count, "32", look.color) + "\n" + without_baseline;
  return fmt::format("{}{}{}, {}\n", without_baseline, failures, count,
                     Painted(fmt::format("{} failed", failed), "31;1", look.color));
}

}  // namespace

std::string ToConsole(const Results& results, const TextLook& look) {
  std::string text = fmt::format("\n{}\n", RunTable(results.runs, look));
  for (const std::string& sentence : AnswerInWords(results)) {
    text += Wrapped(sentence, look.width) + "\n";
  }
  return text + VerdictLines(results.verdicts, look);
}

}  // namespace aisle
