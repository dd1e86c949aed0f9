#include "harness/report/summary_text.h"

#include "harness/io/input_error.h"
#include "harness/judge/gate.h"
#include "harness/report/page/answer.h"
#include "harness/report/page/parts.h"
#include "harness/report/page/verdict_words.h"

namespace aisle {
namespace {

constexpr std::size_t kBroken = 6, kChanges = 5, kWidth = 160;

std::string Headline(const Results& results, std::size_t limits) {
  const std::string verdicts = VerdictsInWords(results.verdicts, limits);
  const std::string failed = FailedAndLost(results.runs);
  return fmt::format(
      "{}: {}, {}", results.suite, verdicts.empty() ? "nothing was judged" : verdicts,
      failed.empty() ? fmt::format("0 of {} runs failed", results.runs.size()) : failed);
}

/// At most so many of the lines, and how many more there are.
void Append(const std::vector<std::string>& lines, std::size_t most, std::string* text) {
  for (std::size_t i = 0; i < std::min(lines.size(), most); ++i) {
    *text += "  " + Printable(lines[i], kWidth) + "\n";
  }
  if (lines.size() > most) *text += fmt::format("  and {} more\n", lines.size() - most);
}

}  // namespace

std::string ToSummaryText(const Results& results, const std::vector<std::string>& changes,
                          const std::filesystem::path& report_dir, std::size_t limits) {
  std::vector<std::string> broken;
  for (const Verdict& verdict : results.verdicts) {
    if (!verdict.passed) broken.push_back(verdict.name + ": " + verdict.why);
  }
  std::string text = Printable(Headline(results, limits), kWidth) + "\n";
  Append(broken, kBroken, &text);
  for (const Verdict& verdict : results.verdicts) {
    if (verdict.name == kWithoutBaseline) text += "  " + Printable(verdict.why, kWidth) + "\n";
  }
  if (!changes.empty()) text += "other than before:\n";
  Append(changes, kChanges, &text);
  constexpr std::size_t kSentences = 2;  // of the answer: the rest is on the page
  const std::vector<std::string> answer = AnswerInWords(results);
  for (std::size_t i = 0; i < std::min(answer.size(), kSentences); ++i) {
    text += Printable(answer[i], kWidth) + "\n";
  }
  return text + fmt::format("report: {}\nagain:  {}\naisle {} ({}), {}\n",
                            Printable((report_dir / "index.html").string(), kWidth),
                            Printable(results.rerun, 4096), results.provenance.version,
                            results.provenance.commit, Printable(results.started, 40));
}

}  // namespace aisle
