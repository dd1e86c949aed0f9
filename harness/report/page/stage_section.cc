#include "harness/report/page/stage_section.h"

#include <cstdlib>

#include "harness/common/seconds.h"
#include "harness/record/frames_csv.h"
#include "harness/report/markup/html.h"

namespace aisle {
namespace {

constexpr std::string_view kSheet = "stages_";  // and the number of the frame

const RunRecord* FirstDrawn(const SystemRuns& system) {
  for (const RunRecord* run : system.runs) {
    for (const auto& [name, path] : run->artifacts) {
      if (IsStageSheet(name)) return run;
    }
  }
  return nullptr;
}

std::size_t FrameOf(const std::string& artifact) {
  return std::strtoul(artifact.c_str() + kSheet.size(), nullptr, 10);
}

/// What makes the frame one of the worst.
std::string Caption(std::size_t frame, const std::vector<FrameRow>& rows) {
  std::string text = fmt::format("Frame {}", frame);
  if (frame >= rows.size()) return text + ".";
  const FrameRow& row = rows[frame];
  text += fmt::format(", {:.2f} s: movers fill {:.1f} % of the image",
                      ToSeconds(row.stamp_ns - rows.front().stamp_ns), 100 * row.movers_share);
  if (row.mask_iou) text += fmt::format(", pixel IoU {:.2f}", *row.mask_iou);
  return text + ".";
}

std::string SheetsOf(const RunRecord& run, const std::vector<FrameRow>& rows,
                     const std::string& root) {
  std::string text;
  for (const auto& [name, path] : run.artifacts) {
    if (!IsStageSheet(name)) continue;
    text += fmt::format(
        "<figure><a href=\"{0}\"><img src=\"{0}\" loading=\"lazy\" alt=\"stages of frame {1}, "
        "{2}\"></a><figcaption>{3}</figcaption></figure>\n",
        root + EscapeUrl(path), FrameOf(name), Escape(run.spec.system.name),
        Caption(FrameOf(name), rows));
  }
  return text;
}

std::string LinksOf(const RunRecord& run, const std::string& root) {
  std::string text = fmt::format("Seed {}; every frame in <a href=\"{}runs/{}/stages/\">stages</a>",
                                 run.spec.seed, root, EscapeUrl(RunId(run.spec)));
  const auto film = run.artifacts.find("stages_film");
  if (film != run.artifacts.end()) {
    text +=
        fmt::format(", at half speed in <a href=\"{}\">a film</a>", root + EscapeUrl(film->second));
  }
  return text + ".";
}

}  // namespace

bool IsStageSheet(const std::string& artifact) {
  if (!artifact.starts_with(kSheet) || artifact.size() == kSheet.size()) return false;
  return std::all_of(artifact.begin() + kSheet.size(), artifact.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

std::string StageSection(const SceneRuns& scene, const std::filesystem::path& report_dir,
                         const std::string& root) {
  std::string text;
  for (const SystemRuns& system : scene.systems) {
    const RunRecord* run = FirstDrawn(system);
    if (run == nullptr) continue;
    text += fmt::format(
        "<h3><span class=\"chip c{}\"></span>{}: stage by stage, where its mask is most "
        "wrong</h3>\n<p class=\"small soft\">{} A picture opens in full size.</p>\n<div "
        "class=\"sheets\">{}</div>\n",
        system.color, Escape(system.system), LinksOf(*run, root),
        SheetsOf(*run, ReadFrameFile(*run, report_dir).rows, root));
  }
  return text;
}

}  // namespace aisle
