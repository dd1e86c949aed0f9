#include "harness/report/page/album_section.h"

#include <charconv>

#include "harness/common/seconds.h"
#include "harness/record/frames_csv.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/parts.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

bool HasPictures(const RunRecord& run) {
  return std::any_of(run.artifacts.begin(), run.artifacts.end(),
                     [](const auto& artifact) { return artifact.first.starts_with("picture_"); });
}

/// The worst run of a system that kept pictures; null where none did.
const RunRecord* WorstShown(const SystemRuns& system) {
  std::vector<const RunRecord*> shown;
  for (const RunRecord* run : system.runs) {
    if (HasPictures(*run)) shown.push_back(run);
  }
  return WorstRun(shown);
}

/// What is known of the instant, in words and for the script: the time, the error, where it is.
struct Instant {
  std::string words, data;
};

Instant InstantOf(const FramePicture& picture, const std::vector<FrameRow>& rows) {
  Instant instant{fmt::format("frame {}", picture.frame), ""};
  if (picture.frame >= rows.size()) {
    if (!picture.lead.empty()) instant.words += "; " + picture.lead;
    return instant;
  }
  const FrameRow& row = rows[picture.frame];
  const double time_s = ToSeconds(row.stamp_ns - rows.front().stamp_ns);
  instant.words += fmt::format(", {:.2f} s", time_s);
  instant.data += fmt::format(" data-s=\"{:.3f}\" data-at=\"{:.2f} {:.2f} {:.2f}\"", time_s,
                              row.truth_m.x(), row.truth_m.y(), row.truth_m.z());
  if (row.live_error_m) instant.words += fmt::format(": off by {:.1f} cm", 100 * *row.live_error_m);
  instant.words += fmt::format(", movers fill {:.1f} %", 100 * row.movers_share);
  if (row.features > 0) {
    instant.words +=
        fmt::format(", {} features, {} of them on movers", row.features, row.features_on_movers);
  }
  if (row.mask_iou) instant.words += fmt::format(", mask IoU {:.2f}", *row.mask_iou);
  if (!picture.lead.empty()) instant.words += "; " + picture.lead;
  return instant;
}

std::string Stills(const RunRecord& run, const std::vector<FrameRow>& rows,
                   const std::string& root) {
  std::string images;
  for (const auto& [name, path] : run.artifacts) {
    const auto picture = name.starts_with("picture_") ? PictureOf(path) : std::nullopt;
    if (!picture) continue;
    const Instant instant = InstantOf(*picture, rows);
    const std::string url = root + EscapeUrl(path);
    images += fmt::format(
        "<a href=\"{0}\"{1}{2}><img src=\"{0}\" loading=\"lazy\" width=\"752\" height=\"504\" "
        "alt=\"{3}, {4}\"></a>\n",
        url, picture->lead.empty() ? "" : " class=\"lead\"", instant.data, Escape(instant.words),
        Escape(run.spec.system.name));
  }
  return images;
}

constexpr const char* kKey =
    "<p class=\"colors small soft\"><span class=\"chip red\"></span>moves now (truth) &nbsp; <span "
    "class=\"chip blue\"></span>what could move and rests &nbsp; <span class=\"chip cyan\">"
    "</span>rejected by the system &nbsp; <span class=\"chip green\"></span>feature used "
    "&nbsp; <span class=\"chip grey\"></span>feature not used &nbsp; <span class=\"chip "
    "yellow\"></span>feature on a mover</p>\n";

/// One's own system is what one looks for; then the largest errors.
std::vector<SystemRuns> ForeignFirst(std::vector<SystemRuns> systems) {
  const auto rank = [](const SystemRuns& system) {
    const RunRecord& worst = *WorstRun(system.runs);
    const auto ate = worst.scores.find("ate_rmse_m");
    const double error_m = ate == worst.scores.end() ? 0 : ate->second.value.value_or(0);
    return std::pair(worst.spec.system.external ? 0 : 1, -error_m);
  };
  std::stable_sort(systems.begin(), systems.end(),
                   [&](const SystemRuns& a, const SystemRuns& b) { return rank(a) < rank(b); });
  return systems;
}

}  // namespace

std::optional<FramePicture> PictureOf(const std::string& path) {
  const std::string name = fs::path(path).stem().string();
  constexpr std::string_view kBegin = "frame_";
  if (!name.starts_with(kBegin)) return std::nullopt;
  FramePicture picture;
  const auto [end, error] =
      std::from_chars(name.data() + kBegin.size(), name.data() + name.size(), picture.frame);
  if (error != std::errc()) return std::nullopt;
  picture.lead.assign(end, name.data() + name.size());
  std::replace(picture.lead.begin(), picture.lead.end(), '_', ' ');
  if (!picture.lead.empty()) picture.lead.erase(0, 1);
  return picture;
}

std::string AlbumSection(const SceneRuns& scene, const fs::path& report_dir,
                         const std::string& root) {
  std::string text;
  for (const SystemRuns& system : ForeignFirst(scene.systems)) {
    const RunRecord* run = WorstShown(system);
    if (run == nullptr) continue;
    const std::string stills = Stills(*run, ReadFrameFile(*run, report_dir).rows, root);
    if (stills.empty()) continue;
    text += fmt::format(
        "<section class=\"album\" data-system=\"{}\"><h4>{}<span class=\"soft\">{}{}</span></h4>\n"
        "<div class=\"pictures\">{}</div></section>\n",
        Escape(system.system), NameOf(system), system.runs.size() > 1 ? ", its worst: " : ", ",
        SeedOf(run->spec), stills);
  }
  if (text.empty()) return "";
  return fmt::format("<div class=\"albums\"><h3 id=\"{}_frames\">The frames</h3>\n{}{}</div>\n",
                     SceneId(scene), kKey, text);
}

}  // namespace aisle
