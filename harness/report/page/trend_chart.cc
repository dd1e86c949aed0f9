#include "harness/report/page/trend_chart.h"

#include "harness/report/chart/svg.h"

namespace aisle {
namespace {

using Points = std::vector<std::pair<double, double>>;

constexpr double kTop = 26, kBottom = 210;

/// The largest value that must be seen; a limit far above all of them need not.
double Highest(const std::vector<const NightSeries*>& systems) {
  constexpr double kFar = 2;
  double highest = 0, limit = 0;
  for (const NightSeries* series : systems) {
    for (const TrendPoint* point : series->points) {
      if (point == nullptr) continue;
      highest = std::max({highest, point->median.value_or(0), point->high.value_or(0)});
      limit = std::max(limit, point->limit.value_or(0));
    }
  }
  return limit <= kFar * highest ? std::max(highest, limit) : highest;
}

/// Dates and commits below some of the nights: as many as a page is likely to hold.
void NameNights(const std::vector<Night>& nights, const Axis& x, Svg* svg) {
  constexpr std::size_t kLabels = 8;
  const std::size_t step = (nights.size() + kLabels - 1) / kLabels;
  std::size_t number = 0;
  for (std::size_t i = 0; i < nights.size(); i += step) {
    const std::string css = number++ % 2 == 0 ? "tick" : "tick alt";
    const std::string date = nights[i].started.size() >= 10 ? nights[i].started.substr(5, 5)
                                                            : nights[i].started.substr(0, 5);
    svg->Text(x(nights[i].day), kBottom + 15, date, css, "middle");
    svg->Text(x(nights[i].day), kBottom + 29, nights[i].commit.substr(0, 8), css, "middle");
  }
}

std::string TipOf(const TrendPoint& point, const NightSeries& series) {
  const FollowedScore& followed = Followed(series.score);
  std::string tip =
      fmt::format("{}, commit {}\n{}", point.started.substr(0, 10), point.commit, series.system);
  if (!point.version.empty()) tip += " " + point.version;
  if (point.median) {
    tip += fmt::format(": {:.4g} {}", followed.factor * *point.median, followed.unit);
  }
  if (point.low && point.high && point.seeds > 1) {
    tip += fmt::format(" ({:.4g} to {:.4g})", followed.factor * *point.low,
                       followed.factor * *point.high);
  }
  if (point.failed > 0) tip += fmt::format("\n{} of {} seeds failed", point.failed, point.seeds);
  return tip;
}

/// Nights in a row of which a system has a number.
struct Stretch {
  Points line, low, high;
};

void DrawSeries(const NightSeries& series, const std::vector<Night>& nights, const Axis& x,
                const Axis& y, const NightLink& link, Svg* svg) {
  const double factor = Followed(series.score).factor;
  std::vector<Stretch> stretches(1);
  Points limit;
  for (std::size_t i = 0; i < nights.size(); ++i) {
    const TrendPoint* point = series.points[i];
    if (point == nullptr) continue;
    const double at = x(nights[i].day);
    if (point->limit) limit.emplace_back(at, y(factor * *point->limit));
    if (!point->median) {
      stretches.emplace_back();
      continue;
    }
    Stretch& now = stretches.back();
    now.line.emplace_back(at, y(factor * *point->median));
    now.low.emplace_back(at, y(factor * point->low.value_or(*point->median)));
    now.high.emplace_back(at, y(factor * point->high.value_or(*point->median)));
  }
  for (const Stretch& one : stretches) {
    svg->Band(one.low, one.high, fmt::format("band d{}", series.style));
  }
  const bool in_sight = !limit.empty() && limit.back().second >= kTop - 1;
  if (in_sight) svg->Polyline(limit, fmt::format("limit c{}", series.style));
  for (const Stretch& one : stretches) {
    svg->Polyline(one.line, fmt::format("line c{}", series.style), series.system);
  }
  for (std::size_t i = 0; i < nights.size(); ++i) {
    const TrendPoint* point = series.points[i];
    if (point == nullptr || (!point->median && point->failed == 0)) continue;
    const double at = x(nights[i].day);
    const double height = point->median ? y(factor * *point->median) : y.to_px;
    const std::string page = link(nights[i]);
    if (point->failed > 0) {
      svg->Cross(at, height, TipOf(*point, series), page);
    } else {
      svg->Marker(at, height, series.style, TipOf(*point, series), page);
    }
  }
}

}  // namespace

bool HasTrendChart(const std::vector<const NightSeries*>& systems,
                   const std::vector<Night>& nights) {
  return nights.size() >= 2 && Highest(systems) > 0;
}

std::string TrendChart(const std::vector<const NightSeries*>& systems,
                       const std::vector<Night>& nights, const NightLink& link) {
  if (!HasTrendChart(systems, nights)) return "";
  const FollowedScore& followed = Followed(systems.front()->score);
  const double highest = followed.factor * Highest(systems);
  constexpr double kEdge = 15;  // markers of the first and the last night keep off the edges
  const Axis x{nights.front().day, std::max(nights.back().day, nights.front().day + 1e-3), kEdge,
               kAcross - kEdge};
  const Axis y{0, 1.1 * highest, kBottom, kTop};
  Svg svg = Svg::Chart(kBottom + 36, std::string(followed.title) + " by night");
  svg.Grid({0, 1, 0, kAcross}, y, "",
           fmt::format("{} [{}], median over seeds", followed.title, followed.unit),
           {.x_lines = false});
  NameNights(nights, x, &svg);
  std::vector<std::pair<std::string, std::string>> legend;
  for (const NightSeries* series : systems) {
    DrawSeries(*series, nights, x, y, link, &svg);
    legend.emplace_back(series->system, fmt::format("line c{}", series->style));
  }
  return svg.Finish() + Legend(legend);
}

}  // namespace aisle
