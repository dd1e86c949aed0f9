#include "harness/report/page/scene_section.h"

#include "harness/io/places.h"
#include "harness/io/shell_word.h"
#include "harness/record/seed_values.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/album_section.h"
#include "harness/report/page/answer.h"
#include "harness/report/page/drive_section.h"
#include "harness/report/page/parts.h"
#include "harness/report/page/scene_charts.h"
#include "harness/report/page/scene_tables.h"
#include "harness/report/page/stage_section.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string ErrorsInWords(const SystemRuns& system) {
  std::string unit;
  const ValuesBySeed by_seed = ValuesOf(system.runs, "ate_rmse_m", &unit);
  const std::vector<double> errors_m = Plain(by_seed);
  if (errors_m.empty()) return system.system + " has no error to tell";
  std::string text =
      fmt::format("{} is off by {}", system.system, LengthInWords(Quantile(errors_m, 0.5)));
  if (errors_m.size() < 2) return text;
  const auto worst = std::ranges::max_element(
      by_seed, [](const auto& a, const auto& b) { return a.second < b.second; });
  return text + fmt::format(" in the median of {} seeds, from {} to {} (worst: seed {})",
                            errors_m.size(), LengthInWords(Quantile(errors_m, 0)),
                            LengthInWords(worst->second), worst->first);
}

/// "; 2 of 9 runs failed, 1 lost: seed 4 crashed, seed 5 lost and seed 7 timeout", or nothing.
std::string FailuresInWords(const SystemRuns& system) {
  constexpr std::size_t kNamed = 3;
  std::vector<std::string> failed;
  for (const RunRecord* run : system.runs) {
    if (run->status == RunStatus::kOk) continue;
    failed.push_back(fmt::format("{} {}", SeedOf(run->spec), Name(run->status)));
  }
  if (failed.empty()) return "";
  if (failed.size() > kNamed) {
    failed.resize(kNamed);
    failed.emplace_back("others");
  }
  return fmt::format("; {}: {}", FailedAndLost(system.runs), Listed(failed));
}

std::string Troubles(const std::vector<SystemRuns>& systems, const std::string& root) {
  std::string text;
  for (const SystemRuns& system : systems) {
    for (const RunRecord* run : system.runs) {
      if (run->status != RunStatus::kOk) {
        text += fmt::format(
            "<div class=\"trouble\"><p><span class=\"fail\">{}</span> {}, {}: {}</p>"
            "{}</div>\n",
            Name(run->status), NameOf(system), SeedOf(run->spec), Escape(run->status_why),
            LastWordsOf(*run, root));
      }
      if (!IsComplete(run->status)) continue;
      for (const std::string& note : run->notes) {
        text += fmt::format("<p>{}, {}: {}</p>\n", NameOf(system), SeedOf(run->spec), Escape(note));
      }
    }
  }
  return text;
}

/// A run that says how long the drive is and of what it was made: the first that came to its end.
const RunRecord& Telling(const SceneRuns& scene) {
  for (const SystemRuns& system : scene.systems) {
    const RunRecord* first = CompleteOf(system.runs).front();
    if (IsComplete(first->status)) return *first;
  }
  return *scene.systems.front().runs.front();
}

/// The folder as a shell would be told it, seen from where the suite was started.
std::string Again(const SceneRuns& scene, const std::string& root, const std::string& place) {
  std::string text = "<div class=\"wide\"><table>";
  for (const SystemRuns& system : scene.systems) {
    for (const RunRecord* run : system.runs) {
      text += fmt::format("<tr><td>{}, {}<td class=\"left\">", NameOf(system), SeedOf(run->spec));
      for (const auto& [name, path] : run->artifacts) {
        if (name.starts_with("picture_") || IsStageSheet(name)) continue;
        text += fmt::format("<a href=\"{}\">{}</a> ", root + EscapeUrl(path), Escape(name));
      }
      text += fmt::format("<td class=\"left\"><code>{} rerun {} --in {}</code>\n", OwnCommand(),
                          Escape(ShellWord(RunId(run->spec))), Escape(ShellWord(place)));
    }
  }
  return text + "</table></div>\n";
}

}  // namespace

std::string ScenePage(const SceneRuns& scene) {
  return fmt::format("scene_{}.html", SceneId(scene));
}

std::vector<std::string> SceneInWords(const SceneRuns& scene) {
  std::vector<std::string> sentences;
  for (const SystemRuns& system : scene.systems) {
    sentences.push_back(ErrorsInWords(system) + FailuresInWords(system) + ".");
  }
  return sentences;
}

std::string SceneSection(const SceneRuns& scene, const fs::path& report_dir,
                         const std::string& root) {
  const RunRecord& first = Telling(scene);
  std::string text =
      fmt::format("<h2 id=\"{}\">{} <span class=\"soft\">{}</span></h2>\n<ul class=\"answer\">\n",
                  ScenePage(scene), Escape(scene.scene), Escape(scene.twin));
  for (const std::string& sentence : SceneInWords(scene)) {
    text += "<li>" + Escape(sentence) + "\n";
  }
  text +=
      fmt::format("</ul>\n<p class=\"soft small\">{} frames, {:g} per second; content {}.</p>\n",
                  first.frames, first.rate_hz, Escape(first.content_hash));
  const auto heading = [&](const char* part, const char* title) {
    return fmt::format("<h3 id=\"{}_{}\">{}</h3>\n", SceneId(scene), part, title);
  };
  text += Troubles(scene.systems, root) + DriveSection(scene, report_dir, root);
  text += heading("scores", "The scores") + ErrorTable(scene.systems);
  text += heading("drive", "The drive over time") + SceneCharts(scene, report_dir);
  text += AlbumSection(scene, report_dir, root) + MaskTables(scene.systems) +
          StageSection(scene, report_dir, root) + AllScores(scene);
  return text + heading("files", "Files, and each run again") +
         Again(scene, root, report_dir.string());
}

}  // namespace aisle
