#include "harness/report/chart/charts.h"

#include "harness/report/chart/svg.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr double kWidth = 860, kLeft = 52, kRight = 846;
using Points = std::vector<std::pair<double, double>>;

// --- From above
// -----------------------------------------------------------------------------------

/// The two world axes along which the truth extends most, in the order x, y, z.
std::pair<int, int> WidestPlane(const std::vector<FrameRow>& rows) {
  Eigen::AlignedBox3d box;
  for (const FrameRow& row : rows) box.extend(row.truth_m);
  const Eigen::Vector3d size = box.sizes();
  int least = 2;  // a warehouse is flat: look from above unless the path says otherwise
  for (int axis = 1; axis >= 0; --axis) {
    if (size[axis] < size[least] - 1e-3 && size[2] > 1) least = axis;
  }
  return least == 0 ? std::pair(1, 2) : least == 1 ? std::pair(0, 2) : std::pair(0, 1);
}

const std::optional<Eigen::Vector3d>& PositionOf(const FrameRow& row, TrackKind kind) {
  return kind == TrackKind::kLive ? row.live_m : row.final_m;
}

/// 1, 2, 5, 10, …: the factor that makes the largest deviation a visible part of the extent.
double Magnification(const std::vector<ChartSeries>& series, TrackKind kind, double extent_m) {
  double largest_m = 0;
  for (const ChartSeries& one : series) {
    for (const FrameRow& row : *one.rows) {
      const auto& at_m = PositionOf(row, kind);
      if (at_m) largest_m = std::max(largest_m, (*at_m - row.truth_m).norm());
    }
  }
  constexpr double kVisible = 0.06;
  if (largest_m <= 0) return 1;
  double factor = 1;
  for (const double candidate : {2., 5., 10., 20., 50., 100., 200., 500.}) {
    if (candidate * largest_m <= kVisible * extent_m) factor = candidate;
  }
  return factor;
}

/// Pieces of a line that has gaps.
std::vector<Points> Pieces(
    const std::vector<FrameRow>& rows,
    const std::function<std::optional<std::pair<double, double>>(const FrameRow&)>& point) {
  std::vector<Points> pieces(1);
  for (const FrameRow& row : rows) {
    if (const auto at = point(row)) {
      pieces.back().push_back(*at);
    } else if (!pieces.back().empty()) {
      pieces.emplace_back();
    }
  }
  return pieces;
}

}  // namespace

const std::vector<FrameRow>* Longest(const std::vector<ChartSeries>& series) {
  const std::vector<FrameRow>* longest = nullptr;
  for (const ChartSeries& one : series) {
    if (longest == nullptr || one.rows->size() > longest->size()) longest = one.rows;
  }
  return longest != nullptr && longest->size() >= 2 ? longest : nullptr;
}

std::string TopViewChart(const std::vector<ChartSeries>& series, TrackKind kind) {
  const std::vector<FrameRow>* longest = Longest(series);
  if (longest == nullptr) return "";
  const auto [ax, ay] = WidestPlane(*longest);
  Eigen::AlignedBox2d box;
  for (const FrameRow& row : *longest)
    box.extend(Eigen::Vector2d(row.truth_m[ax], row.truth_m[ay]));
  const double extent_m = std::max(box.sizes().maxCoeff(), 0.1);
  const double magnification = Magnification(series, kind, extent_m);
  const double margin_m = 0.09 * extent_m;
  box.extend(box.min() - Eigen::Vector2d::Constant(margin_m));
  box.extend(box.max() + Eigen::Vector2d::Constant(margin_m));
  // The longer side lies across the page.
  const bool swap = box.sizes().y() > box.sizes().x();
  const int across = swap ? 1 : 0, up = swap ? 0 : 1;

  const double scale = (kRight - kLeft) / box.sizes()[across];
  const double plot_height = std::max(60.0, scale * box.sizes()[up]);
  const Axis x{box.min()[across], box.max()[across], kLeft, kRight};
  const Axis y{box.min()[up], box.max()[up], 24 + plot_height, 24};
  Svg svg(kWidth, plot_height + 84, "trajectories from above");
  const char* names = "xyz";
  const auto axis_name = [&](int k) { return names[(k == 0) ? ax : ay]; };
  svg.Grid(x, y, fmt::format("{} [m]", axis_name(across)), fmt::format("{} [m]", axis_name(up)));

  const auto at = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector2d q(p[ax], p[ay]);
    return std::pair(x(q[across]), y(q[up]));
  };
  std::vector<std::pair<std::string, std::string>> legend = {{"truth", "truth"}};
  for (const Points& piece :
       Pieces(*longest, [&](const FrameRow& row) { return std::optional(at(row.truth_m)); })) {
    svg.Polyline(piece, "truth");
  }
  for (const ChartSeries& one : series) {
    const std::string css = fmt::format("line c{}", one.color);
    const auto point = [&](const FrameRow& row) -> std::optional<std::pair<double, double>> {
      const auto& track_m = PositionOf(row, kind);
      if (!track_m) return std::nullopt;
      return at(row.truth_m + magnification * (*track_m - row.truth_m));
    };
    for (const Points& piece : Pieces(*one.rows, point)) svg.Polyline(piece, css, one.name);
    legend.emplace_back(one.name, css);
  }
  const auto [start_x, start_y] = at(longest->front().truth_m);
  svg.Circle(start_x, start_y, 4, "start", "start");
  svg.Legend(legend, kLeft, plot_height + 72);
  const std::string note = magnification == 1
                               ? "deviations to scale"
                               : fmt::format("deviations from truth drawn ×{:g}", magnification);
  svg.Text(kRight, plot_height + 72, note, "axis", "end");
  return svg.Finish();
}

std::string StageChart(const std::vector<StageRow>& rows) {
  double longest_ms = 1;
  for (const StageRow& row : rows) {
    double sum = 0;
    for (const StageBar& bar : row.bars) sum += bar.ms;
    longest_ms = std::max(longest_ms, sum);
  }
  constexpr double kRowHeight = 30, kNames = 110;
  const double bottom = 10 + kRowHeight * static_cast<double>(rows.size());
  const Axis x{0, 1.02 * longest_ms, kNames, kRight};
  Svg svg(kWidth, bottom + 40, "time per frame by stage");
  for (const double tick : Ticks(0, longest_ms, 8)) {
    svg.Line(x(tick), 6, x(tick), bottom, "grid");
    svg.Text(x(tick), bottom + 15, fmt::format("{:g}", tick), "tick", "middle");
  }
  svg.Text(kRight, bottom + 32, "mean per frame [ms]", "axis", "end");
  double top = 10;
  for (const StageRow& row : rows) {
    svg.Text(kNames - 8, top + 16, row.system, "legend", "end");
    double at_ms = 0;
    for (const StageBar& bar : row.bars) {
      const double width = x(at_ms + bar.ms) - x(at_ms);
      svg.Rect(x(at_ms), top, width, kRowHeight - 8, fmt::format("bar b{}", bar.color % 8),
               fmt::format("{} {:.2f} ms", bar.name, bar.ms));
      if (width > 8.0 * static_cast<double>(bar.name.size())) {
        svg.Text(x(at_ms) + 4, top + 15, bar.name, "inbar");
      }
      at_ms += bar.ms;
    }
    top += kRowHeight;
  }
  return svg.Finish();
}

std::string SpreadChart(const std::vector<SpreadRow>& rows, const std::string& axis) {
  double highest = 0;
  for (const SpreadRow& row : rows) {
    for (const double value : row.values) highest = std::max(highest, value);
  }
  if (highest <= 0) return "";
  constexpr double kRowHeight = 30, kNames = 110;
  const double bottom = 10 + kRowHeight * static_cast<double>(rows.size());
  const Axis x{0, 1.05 * highest, kNames, kRight};
  Svg svg(kWidth, bottom + 40, "spread over seeds");
  for (const double tick : Ticks(0, x.high, 8)) {
    svg.Line(x(tick), 6, x(tick), bottom, "grid");
    svg.Text(x(tick), bottom + 15, fmt::format("{:g}", tick), "tick", "middle");
  }
  svg.Text(kRight, bottom + 32, axis, "axis", "end");
  double middle = 10 + kRowHeight / 2;
  for (const SpreadRow& row : rows) {
    svg.Text(kNames - 8, middle + 4, row.system, "legend", "end");
    if (row.values.size() > 2) {
      const double low = x(Quantile(row.values, 0.25)), high = x(Quantile(row.values, 0.75));
      const double least = x(Quantile(row.values, 0)), most = x(Quantile(row.values, 1));
      const std::string css = fmt::format("box c{}", row.color);
      svg.Line(least, middle, low, middle, css);
      svg.Line(high, middle, most, middle, css);
      svg.Rect(low, middle - 8, high - low, 16, css);
    }
    if (!row.values.empty()) {
      const double median = x(Quantile(row.values, 0.5));
      svg.Line(median, middle - 10, median, middle + 10, fmt::format("line c{}", row.color));
    }
    for (const double value : row.values) {
      svg.Circle(x(value), middle, 4, fmt::format("dot d{}", row.color),
                 fmt::format("{:.4g}", value));
    }
    middle += kRowHeight;
  }
  return svg.Finish();
}

}  // namespace aisle
