#include "harness/report/page/compare_page.h"

#include <set>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/judge/change_size.h"
#include "harness/judge/missing.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/album_section.h"
#include "harness/report/page/parts.h"
#include "harness/report/page/scene_section.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPairs = 8;  ///< of pictures: the largest changes

bool IsChange(const Comparison& c) { return IsAlarm(c.change) || c.change == Change::kBetter; }

std::string Value(const Comparison& c, double value) {
  return fmt::format("{:.4g}{}", value, c.unit == "1" ? "" : " " + c.unit);
}

/// From the page's folder to a file of a night's report.
std::string LinkInto(const ComparedNight& night, const fs::path& out, const std::string& file) {
  const fs::path folder = fs::absolute(night.folder).lexically_normal() / "";
  return EscapeUrl((folder.lexically_relative(fs::absolute(out).lexically_normal() / "") / file)
                       .lexically_normal()
                       .string());
}

/// The scene of a comparison in a night's report; the bare text where there is no page of it.
std::string SceneLink(const Comparison& c, const ComparedNight& night, const fs::path& out,
                      const std::string& text) {
  const std::string page = ScenePage({c.scene, c.twin, {}});
  std::error_code error;
  if (night.folder.empty() || !fs::exists(night.folder / "index.html", error)) return Escape(text);
  const bool own = fs::exists(night.folder / page, error);
  const std::string target =
      own ? LinkInto(night, out, page) : LinkInto(night, out, "index.html") + "#" + EscapeUrl(page);
  return fmt::format("<a href=\"{}\">{}</a>", target, Escape(text));
}

std::string SidesTable(const ComparedNight& before, const ComparedNight& after,
                       const fs::path& out) {
  std::string rows;
  const auto row = [&](const char* title, const auto& text) {
    rows += fmt::format("<tr><td>{}<td class=\"wrap\">{}<td class=\"wrap\">{}\n", title,
                        text(before), text(after));
  };
  row("report", [&](const ComparedNight& night) {
    if (night.folder.empty()) return Escape(night.name);
    return fmt::format("<a href=\"{}\">{}</a>", LinkInto(night, out, "index.html"),
                       Escape(night.name));
  });
  row("suite", [](const auto& night) { return Escape(night.results->suite); });
  row("started", [](const auto& night) { return Escape(night.results->started); });
  row("aisle", [](const auto& night) {
    const Provenance& from = night.results->provenance;
    return Escape(fmt::format("{} ({})", from.version, from.commit));
  });
  row("machine", [](const auto& night) {
    const Provenance& from = night.results->provenance;
    return Escape(fmt::format("{}, {} threads, {}", from.cpu, from.threads, from.os));
  });
  row("command",
      [](const auto& night) { return "<code>" + Escape(night.results->rerun) + "</code>"; });
  return "<h2 id=\"sides\">The two</h2>\n<div class=\"wide\"><table><tr><th><th "
         "class=\"left\">before<th class=\"left\">after\n" +
         rows + "</table></div>\n";
}

/// The picture of a run nearest to a frame; of its worst error where no frame is asked for.
std::optional<std::pair<FramePicture, std::string>> PictureNear(
    const RunRecord& run, const std::optional<std::size_t>& frame) {
  std::optional<std::pair<FramePicture, std::string>> nearest;
  const auto distance = [&](const FramePicture& picture) -> std::size_t {
    if (!frame) return picture.lead.find("worst error") == std::string::npos ? 1 : 0;
    return std::max(picture.frame, *frame) - std::min(picture.frame, *frame);
  };
  for (const auto& [name, path] : run.artifacts) {
    const auto picture = name.starts_with("picture_") ? PictureOf(path) : std::nullopt;
    if (!picture) continue;
    if (!nearest || distance(*picture) < distance(nearest->first)) nearest = {*picture, path};
  }
  return nearest;
}

/// Copies the picture beside the page; an empty text where it is not there any more.
std::string PictureFigure(const ComparedNight& night, const RunRecord& run,
                          const std::pair<FramePicture, std::string>& picture, const char* side,
                          const fs::path& out) {
  const std::string name =
      SafeName(fmt::format("{}_{}_{}", side, RunId(run.spec), picture.first.frame)) + ".jpg";
  constexpr std::size_t kLargestPicture = std::size_t{16} << 20;
  try {
    WriteFileAtomically(out / "pictures" / name,
                        ReadFile(night.folder / picture.second, kLargestPicture));
  } catch (const InputError&) {
    return "";
  }
  return fmt::format(
      "<figure><a href=\"pictures/{0}\"><img src=\"pictures/{0}\" loading=\"lazy\" width=\"752\" "
      "height=\"504\" alt=\"{1}, frame {2}\"></a><figcaption>{1}: {3}, {4}, frame {2}"
      "</figcaption></figure>\n",
      EscapeUrl(name), side, picture.first.frame, Escape(run.spec.system.name), SeedOf(run.spec));
}

std::string PairOf(const SeedChange& seed, const ComparedNight& before, const ComparedNight& after,
                   const fs::path& out) {
  if (before.folder.empty() || after.folder.empty()) return "";
  const auto now = PictureNear(*seed.after, std::nullopt);
  const auto then = PictureNear(*seed.before, now ? std::optional(now->first.frame) : std::nullopt);
  if (!now || !then) return "";
  const std::string pair = PictureFigure(before, *seed.before, *then, "before", out) +
                           PictureFigure(after, *seed.after, *now, "after", out);
  return pair.empty() ? "" : "<div class=\"pair\">" + pair + "</div>\n";
}

std::string SeedCell(const std::optional<SeedChange>& seed, const Comparison& c,
                     const ComparedNight& after, const fs::path& out) {
  if (!seed) return "";
  const std::string text =
      fmt::format("{}: {:.4g} → {}", SeedOf(seed->after->spec), seed->old_value,
                  seed->new_value ? fmt::format("{:.4g}", *seed->new_value) : "nothing");
  return SceneLink(c, after, out, text);
}

/// Of a system over several cells, which have no one value nor page.
std::string RowOfSystem(const Comparison& c, const char* css) {
  return fmt::format(
      "<tr><td>all {} cells<td class=\"left\">{}<td class=\"left\">{}<td class=\"left "
      "{}\">{}<td><td>"
      "<td>{}<td><td>{}<td><td class=\"wrap\">{}\n",
      c.cells, Escape(c.system), Escape(c.score), css, Name(c.change), PercentOfChange(c), c.new_n,
      Escape(c.why));
}

std::string Row(const Comparison& c, const ComparedNight& before, const ComparedNight& after,
                const fs::path& out) {
  const char* css = IsAlarm(c.change) ? "fail" : c.change == Change::kBetter ? "pass" : "";
  if (c.cells > 0) return RowOfSystem(c, css);
  const auto seed = FarthestSeed(*before.results, *after.results, c);
  const bool is_left = c.new_n > 0;  // something to hold against what was
  return fmt::format(
      "<tr><td>{}<td class=\"left\">{}<td class=\"left\">{}<td class=\"left {}\">{}<td>{:.4g}"
      "<td>{}<td>{}<td>{}<td>{}<td class=\"left\">{}<td class=\"wrap\">{}\n",
      SceneLink(c, after, out, c.scene + " " + c.twin), Escape(c.system), Escape(c.score), css,
      Name(c.change), c.old_median, is_left ? fmt::format("{:.4g}", c.new_median) : "nothing",
      PercentOfChange(c),
      is_left ? fmt::format("{:.2g} … {:.2g}", c.difference.low, c.difference.high) : "",
      std::min(c.old_n, c.new_n), SeedCell(seed, c, after, out), Escape(c.why));
}

std::string Table(const std::vector<Comparison>& comparisons, bool changed,
                  const ComparedNight& before, const ComparedNight& after, const fs::path& out) {
  std::string rows;
  for (const Comparison& c : comparisons) {
    if (IsChange(c) == changed) rows += Row(c, before, after, out);
  }
  if (rows.empty()) return "";
  return "<div class=\"wide\"><table><tr><th>scene, twin<th class=\"left\">system<th "
         "class=\"left\">score<th class=\"left\">change<th>before<th>after<th><th>difference, 95 %"
         "<th>seeds<th class=\"left\">the seed that moved farthest<th class=\"left\">why\n" +
         rows + "</table></div>\n";
}

std::string Answer(const std::vector<Comparison>& comparisons, const ComparedNight& before,
                   const ComparedNight& after) {
  if (comparisons.empty()) {
    const std::string why = WhyNothingShared(*before.results, *after.results);
    return "Nothing can be compared: " +
           (why.empty() ? "no score of the one is in the other" : why) + ".";
  }
  const auto worse = std::count_if(comparisons.begin(), comparisons.end(),
                                   [](const Comparison& c) { return IsAlarm(c.change); });
  const auto better =
      std::count_if(comparisons.begin(), comparisons.end(),
                    [](const Comparison& c) { return c.change == Change::kBetter; });
  std::string text =
      fmt::format("Of {} scores {} got worse and {} better.", comparisons.size(), worse, better);
  const std::string missing = InWords(MissingRunsOf(*before.results, *after.results));
  if (!missing.empty()) text += fmt::format(" Compared with before, {}.", missing);
  const Comparison& first = comparisons.front();
  if (!IsChange(first)) return text;
  if (first.cells > 0) {
    return text +
           fmt::format(" The largest change: {} of {}, {}.", first.score, first.system, first.why);
  }
  return text + fmt::format(" The largest change: {} of {} on {} {}, from {} to {}.", first.score,
                            first.system, first.scene, first.twin, Value(first, first.old_median),
                            first.new_n > 0 ? Value(first, first.new_median) : "nothing");
}

/// What was there before and is not now; empty where everything is.
std::string MissingTable(const std::vector<MissingRuns>& missing) {
  if (missing.empty()) return "";
  std::string rows;
  for (const MissingRuns& one : missing) {
    rows += fmt::format(
        "<tr><td>{} {}<td class=\"left\">{}<td class=\"left fail\">{}\n", Escape(one.scene),
        Escape(one.twin), Escape(one.system),
        one.is_whole ? "all of it" : fmt::format("seeds {}", fmt::join(one.seeds, ", ")));
  }
  return "<h2 id=\"missing\">Missing since before</h2>\n<div class=\"wide\"><table><tr><th>scene, "
         "twin<th class=\"left\">system<th class=\"left\">missing\n" +
         rows + "</table></div>\n";
}

/// The frames of the largest changes, before and after.
std::string Pairs(const std::vector<Comparison>& comparisons, const ComparedNight& before,
                  const ComparedNight& after, const fs::path& out) {
  std::string text;
  std::size_t shown = 0;
  std::set<std::string> told;  // a run that changed in several scores is shown once
  for (const Comparison& c : comparisons) {
    if (shown == kPairs || !IsChange(c)) break;
    const auto seed = FarthestSeed(*before.results, *after.results, c);
    if (!seed || !told.insert(RunId(seed->after->spec)).second) continue;
    const std::string pair = PairOf(*seed, before, after, out);
    if (pair.empty()) continue;
    text += fmt::format("<h3>{} {} {}, {}</h3>\n{}", Escape(c.scene), Escape(c.twin),
                        Escape(c.system), SeedOf(seed->after->spec), pair);
    ++shown;
  }
  return text.empty() ? "" : "<h2 id=\"frames\">The frames, before and after</h2>\n" + text;
}

}  // namespace

std::string ComparePage(std::vector<Comparison> comparisons, const ComparedNight& before,
                        const ComparedNight& after, const fs::path& out) {
  LargestFirst(&comparisons);
  const std::vector<MissingRuns> missing = MissingRunsOf(*before.results, *after.results);
  const bool worse =
      !missing.empty() || std::any_of(comparisons.begin(), comparisons.end(),
                                      [](const Comparison& c) { return IsAlarm(c.change); });
  // Nights that share no cell are not judged: none of the one is missed in the other.
  const bool judged =
      !comparisons.empty() ||
      (!missing.empty() && WhyNothingShared(*before.results, *after.results).empty());
  const char* css = !judged ? "" : worse ? "failed" : "passed";
  std::string text =
      fmt::format("<h1>What changed</h1>\n<div class=\"verdict {}\"><strong>{}</strong></div>\n",
                  css, Escape(Answer(comparisons, before, after)));
  text += SidesTable(before, after, out);
  if (judged) text += MissingTable(missing);
  if (const std::string changes = Table(comparisons, true, before, after, out); !changes.empty()) {
    text += "<h2 id=\"changes\">The changes, the largest first</h2>\n" + changes;
  }
  text += Pairs(comparisons, before, after, out);
  if (const std::string rest = Table(comparisons, false, before, after, out); !rest.empty()) {
    const bool alone = text.find("id=\"changes\"") == std::string::npos;
    text += fmt::format(
        "<h2 id=\"rest\">Unchanged, or cannot tell</h2>\n<details{}><summary>all of "
        "them</summary>{}</details>\n",
        alone ? " open" : "", rest);
  }
  return text +
         "<p class=\"soft small\">Medians over seeds. The interval is a bootstrap of the median "
         "difference, by seed where both sides have the same seeds. Worse and better need an "
         "effect of a "
         "tenth of the old median (of scores near 0 or 1, lengths of closed drives and counts, a "
         "step of their own) and a test that survives Holm's correction over this whole page. In a "
         "cell that is the stronger of Mann-Whitney's and, by seed, Student's of log ratios; over "
         "all cells of a system, the stronger of a sign test and Wilcoxon's signed-rank test of "
         "its seeds, and more than half of the cells with the effect. Unstable: the median holds, "
         "but so many seeds lie far from it that "
         "the old scatter does not explain them. Gone: runs that had the score have it no "
         "more.</p>\n";
}

}  // namespace aisle
