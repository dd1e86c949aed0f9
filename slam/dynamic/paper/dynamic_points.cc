#include "slam/dynamic/paper/dynamic_points.h"

#include <numeric>

#include "slam/dynamic/paper/disparity.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kDisparityRadius = 2;  // pixels around a point in which its disparity is looked up

double GroupDistance(float disparity, const GroupOptions& options) {
  return options.alpha_px + options.beta * disparity;  // Equation (4)
}

bool SameObject(const TestedPoint& a, const TestedPoint& b, const GroupOptions& options) {
  return std::abs(a.disparity - b.disparity) <= options.disparity_px &&
         cv::norm(a.position - b.position) <=
             GroupDistance(std::max(a.disparity, b.disparity), options);
}

/// Smallest member of each element's set, by union-find.
std::vector<std::size_t> ConnectedSets(const std::vector<TestedPoint>& points,
                                       const GroupOptions& options) {
  std::vector<std::size_t> parent(points.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (!SameObject(points[i], points[j], options)) continue;
      const std::size_t a = root(i), b = root(j);
      parent[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) parent[i] = root(i);
  return parent;
}

cv::Rect RegionOfInterest(const std::vector<TestedPoint>& points, cv::Size image,
                          const GroupOptions& options) {
  cv::Point2f low = points.front().position, high = low;
  float disparity = 0;
  for (const TestedPoint& point : points) {
    low = {std::min(low.x, point.position.x), std::min(low.y, point.position.y)};
    high = {std::max(high.x, point.position.x), std::max(high.y, point.position.y)};
    disparity += point.disparity / static_cast<float>(points.size());
  }
  const int margin = cvCeil(options.roi_margin * GroupDistance(disparity, options));
  const cv::Point first(cvFloor(low.x) - margin, cvFloor(low.y) - margin);
  const cv::Point last(cvCeil(high.x) + margin, cvCeil(high.y) + margin);
  return cv::Rect(first, last + cv::Point(1, 1)) & cv::Rect({0, 0}, image);
}

}  // namespace

std::vector<TestedPoint> TestAgainstEpipolarLines(const std::vector<Track>& tracks,
                                                  const FundamentalEstimate& estimate,
                                                  const cv::Mat1f& disparity,
                                                  const EpipolarOptions& options) {
  std::vector<TestedPoint> tested;
  for (const Track& track : tracks) {
    const float d = DisparityNear(disparity, track.current, kDisparityRadius);
    if (d == kNoDisparity) continue;
    const double threshold = options.alpha_px + options.beta * d;  // Equation (3)
    tested.push_back({track.current, d, DistanceFromStatic(estimate, track), threshold});
  }
  return tested;
}

std::vector<PointGroup> GroupDynamicPoints(const std::vector<TestedPoint>& points, cv::Size image,
                                           const GroupOptions& options) {
  std::vector<TestedPoint> dynamic;
  std::copy_if(points.begin(), points.end(), std::back_inserter(dynamic),
               [](const TestedPoint& point) { return point.IsDynamic(); });
  const std::vector<std::size_t> set_of = ConnectedSets(dynamic, options);

  std::map<std::size_t, PointGroup> sets;
  for (std::size_t i = 0; i < dynamic.size(); ++i) sets[set_of[i]].points.push_back(dynamic[i]);
  std::vector<PointGroup> groups;
  for (auto& [first, group] : sets) {
    if (static_cast<int>(group.points.size()) < options.min_points) continue;
    group.roi = RegionOfInterest(group.points, image, options);
    groups.push_back(std::move(group));
  }
  return groups;
}

}  // namespace aisle::slam::dynamic
