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

std::string Painted(const std::string& text, const char* code, bool color) {
  return color ? fmt::format("\x1b[{}m{}\x1b[0m", code, text) : text;
}

}  // namespace

std::string ToConsole(const Results& results, bool color) {
  std::size_t width = 20;
  for (const RunRecord& run : results.runs) width = std::max(width, RunId(run.spec).size());
  std::string text = fmt::format("\n{:{}}  {:8}", "run", width, "status");
  for (const Column& column : kColumns) text += fmt::format(" {:>11}", column.title);
  text += "\n";
  for (const RunRecord& run : results.runs) {
    const std::string status = fmt::format("{:8}", Name(run.status));
    text += fmt::format("{:{}}  {}", RunId(run.spec), width,
                        Painted(status, run.status == RunStatus::kOk ? "32" : "31", color));
    for (const Column& column : kColumns) text += fmt::format(" {:>11}", Cell(run, column));
    text += run.status_why.empty() ? "\n" : "  " + Printable(run.status_why, 120) + "\n";
  }
  text += "\n";
  for (const std::string& sentence : AnswerInWords(results)) text += sentence + "\n";
  std::size_t failed = 0;
  for (const Verdict& verdict : results.verdicts) {
    failed += verdict.passed ? 0 : 1;
    if (verdict.name == kWithoutBaseline) continue;  // said last, where it is not overlooked
    text +=
        fmt::format("{}  {}: {}\n",
                    verdict.passed ? Painted("pass", "32", color) : Painted("FAIL", "31;1", color),
                    verdict.name, verdict.why);
  }
  if (results.verdicts.empty()) {
    text += "no limits in this suite: nothing was judged\n";
  } else {
    text += fmt::format("{} of {} verdicts passed\n", results.verdicts.size() - failed,
                        results.verdicts.size());
  }
  for (const Verdict& verdict : results.verdicts) {
    if (verdict.name == kWithoutBaseline) text += verdict.why + "\n";
  }
  return text;
}

}  // namespace aisle
