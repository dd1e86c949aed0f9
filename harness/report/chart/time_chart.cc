#include "harness/report/chart/time_chart.h"

#include "harness/common/seconds.h"
#include "harness/report/chart/svg.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr double kTitle = 26;  ///< height above a panel
using Points = std::vector<std::pair<double, double>>;
constexpr const char* kMedian = ", median";

/// Along the axis of time.
struct Clock {
  const char* title;
  std::function<double(const FrameRow& first, const FrameRow& now)> at;
};
const Clock kSeconds{"time [s]", [](const FrameRow& first, const FrameRow& now) {
                       return ToSeconds(now.stamp_ns - first.stamp_ns);
                     }};
const Clock kFrames{"frame", [](const FrameRow& first, const FrameRow& now) {
                      return static_cast<double>(now.id - first.id);
                    }};

/// Values over time, in pieces where frames have none.
struct Line {
  std::string name, css;
  std::vector<Points> pieces = {};
};

/// Where half of the seeds lie (all of them where there are fewer than four), over time.
struct Band {
  std::string css;
  Points low = {}, high = {};
};

struct Panel {
  std::string title;
  double height;  ///< pixels
  bool filled;    ///< the one line is an area
  std::vector<Line> lines = {};
  std::vector<Band> bands = {};
};

using ValueOf = std::function<std::optional<double>(const FrameRow&)>;

Line MakeLine(const std::string& name, const std::string& css, const std::vector<FrameRow>& rows,
              const Clock& clock, const ValueOf& value) {
  Line line{name, css, {{}}};
  for (const FrameRow& row : rows) {
    if (const std::optional<double> at = value(row)) {
      line.pieces.back().emplace_back(clock.at(rows.front(), row), *at);
    } else if (!line.pieces.back().empty()) {
      line.pieces.emplace_back();
    }
  }
  return line;
}

double Highest(const Panel& panel) {
  double highest = 0;
  for (const Line& line : panel.lines) {
    for (const Points& piece : line.pieces) {
      for (const auto& [time, value] : piece) highest = std::max(highest, value);
    }
  }
  for (const Band& band : panel.bands) {
    for (const auto& [time, value] : band.high) highest = std::max(highest, value);
  }
  return highest;
}

std::optional<double> Percent(const std::optional<double>& share) {
  return share ? std::optional(100 * *share) : std::nullopt;
}

/// A system's line; thin where it is one seed of several.
Line OfOneSeed(const ChartSeries& series, const Clock& clock, const ValueOf& value) {
  const bool only = series.seeds.empty();
  return MakeLine(only ? series.name : series.name + ", " + series.seed,
                  fmt::format("line{} c{}", only ? "" : " thin", series.color), *series.rows, clock,
                  value);
}

/// A line per system.
Panel OfSystems(const std::string& title, double height, const std::vector<ChartSeries>& series,
                const Clock& clock, const ValueOf& value) {
  Panel panel{title, height, false};
  for (const ChartSeries& one : series) panel.lines.push_back(OfOneSeed(one, clock, value));
  return panel;
}

/// The values of all seeds in one frame of the drive, in rising order of seeds.
std::vector<double> OverSeeds(const ChartSeries& series, std::size_t frame, const ValueOf& value) {
  std::vector<double> values;
  for (const std::vector<FrameRow>* rows : series.seeds) {
    if (frame >= rows->size()) continue;
    if (const std::optional<double> one = value((*rows)[frame])) values.push_back(*one);
  }
  return values;
}

/// The median over the seeds, with its band; frames of which fewer than half have a value are left
/// out, and leave a gap.
void AddMedian(const ChartSeries& series, const Clock& clock, const ValueOf& value, Panel* panel) {
  Line median{series.name + kMedian, fmt::format("line c{}", series.color), {{}}};
  const std::string css = fmt::format("band d{}", series.color);
  std::vector<Band> bands{{css}};
  for (std::size_t frame = 0; frame < series.rows->size(); ++frame) {
    const std::vector<double> values = OverSeeds(series, frame, value);
    if (2 * values.size() < series.seeds.size() || values.empty()) {
      if (median.pieces.back().empty()) continue;
      median.pieces.emplace_back();
      bands.push_back({css});
      continue;
    }
    const double at = clock.at(series.rows->front(), (*series.rows)[frame]);
    const double share = values.size() < 4 ? 0 : 0.25;
    median.pieces.back().emplace_back(at, Quantile(values, 0.5));
    bands.back().low.emplace_back(at, Quantile(values, share));
    bands.back().high.emplace_back(at, Quantile(values, 1 - share));
  }
  std::move(bands.begin(), bands.end(), std::back_inserter(panel->bands));
  panel->lines.push_back(std::move(median));
}

/// A line per system; of several seeds the median with its band, and the worst one thinly.
Panel OfSeeds(const std::string& title, double height, const std::vector<ChartSeries>& series,
              const Clock& clock, const ValueOf& value) {
  Panel panel{title, height, false};
  for (const ChartSeries& one : series) {
    if (!one.seeds.empty()) AddMedian(one, clock, value, &panel);
    panel.lines.push_back(OfOneSeed(one, clock, value));
  }
  return panel;
}

/// What is the same for every system.
Panel OfScene(const std::string& title, const std::string& css, bool filled,
              const std::vector<FrameRow>& rows, const Clock& clock, const ValueOf& value) {
  return {title, 44, filled, {MakeLine(title, css, rows, clock, value)}};
}

Panel Movers(const std::vector<FrameRow>& rows, const Clock& clock) {
  return OfScene("pixels that move [%]", "movers", true, rows, clock,
                 [](const FrameRow& row) { return 100 * row.movers_share; });
}

Panel Rejected(double height, const std::vector<ChartSeries>& series, const Clock& clock) {
  return OfSystems("corners rejected", height, series, clock,
                   [](const FrameRow& row) -> std::optional<double> {
                     if (!row.corners_rejected) return std::nullopt;
                     return *row.corners_rejected;
                   });
}

std::vector<Panel> Panels(const std::vector<ChartSeries>& series,
                          const std::vector<FrameRow>& longest) {
  std::vector<Panel> panels;
  panels.push_back(OfSeeds("error of the live track [cm]", 230, series, kSeconds,
                           [](const FrameRow& row) { return Percent(row.live_error_m); }));
  panels.push_back(Movers(longest, kSeconds));
  panels.push_back(Rejected(64, series, kSeconds));
  panels.push_back(
      OfScene("still and textured [%]", "texture", true, longest, kSeconds,
              [](const FrameRow& row) { return Percent(row.difficulty.static_texture_share); }));
  Panel motion{"motion of the image [px/frame]", 54, false};
  const auto add = [&](const char* name, const char* css, std::optional<double> Difficulty::*part) {
    motion.lines.push_back(MakeLine(name, css, longest, kSeconds,
                                    [part](const FrameRow& row) { return row.difficulty.*part; }));
  };
  add("all", "line s0", &Difficulty::flow_px);
  add("parallax", "line s1", &Difficulty::parallax_px);
  add("blur", "line s2", &Difficulty::blur_px);
  panels.push_back(motion);
  return panels;
}

void DropEmptyLines(Panel* panel) {
  std::erase_if(panel->lines, [](const Line& line) {
    return std::all_of(line.pieces.begin(), line.pieces.end(), [](const Points& piece) {
      return std::all_of(piece.begin(), piece.end(), [](const auto& at) { return at.second <= 0; });
    });
  });
}

void Draw(const Panel& panel, const Axis& x, double top, const char* x_title, Svg* svg) {
  const bool last = *x_title != '\0';
  const Axis y{0, 1.06 * Highest(panel), top + panel.height, top};
  svg->Grid(x, y, x_title, panel.title, {.x_labels = last, .y_ticks = panel.height > 100 ? 4 : 2});
  const auto placed = [&](const Points& points) {
    Points at;
    for (const auto& [time, value] : points) at.emplace_back(x(time), y(value));
    return at;
  };
  for (const Band& band : panel.bands) svg->Band(placed(band.low), placed(band.high), band.css);
  for (const Line& line : panel.lines) {
    std::vector<Points> pieces;
    for (const Points& piece : line.pieces) pieces.push_back(placed(piece));
    if (!panel.filled) {
      svg->Pieces(pieces, line.css, line.name);
      continue;
    }
    for (const Points& piece : pieces) svg->Area(piece, y(0), line.css, line.name);
  }
}

/// Every line once: systems first, then what is the same for all of them.
std::string LegendOf(const std::vector<Panel>& panels) {
  std::vector<std::pair<std::string, std::string>> entries;
  for (const Panel& panel : panels) {
    for (const Line& line : panel.lines) {
      if (line.css.find(" thin ") != std::string::npos) continue;  // the system's own, once more
      const std::pair entry{line.name.substr(0, line.name.find(kMedian)), line.css};
      const bool known = std::find(entries.begin(), entries.end(), entry) != entries.end();
      if (!known && !panel.filled && line.name != panel.title) entries.push_back(entry);
    }
  }
  return Legend(entries);
}

/// Panels of which something is known, one under the other.
std::string DrawPanels(std::vector<Panel> panels, const std::vector<FrameRow>& longest,
                       const Clock& clock, const std::string& label) {
  std::erase_if(panels, [](const Panel& panel) { return Highest(panel) <= 0; });
  double height = 30;
  for (Panel& panel : panels) {
    DropEmptyLines(&panel);
    height += kTitle + panel.height;
  }
  const Axis x{0, std::max(clock.at(longest.front(), longest.back()), 1e-3), 0, kAcross};
  Svg svg = Svg::Chart(height + 6, label);
  double top = 0;
  for (const Panel& panel : panels) {
    top += kTitle;
    Draw(panel, x, top, &panel == &panels.back() ? clock.title : "", &svg);
    top += panel.height;
  }
  return svg.Finish() + LegendOf(panels);
}

}  // namespace

std::string TimeChart(const std::vector<ChartSeries>& series) {
  const std::vector<FrameRow>* longest = Longest(series);
  if (longest == nullptr) return "";
  return DrawPanels(Panels(series, *longest), *longest, kSeconds, "what happened over time");
}

std::string ErrorOverFrames(const std::vector<ChartSeries>& series) {
  const std::vector<FrameRow>* longest = Longest(series);
  if (longest == nullptr) return "";
  return DrawPanels({OfSystems("error of the live track [m]", 220, series, kFrames,
                               [](const FrameRow& row) { return row.live_error_m; }),
                     Movers(*longest, kFrames)},
                    *longest, kFrames, "trajectory error over frames");
}

std::string RejectedOverFrames(const std::vector<ChartSeries>& series) {
  const std::vector<FrameRow>* longest = Longest(series);
  if (longest == nullptr) return "";
  return DrawPanels({Rejected(220, series, kFrames), Movers(*longest, kFrames)}, *longest, kFrames,
                    "corners rejected over frames");
}

}  // namespace aisle
