#include "harness/report/page/parts.h"

#include "harness/record/record.h"
#include "harness/report/markup/html.h"

namespace aisle {

std::string SceneId(const SceneRuns& scene) {
  return SafeName(scene.scene) + "_" + SafeName(scene.twin);
}

std::string Chip(int style) { return fmt::format("<span class=\"chip c{}\"></span>", style); }

std::string NameOf(const SystemRuns& system) { return Chip(system.color) + Escape(system.system); }

std::string Figure(const std::string& content, const std::string& caption) {
  if (content.empty()) return "";
  return "<figure>" + content + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string Listed(const std::vector<std::string>& parts) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += i + 1 == parts.size() ? " and " : ", ";
    text += parts[i];
  }
  return text;
}

std::vector<const RunRecord*> CompleteOf(const std::vector<const RunRecord*>& runs) {
  std::vector<const RunRecord*> complete;
  std::ranges::copy_if(runs, std::back_inserter(complete),
                       [](const RunRecord* run) { return IsComplete(run->status); });
  return complete.empty() ? runs : complete;
}

std::string FailedAndLost(const std::vector<const RunRecord*>& runs) {
  const auto failed =
      std::ranges::count_if(runs, [](const RunRecord* run) { return !IsComplete(run->status); });
  const auto lost = std::ranges::count_if(
      runs, [](const RunRecord* run) { return run->status == RunStatus::kLost; });
  if (failed == 0 && lost == 0) return "";
  if (failed == 0) return fmt::format("{} of {} runs lost", lost, runs.size());
  return fmt::format("{} of {} runs failed{}", failed, runs.size(),
                     lost > 0 ? fmt::format(", {} lost", lost) : "");
}

std::string FailedAndLost(const std::vector<RunRecord>& runs) {
  std::vector<const RunRecord*> all;
  for (const RunRecord& run : runs) all.push_back(&run);
  return FailedAndLost(all);
}

std::string SeedOf(const RunSpec& spec) {
  if (spec.repeat == 1) return fmt::format("seed {}", spec.seed);
  return fmt::format("seed {}, drive {} over it", spec.seed, spec.repeat);
}

std::string LastWordsOf(const RunRecord& run, const std::string& root) {
  const auto log = run.artifacts.find("log");
  std::string link;
  if (log != run.artifacts.end()) {
    link = fmt::format(" (<a href=\"{}\">the whole log</a>)", root + EscapeUrl(log->second));
  }
  if (run.last_words.empty()) return "";
  return fmt::format("<details open><summary>its last words</summary><pre>{}</pre>{}</details>\n",
                     Escape(run.last_words), link);
}

}  // namespace aisle
