#include "harness/report/chart/drive_chart.h"

#include <algorithm>

#include "harness/common/seconds.h"
#include "harness/report/chart/map_frame.h"
#include "harness/report/chart/svg.h"

namespace aisle {
namespace {

using Points = std::vector<std::pair<double, double>>;

double Seconds(const DriveSample& sample) { return ToSeconds(sample.stamp_ns); }

/// World to map: the longer side across the page.
class FloorMap {
 public:
  explicit FloorMap(const std::vector<DriveSeries>& series) {
    for (const DriveSeries& one : series) {
      for (const FloorPose& pose : one.log->route) box_.extend(pose.position);
      for (const DriveSample& sample : one.log->track.samples) {
        box_.extend(sample.truth.position);
        box_.extend(sample.belief.position);
      }
    }
    constexpr double kMargin_m = 2.5;  // racks on both sides are seen
    box_.min().array() -= kMargin_m;
    box_.max().array() += kMargin_m;
    swap_ = box_.sizes().y() > box_.sizes().x();
    const int across = swap_ ? 1 : 0, up = swap_ ? 0 : 1;
    const double scale = (kMapRight - kMapLeft) / box_.sizes()[across];
    height_ = scale * box_.sizes()[up];
    x_ = {box_.min()[across], box_.max()[across], kMapLeft, kMapRight};
    // Seen from above, y grows to the left of x: with y across, x grows downwards.
    y_ = swap_ ? Axis{box_.min()[up], box_.max()[up], 20, 20 + height_}
               : Axis{box_.min()[up], box_.max()[up], 20 + height_, 20};
  }

  Svg Open() const {
    Svg svg = Svg::Map(kMapWidth, height_ + 80, "the drives from above");
    svg.Grid(x_, y_, swap_ ? "y [m]" : "x [m]", swap_ ? "x [m]" : "y [m]");
    return svg;
  }
  std::pair<double, double> operator()(const Eigen::Vector2d& point) const {
    return swap_ ? std::pair(x_(point.y()), y_(point.x()))
                 : std::pair(x_(point.x()), y_(point.y()));
  }
  bool Shows(const std::vector<Eigen::Vector2d>& outline) const {
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : outline) box.extend(corner);
    return box_.intersects(box);
  }
  /// A closed outline, cut to what the map shows.
  Points Outline(const std::vector<Eigen::Vector2d>& outline) const {
    Points points;
    for (const Eigen::Vector2d& corner : outline) {
      points.push_back((*this)(corner.cwiseMax(box_.min()).cwiseMin(box_.max())));
    }
    if (!points.empty()) points.push_back(points.front());
    return points;
  }

 private:
  Eigen::AlignedBox2d box_;
  bool swap_ = false;
  double height_ = 0;
  Axis x_, y_;
};

std::vector<Eigen::Vector2d> Placed(const std::vector<Eigen::Vector2d>& footprint,
                                    const FloorPose& pose) {
  std::vector<Eigen::Vector2d> placed;
  for (const Eigen::Vector2d& corner : footprint) placed.push_back(pose * corner);
  return placed;
}

template <class PoseOf>
Points Way(const FloorMap& map, const DriveTrack& track, const PoseOf& pose_of) {
  Points points;
  for (const DriveSample& sample : track.samples) points.push_back(map(pose_of(sample).position));
  return points;
}

std::string InWords(const Contact& contact) {
  return fmt::format("{:.1f} s: touches {} at {:.2f} m/s", ToSeconds(contact.stamp_ns),
                     contact.with, std::abs(contact.speed_mps));
}

void DrawDrive(const FloorMap& map, const DriveSeries& one, Svg* svg) {
  const DriveTrack& track = one.log->track;
  const std::string css = fmt::format("line c{}", one.color);
  svg->Polyline(Way(map, track, [](const DriveSample& s) { return s.truth; }), css);
  svg->Polyline(Way(map, track, [](const DriveSample& s) { return s.belief; }), css + " thin");
  const auto footprint = [&](const FloorPose& pose) {
    svg->Polyline(map.Outline(Placed(one.log->footprint, pose)), css + " thin");
  };
  if (const DriveSample* worst = WorstSample(track)) footprint(worst->truth);
  if (!track.samples.empty()) footprint(track.samples.back().truth);
  for (const Contact& contact : track.contacts) {
    footprint(contact.vehicle);
    const auto [x, y] = map(contact.vehicle.position);
    svg->Cross(x, y, one.name + ", " + InWords(contact));
  }
}

}  // namespace

const DriveSample* WorstSample(const DriveTrack& track) {
  const auto worst = std::ranges::max_element(
      track.samples, {}, [](const DriveSample& sample) { return std::abs(sample.cross_track_m); });
  return worst == track.samples.end() ? nullptr : &*worst;
}

std::string DrivePlanChart(const std::vector<DriveSeries>& series) {
  if (series.empty()) return "";
  const FloorMap map(series);
  Svg svg = map.Open();
  const DriveLog& first = *series.front().log;
  for (const FloorThing& thing : first.things) {
    if (map.Shows(thing.outline)) svg.Polyline(map.Outline(thing.outline), "thing");
  }
  Points route;
  for (const FloorPose& pose : first.route) route.push_back(map(pose.position));
  svg.Polyline(route, "truth");
  std::vector<std::pair<std::string, std::string>> legend = {{"planned route", "truth"}};
  for (const DriveSeries& one : series) {
    DrawDrive(map, one, &svg);
    legend.emplace_back(one.name, fmt::format("line c{}", one.color));
  }
  if (!first.route.empty()) {
    const auto [x, y] = map(first.route.front().position);
    svg.Circle(x, y, 4, "start", "start");
  }
  return svg.Finish() + Legend(legend);
}

std::string DriveErrorChart(const std::vector<DriveSeries>& series) {
  double longest_s = 0, farthest_cm = 1;
  for (const DriveSeries& one : series) {
    for (const DriveSample& sample : one.log->track.samples) {
      longest_s = std::max(longest_s, Seconds(sample));
      farthest_cm = std::max(farthest_cm, 100 * std::abs(sample.cross_track_m));
    }
  }
  if (longest_s <= 0) return "";
  constexpr double kHeight = 190, kTop = 12;
  const Axis x{0, longest_s, 0, kAcross};
  const Axis y{-1.1 * farthest_cm, 1.1 * farthest_cm, kTop + kHeight, kTop};
  Svg svg = Svg::Chart(kTop + kHeight + 40, "distance from the route over time");
  svg.Grid(x, y, "time [s]", "left of the route [cm]");
  svg.Line(0, y(0), kAcross, y(0), "grid");
  std::vector<std::pair<std::string, std::string>> legend;
  for (const DriveSeries& one : series) {
    const std::string css = fmt::format("line c{}", one.color);
    Points line;
    for (const DriveSample& sample : one.log->track.samples) {
      line.emplace_back(x(Seconds(sample)), y(100 * sample.cross_track_m));
      const bool held = sample.mode == DriveMode::kStopped || sample.mode == DriveMode::kDegraded ||
                        sample.mode == DriveMode::kScanner;
      if (held) svg.Rect(x(Seconds(sample)), kTop, 2, kHeight, "movers");
    }
    svg.Polyline(line, css, one.name);
    legend.emplace_back(one.name, css);
    for (const Contact& contact : one.log->track.contacts) {
      const double at_s = ToSeconds(contact.stamp_ns);
      svg.Cross(x(at_s), y(0), one.name + ", " + InWords(contact));
    }
  }
  return svg.Finish() + Legend(legend);
}

}  // namespace aisle
