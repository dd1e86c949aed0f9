#include "harness/report/chart/charts.h"
#include "harness/report/chart/svg.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr double kTop = 10;        ///< pixels above the first row
constexpr double kLetterPx = 7;    ///< width of a letter, about
constexpr double kLikelyPx = 480;  ///< width that a page most likely gives the bars

double Sum(const std::vector<StageBar>& bars) {
  double sum_ms = 0;
  for (const StageBar& bar : bars) sum_ms += bar.ms;
  return sum_ms;
}

/// The class of a stage's colour: there are eight, paler from the ninth stage on.
std::string ColorOf(const char* kind, int color) {
  constexpr int kColors = 8;
  return fmt::format("{}{}{}", kind, color % kColors, color >= kColors ? " pale" : "");
}

/// Bars end to end from 0 on; names stand in those that are likely to hold them.
void DrawBars(const std::vector<StageBar>& bars, const Axis& x, double top, double height,
              Svg* svg) {
  double at_ms = 0;
  for (const StageBar& bar : bars) {
    const double width = x(at_ms + bar.ms) - x(at_ms);
    svg->Rect(x(at_ms), top, width, height, ColorOf("bar b", bar.color),
              fmt::format("{} {:.2f} ms", bar.name, bar.ms));
    const double likely_px = width / kAcross * kLikelyPx;
    if (height > 12 && likely_px > kLetterPx * static_cast<double>(bar.name.size() + 1)) {
      svg->Text(x(at_ms) + 4, top + 15, bar.name, "inbar");
    }
    at_ms += bar.ms;
  }
}

/// Every stage once, with the colour that it has in all rows.
std::string StageLegend(const std::vector<StageRow>& rows) {
  std::map<int, std::string> names;
  for (const StageRow& row : rows) {
    for (const std::vector<StageBar>* bars : {&row.inside, &row.beside}) {
      for (const StageBar& bar : *bars) names[bar.color] = bar.name;
    }
  }
  std::vector<std::pair<std::string, std::string>> entries;
  for (const auto& [color, name] : names) {
    entries.emplace_back(name, ColorOf("swatch w", color));
  }
  entries.emplace_back("the rest of the step", "swatch rest");
  return Legend(entries);
}

/// Whiskers to the least and the most, a box of the middle half.
void DrawBox(const SpreadRow& row, const Axis& x, double middle, Svg* svg) {
  const double low = x(Quantile(row.values, 0.25)), high = x(Quantile(row.values, 0.75));
  const double least = x(Quantile(row.values, 0)), most = x(Quantile(row.values, 1));
  const std::string css = fmt::format("box c{}", row.color);
  svg->Line(least, middle, low, middle, css);
  svg->Line(high, middle, most, middle, css);
  svg->Rect(low, middle - 8, high - low, 16, css);
}

}  // namespace

std::string StageChart(const std::vector<StageRow>& rows) {
  double longest_ms = 1;
  for (const StageRow& row : rows) {
    longest_ms = std::max({longest_ms, row.step_ms, Sum(row.inside), Sum(row.beside)});
  }
  constexpr double kRowHeight = 40, kStepHeight = 21, kBesideHeight = 8;
  const double bottom = kTop + kRowHeight * static_cast<double>(rows.size());
  const Axis x{0, 1.02 * longest_ms, 0, kAcross};
  Svg svg = Svg::Chart(bottom + 40, "time per frame by stage", Svg::Names::kSystems);
  svg.GridAcross(x, 6, bottom, "mean per frame [ms]");
  double top = kTop;
  for (const StageRow& row : rows) {
    svg.NameAtLeft(top + 15, row.system, "legend");
    if (row.step_ms > 0) {
      svg.Rect(0, top, x(row.step_ms), kStepHeight, "bar rest",
               fmt::format("the whole step {:.2f} ms", row.step_ms));
    }
    DrawBars(row.inside, x, top, kStepHeight, &svg);
    DrawBars(row.beside, x, top + kStepHeight + 2, kBesideHeight, &svg);
    top += kRowHeight;
  }
  return svg.Finish() + StageLegend(rows);
}

std::string SpreadChart(const std::vector<SpreadRow>& rows, const std::string& axis) {
  double highest = 0;
  for (const SpreadRow& row : rows) {
    for (const double value : row.values) highest = std::max(highest, value);
  }
  if (highest <= 0) return "";
  constexpr double kRowHeight = 30;
  const double bottom = kTop + kRowHeight * static_cast<double>(rows.size());
  const Axis x{0, 1.05 * highest, 0, kAcross};
  Svg svg = Svg::Chart(bottom + 40, "spread over seeds", Svg::Names::kSystems);
  svg.GridAcross(x, 6, bottom, axis);
  double middle = kTop + kRowHeight / 2;
  for (const SpreadRow& row : rows) {
    svg.NameAtLeft(middle + 4, row.system, "legend");
    if (row.values.size() > 2) DrawBox(row, x, middle, &svg);
    if (!row.values.empty()) {
      const double median = x(Quantile(row.values, 0.5));
      svg.Line(median, middle - 10, median, middle + 10, fmt::format("line c{}", row.color));
    }
    for (const double value : row.values) {
      svg.Marker(x(value), middle, row.color, fmt::format("{:.4g}", value));
    }
    middle += kRowHeight;
  }
  return svg.Finish();
}

}  // namespace aisle
