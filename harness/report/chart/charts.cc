#include "harness/report/chart/charts.h"

#include "harness/report/chart/map_frame.h"
#include "harness/report/chart/svg.h"

namespace aisle {
namespace {

using Points = std::vector<std::pair<double, double>>;

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

/// Whether the frames that both have show the vehicle at the same places: where the systems steer,
/// each has a drive of its own.
bool IsSameDrive(const std::vector<FrameRow>& a, const std::vector<FrameRow>& b) {
  constexpr double kSame_m = 1e-3;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (a[i].id == b[j].id) {
      if ((a[i++].truth_m - b[j++].truth_m).norm() > kSame_m) return false;
    } else if (a[i].id < b[j].id) {
      ++i;
    } else {
      ++j;
    }
  }
  return true;
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
  for (const ChartSeries& one : series) {
    for (const FrameRow& row : *one.rows) {
      box.extend(Eigen::Vector2d(row.truth_m[ax], row.truth_m[ay]));
    }
  }
  const double extent_m = std::max(box.sizes().maxCoeff(), 0.1);
  const double magnification = Magnification(series, kind, extent_m);
  const double margin_m = 0.09 * extent_m;
  box.extend(box.min() - Eigen::Vector2d::Constant(margin_m));
  box.extend(box.max() + Eigen::Vector2d::Constant(margin_m));
  // The longer side lies across the page.
  const bool swap = box.sizes().y() > box.sizes().x();
  const int across = swap ? 1 : 0, up = swap ? 0 : 1;

  const double scale = (kMapRight - kMapLeft) / box.sizes()[across];
  const double plot_height = std::max(60.0, scale * box.sizes()[up]);
  const Axis x{box.min()[across], box.max()[across], kMapLeft, kMapRight};
  // Seen from above, y grows to the left of x: with y across, x grows downwards.
  const bool down = swap && ax == 0 && ay == 1;
  const double low_px = down ? 34 : 34 + plot_height, high_px = down ? 34 + plot_height : 34;
  const Axis y{box.min()[up], box.max()[up], low_px, high_px};
  Svg svg = Svg::Map(kMapWidth, plot_height + 100, "trajectories from above");
  const char* names = "xyz";
  const auto axis_name = [&](int k) { return names[(k == 0) ? ax : ay]; };
  svg.Grid(x, y, fmt::format("{} [m]", axis_name(across)), fmt::format("{} [m]", axis_name(up)));

  const auto at = [&](const Eigen::Vector3d& p) {
    const Eigen::Vector2d q(p[ax], p[ay]);
    return std::pair(x(q[across]), y(q[up]));
  };
  std::vector<std::pair<std::string, std::string>> legend;
  const auto draw_truth = [&](const std::vector<FrameRow>& rows, const std::string& css,
                              const std::string& name) {
    Points way;
    for (const FrameRow& row : rows) way.push_back(at(row.truth_m));
    svg.Polyline(way, css);
    legend.emplace_back(name, css);
  };
  const bool one_drive = std::all_of(series.begin(), series.end(), [&](const ChartSeries& one) {
    return IsSameDrive(*longest, *one.rows);
  });
  if (one_drive) draw_truth(*longest, "truth", "truth");
  for (const ChartSeries& one : series) {
    if (!one_drive) {
      draw_truth(*one.rows, fmt::format("truth c{}", one.color), "truth of " + one.name);
    }
    const std::string css = fmt::format("line c{}", one.color);
    const auto point = [&](const FrameRow& row) -> std::optional<std::pair<double, double>> {
      const auto& track_m = PositionOf(row, kind);
      if (!track_m) return std::nullopt;
      return at(row.truth_m + magnification * (*track_m - row.truth_m));
    };
    if (!svg.Pieces(Pieces(*one.rows, point), css, one.name)) continue;  // it has no track
    legend.emplace_back(one.seed.empty() ? one.name : one.name + ", " + one.seed, css);
  }
  const auto [start_x, start_y] = at(longest->front().truth_m);
  svg.Circle(start_x, start_y, 4, "start", "start");
  const std::string note = magnification == 1
                               ? "deviations to scale"
                               : fmt::format("deviations from truth drawn ×{:g}", magnification);
  svg.Text(kMapLeft, plot_height + 88, note, "axis");
  return svg.Finish() + Legend(legend);
}

}  // namespace aisle
