#include "harness/report/page/verdict_words.h"

#include <set>
#include <tuple>

#include "harness/common/counted.h"

namespace aisle {
namespace {

// How judge and gate name them.
bool IsOfRun(const Verdict& verdict) { return verdict.name.ends_with(": completes"); }
bool IsOfBaseline(const Verdict& verdict) {
  return verdict.name.ends_with(" against the baseline") || verdict.name.ends_with(": baseline");
}

/// "2 limits and the baseline, in 3 cells"; empty where runs alone were judged.
std::string WhatWasHeld(const std::vector<Verdict>& verdicts, std::size_t limits) {
  std::set<std::tuple<std::string, std::string, std::string>> cells;
  std::set<std::string> scores;
  bool baseline = false;
  for (const Verdict& verdict : verdicts) {
    if (IsOfRun(verdict) || verdict.system.empty()) continue;
    // One over all cells of a system names no scene.
    if (!verdict.scene.empty()) cells.emplace(verdict.scene, verdict.twin, verdict.system);
    if (IsOfBaseline(verdict)) {
      baseline = true;
    } else {
      scores.insert(ScoreOf(verdict));
    }
  }
  std::string text;
  if (!scores.empty()) {
    text = limits > 0 ? Counted(limits, "limit") : "limits on " + Counted(scores.size(), "score");
  }
  if (baseline) text += text.empty() ? "the baseline" : " and the baseline";
  return text.empty() ? "" : fmt::format(" ({}, in {})", text, Counted(cells.size(), "cell"));
}

}  // namespace

std::string ScoreOf(const Verdict& verdict) {
  const std::size_t colon = verdict.name.rfind(": ");
  if (colon == std::string::npos) return "";
  const std::string rest = verdict.name.substr(colon + 2);
  return rest.substr(0, rest.find(' '));
}

std::string VerdictsInWords(const std::vector<Verdict>& verdicts, std::size_t limits) {
  if (verdicts.empty()) return "";
  const auto failed = std::count_if(verdicts.begin(), verdicts.end(),
                                    [](const Verdict& verdict) { return !verdict.passed; });
  const std::string count =
      failed == 0 ? fmt::format("{} of {} verdicts passed", verdicts.size(), verdicts.size())
                  : fmt::format("{} of {} verdicts failed", failed, verdicts.size());
  return count + WhatWasHeld(verdicts, limits);
}

}  // namespace aisle
