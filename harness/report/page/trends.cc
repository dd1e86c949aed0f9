#include "harness/report/page/trends.h"

#include "harness/io/hash.h"
#include "harness/io/places.h"
#include "harness/io/shell_word.h"
#include "harness/report/chart/svg.h"
#include "harness/report/markup/html.h"
#include "harness/report/page/night_series.h"
#include "harness/report/page/parts.h"
#include "harness/report/page/scene_section.h"
#include "harness/report/page/trend_chart.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Of every scene; the rest of what is followed where it changed.
constexpr const char* kDrawn[] = {"ate_rmse_m", "ms_process_mean", "coverage"};

std::string DateOf(const Night& night) { return night.started.substr(0, 10); }

/// An id for a text: its own also where names are cut or have letters that an id may not hold.
std::string IdOf(const std::string& text) {
  const std::string safe = SafeName(text);
  return safe == text ? safe : fmt::format("{}_{:08x}", safe, Hash(text) & 0xffffffff);
}

std::string AnchorOf(const NightSeries& series) {
  return IdOf(fmt::format("{}_{}_{}", series.scene, series.twin, series.score));
}

/// One score of all systems of a scene and twin: what a chart shows.
std::vector<const NightSeries*> OneChart(const NightBook& book, const NightSeries& of) {
  std::vector<const NightSeries*> drawn;
  for (const NightSeries& series : book.series) {
    const bool same = series.scene == of.scene && series.twin == of.twin;
    if (same && series.score == of.score) drawn.push_back(&series);
  }
  return drawn;
}

/// The anchor of the chart that shows it; empty where there is nothing to draw.
std::string ChartAnchor(const NightBook& book, const NightSeries& series) {
  return HasTrendChart(OneChart(book, series), book.nights) ? AnchorOf(series) : "";
}

std::string Value(const NightSeries& series, double value) {
  const FollowedScore& followed = Followed(series.score);
  return fmt::format("{:.3g} {}", followed.factor * value, followed.unit);
}

std::string ChangeInWords(const NightChange& change, const NightBook& book) {
  const NightSeries& series = *change.series;
  const Night& night = book.nights[change.night];
  const std::string what =
      change.failing
          ? fmt::format("{:.0f} of {} seeds fail", change.after, series.points.back()->seeds)
          : fmt::format("{} from {} to {}", Followed(series.score).title,
                        Value(series, change.before), Value(series, change.after));
  const std::size_t count = book.nights.size() - change.night;
  return fmt::format("{} {} {}: {} since {} ({}, commit {})", series.scene, series.twin,
                     series.system, what, DateOf(night),
                     count == 1 ? "last night" : fmt::format("{} nights", count), night.commit);
}

/// Where the night shows this scene; empty where its folder is gone.
std::string PageOf(const Night& night, const NightSeries& series, const TrendPlace& place) {
  const SceneRuns scene{series.scene, series.twin, {}};
  if (night.folder.empty() || night.folder.starts_with("..")) return "";
  const fs::path folder = place.history_dir / night.folder;
  std::error_code error;
  const std::string own = ScenePage(scene);
  const std::string root = place.to_history + EscapeUrl((fs::path(night.folder) / "").string());
  if (fs::exists(folder / own, error)) return root + EscapeUrl(own);
  if (fs::exists(folder / "index.html", error)) return root + "index.html#" + EscapeUrl(own);
  return "";
}

/// A limit halfway between what was and what is, as `bisect` takes it.
std::string LimitBetween(const NightChange& change) {
  if (change.failing) return "completes";
  const bool rose = change.after > change.before;
  return fmt::format("{}{}{:.4g}", change.series->score,
                     rose ? "<=" : ">=", (change.before + change.after) / 2);
}

/// What to ask next: the command that finds the commit, or where to look for it.
std::string NextStep(const NightChange& change, const NightBook& book, const TrendPlace& place) {
  const NightSeries& series = *change.series;
  const TrendPoint* after = series.points[change.night];
  const TrendPoint* before = nullptr;
  for (std::size_t i = change.night; i-- > 0 && before == nullptr;) before = series.points[i];
  if (before == nullptr) return "";
  if (!after->version.empty() && !before->version.empty()) {
    if (after->version == before->version) {
      return fmt::format(
          "{} is the same version, {}: look at aisle and the machine, <code>git log "
          "--oneline {}..{}</code>",
          Escape(series.system), Escape(after->version), Escape(before->commit),
          Escape(after->commit));
    }
    const std::string command =
        fmt::format("{} bisect {} {} {} --scene {} --twin {} --system {} --limit {}", OwnCommand(),
                    ShellWord(before->version), ShellWord(after->version),
                    ShellWord(place.suite_file.empty() ? "SUITE.yaml" : place.suite_file),
                    ShellWord(series.scene), ShellWord(series.twin), ShellWord(series.system),
                    ShellWord(LimitBetween(change)));
    return "<code>" + Escape(command) + "</code>";
  }
  if (book.nights[change.night].commit == before->commit) {
    return "the same commit of aisle: look at the machine, and at what the system's command names";
  }
  return fmt::format("<code>git log --oneline {}..{}</code>", Escape(before->commit),
                     Escape(after->commit));
}

std::string ChangeItem(const NightChange& change, const NightBook& book, const TrendPlace& place) {
  const NightSeries& series = *change.series;
  const auto leading = [&](std::size_t night, const char* word) {
    const std::string page = PageOf(book.nights[night], series, place);
    return page.empty() ? "" : fmt::format(" · <a href=\"{}\">{}</a>", page, word);
  };
  const std::string next = NextStep(change, book, place), anchor = ChartAnchor(book, series);
  return fmt::format("<li>{}<span class=\"{}\">{}</span>{}{}{}{}\n", Chip(series.style),
                     change.worse ? "fail" : "pass", Escape(ChangeInWords(change, book)),
                     anchor.empty() ? "" : fmt::format(": <a href=\"#{}\">chart</a>", anchor),
                     leading(change.night, "that night"),
                     change.night > 0 ? leading(change.night - 1, "the night before") : "",
                     next.empty() ? "" : "<br><span class=\"small\">" + next + "</span>");
}

std::string NightsTable(const NightBook& book, const TrendPlace& place) {
  std::string text =
      "<h2 id=\"nights\">The nights</h2>\n<details><summary>all of them</summary><div "
      "class=\"wide\"><table><tr><th>started<th class=\"left\">commit<th>seeds that failed\n";
  for (const Night& night : book.nights) {
    std::error_code error;
    const bool there =
        !night.folder.empty() && fs::exists(place.history_dir / night.folder / "index.html", error);
    const std::string started =
        there ? fmt::format("<a href=\"{}{}\">{}</a>", place.to_history,
                            EscapeUrl((fs::path(night.folder) / "index.html").string()),
                            Escape(night.started))
              : Escape(night.started);
    text += fmt::format("<tr><td>{}<td class=\"left\">{}<td>{}\n", started, Escape(night.commit),
                        night.failed);
  }
  return text + "</table></div></details>\n";
}

/// What is drawn of one scene and twin: the scores of every scene, and those that changed in it.
std::vector<std::string> DrawnOf(const NightSeries& lead, const std::vector<NightChange>& changes) {
  std::vector<std::string> drawn(std::begin(kDrawn), std::end(kDrawn));
  for (const NightChange& change : changes) {
    const NightSeries& series = *change.series;
    const bool here = series.scene == lead.scene && series.twin == lead.twin;
    const bool known = std::find(drawn.begin(), drawn.end(), series.score) != drawn.end();
    if (here && !known) drawn.push_back(series.score);
  }
  return drawn;
}

/// The charts of one scene and twin, side by side where there is room.
std::string ChartsOf(const NightBook& book, const NightSeries& lead,
                     const std::vector<NightChange>& changes, const TrendPlace& place) {
  std::string charts;
  for (const std::string& score : DrawnOf(lead, changes)) {
    NightSeries of = lead;
    of.score = score;
    const std::string chart = TrendChart(OneChart(book, of), book.nights, [&](const Night& night) {
      return PageOf(night, lead, place);
    });
    if (chart.empty()) continue;
    charts += fmt::format("<figure id=\"{}\">{}</figure>\n", AnchorOf(of), chart);
  }
  if (charts.empty()) return "";
  return fmt::format(
      "<h2 id=\"{}\">{} <span class=\"soft\">{}</span></h2>\n<div "
      "class=\"charts\">{}</div>\n",
      IdOf(lead.scene + "_" + lead.twin), Escape(lead.scene), Escape(lead.twin), charts);
}

std::string ChangeList(const NightBook& book, const std::vector<NightChange>& changes,
                       const TrendPlace& place) {
  if (changes.empty()) {
    return "<p class=\"answer\">Nothing is other than it was: no score has left, and stayed away "
           "from, what the nights before let one expect.</p>\n";
  }
  constexpr std::size_t kShown = 12;
  std::string text = "<ul class=\"answer changes\">\n";
  for (std::size_t i = 0; i < changes.size(); ++i) {
    if (i == kShown) {
      text += fmt::format("</ul><details><summary>{} more</summary><ul>\n", changes.size() - i);
    }
    text += ChangeItem(changes[i], book, place);
  }
  return text + (changes.size() > kShown ? "</ul></details>\n" : "</ul>\n");
}

}  // namespace

std::string TrendSection(const std::vector<TrendPoint>& points, const TrendPlace& place) {
  const NightBook book = ReadNights(points);
  if (book.nights.size() < 2) return "";
  const std::vector<NightChange> changes = ChangesOf(book);
  std::string text = fmt::format(
      "<h1>{} nights</h1>\n{}<p class=\"soft small\">From {} to {}. Since: the first night from "
      "which on every night lies beyond what the nights before it let one expect, by a tenth of "
      "their median and four times their median deviation from it. A point leads to its night; "
      "crosses are nights with seeds that failed, at the top where none came to its end, dashed "
      "lines the limits, bands the middle half of "
      "the seeds. Every score of every night is in the SQLite file beside the reports.</p>\n",
      book.nights.size(), ChangeList(book, changes, place), Escape(book.nights.front().started),
      Escape(book.nights.back().started));
  for (std::size_t first = 0; first < book.series.size();) {
    std::size_t end = first;
    while (end < book.series.size() && book.series[end].scene == book.series[first].scene &&
           book.series[end].twin == book.series[first].twin) {
      ++end;
    }
    text += ChartsOf(book, book.series[first], changes, place);
    first = end;
  }
  return text + NightsTable(book, place);
}

SinceNotes SinceWhen(const std::vector<TrendPoint>& points) {
  SinceNotes notes;
  const NightBook book = ReadNights(points);
  if (book.nights.size() < 2) return notes;
  for (const NightChange& change : ChangesOf(book)) {
    const NightSeries& series = *change.series;
    const Night& night = book.nights[change.night];
    const std::string anchor = ChartAnchor(book, series);
    const std::string note = fmt::format(
        "<a class=\"since\" href=\"trends.html{}\">since {}</a> (commit {})",
        anchor.empty() ? "" : "#" + anchor, Escape(DateOf(night)), Escape(night.commit));
    const std::string score = change.failing ? "completes" : series.score;
    notes.try_emplace({series.scene, series.twin, series.system, score}, note);
  }
  return notes;
}

std::vector<std::string> ChangesInWords(const std::vector<TrendPoint>& points) {
  const NightBook book = ReadNights(points);
  std::vector<std::string> lines;
  if (book.nights.size() < 2) return lines;
  for (const NightChange& change : ChangesOf(book)) lines.push_back(ChangeInWords(change, book));
  return lines;
}

}  // namespace aisle
