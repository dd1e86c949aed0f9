#include "harness/report/page/verdict_section.h"

#include <limits>

#include "harness/report/markup/html.h"
#include "harness/report/page/answer.h"
#include "harness/report/page/parts.h"
#include "harness/report/page/verdict_words.h"
#include "harness/score/significance.h"

namespace aisle {
namespace {

bool Failed(const RunRecord& run) { return !IsComplete(run.status); }

/// The name leads to the page of the scene it is about, where there is one.
std::string VerdictItem(const Verdict& verdict, const std::vector<SceneRuns>& scenes,
                        SceneLinks links, const SinceNotes& since) {
  const char* css = verdict.passed ? "pass" : verdict.flaky ? "flaky" : "fail";
  const char* word = verdict.passed ? "held" : verdict.flaky ? "FLAKY" : "BROKEN";
  const auto scene = std::find_if(scenes.begin(), scenes.end(), [&](const SceneRuns& one) {
    return one.scene == verdict.scene && one.twin == verdict.twin;
  });
  const std::string name =
      scene == scenes.end()
          ? Escape(verdict.name)
          : fmt::format("<a href=\"{}\">{}</a>", LinkTo(*scene, links), Escape(verdict.name));
  const auto note = since.find({verdict.scene, verdict.twin, verdict.system, ScoreOf(verdict)});
  return fmt::format("<li><span class=\"{}\">{}</span> {}: {}{}\n", css, word, name,
                     Escape(verdict.why),
                     verdict.passed || note == since.end() ? "" : "; " + note->second);
}

std::string Headline(const Results& results, std::size_t limits, std::size_t flaky) {
  const std::string runs = FailedAndLost(results.runs);
  if (results.verdicts.empty()) {
    return runs.empty() ? "Nothing was judged: the suite sets no limits"
                        : runs + "; the suite sets no limits";
  }
  std::string text = VerdictsInWords(results.verdicts, limits);
  if (flaky > 0) text += fmt::format(", {} of them flaky", flaky);
  return runs.empty() ? text : text + "; " + runs;
}

/// A list whose tail is folded away; `word` says what the tail holds.
std::string List(const std::vector<std::string>& items, const std::string& word) {
  constexpr std::size_t kShownAtOnce = 12;
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i == kShownAtOnce) {
      text +=
          fmt::format("</ul><details><summary>{} more {}</summary><ul>\n", items.size() - i, word);
    }
    text += items[i];
  }
  const bool folded = items.size() > kShownAtOnce;
  return fmt::format("<ul>\n{}</ul>{}\n", text, folded ? "</details>" : "");
}

/// "; 95 % sure, fewer than 8.3 % do"; nothing where the bound is none.
std::string BoundInWords(double percent) {
  if (percent >= 99.5) return "";
  const std::string figure =
      percent < 10 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);
  return fmt::format(": 95 % sure, fewer than {} % do", figure);
}

/// How many runs failed, and what so many runs can say of the next ones.
std::string FailureRate(const std::vector<RunRecord>& runs) {
  const auto failed = static_cast<std::size_t>(std::count_if(runs.begin(), runs.end(), Failed));
  constexpr std::size_t kWorthSaying = 20;  // below, the bound is no news
  if (failed == 0 && runs.size() < kWorthSaying) return "";
  return fmt::format(
      "<p class=\"soft small\">{} of {} runs crashed, hung or answered nonsense{}.</p>\n",
      failed == 0 ? "None" : std::to_string(failed), runs.size(),
      BoundInWords(100 * FailureRateBound(failed, runs.size())));
}

/// How far beyond its limit, as a share of it; what has no number is worst.
double Excess(const Verdict& verdict) {
  if (!verdict.value || !verdict.limit) return std::numeric_limits<double>::infinity();
  const double distance = std::abs(*verdict.value - *verdict.limit);
  return distance / std::max(std::abs(*verdict.limit), 1e-12);
}

}  // namespace

std::string VerdictSection(const Results& results, const std::vector<SceneRuns>& scenes,
                           SceneLinks links, const SinceNotes& since, std::size_t limits) {
  std::vector<Verdict> worst_first = results.verdicts;
  std::stable_sort(worst_first.begin(), worst_first.end(),
                   [](const Verdict& a, const Verdict& b) { return Excess(a) > Excess(b); });
  std::size_t flaky = 0;
  std::vector<std::string> failed, passed;
  for (const Verdict& verdict : worst_first) {
    if (!verdict.passed) failed.push_back(VerdictItem(verdict, scenes, links, since));
    flaky += verdict.flaky ? 1 : 0;
  }
  for (const Verdict& verdict : results.verdicts) {
    if (verdict.passed) passed.push_back(VerdictItem(verdict, scenes, links, since));
  }
  const bool any_failed = std::any_of(results.runs.begin(), results.runs.end(), Failed);
  const char* css = !failed.empty() || any_failed ? "failed"
                    : results.verdicts.empty()    ? ""
                                                  : "passed";
  std::string lists = failed.empty() ? "" : List(failed, "broken, the worst above");
  if (!passed.empty()) {
    const std::string held = List(passed, "held");
    constexpr std::size_t kShownHeld = 3;  // what held is no news
    lists +=
        failed.empty() && passed.size() <= kShownHeld
            ? held
            : fmt::format("<details><summary>{} held</summary>{}</details>", passed.size(), held);
  }
  std::string answer;
  for (const std::string& sentence : AnswerInWords(results)) {
    answer += "<p class=\"answer\">" + Escape(sentence) + "</p>\n";
  }
  return fmt::format(
      "<h1>{}</h1>\n<p class=\"soft\">{}</p>\n{}<div class=\"verdict {}\"><strong>{}</strong>{}"
      "</div>\n{}",
      Escape(ReportTitle(results)), Escape(results.question), answer, css,
      Headline(results, limits, flaky), lists, FailureRate(results.runs));
}

}  // namespace aisle
