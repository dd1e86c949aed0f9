#include "slam/dynamic/label_memory.h"

#include "slam/dynamic/dense_evidence.h"
#include "slam/dynamic/median.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kNodePixels = 2 * kNodeHalfPixels;

/// Centre of a node in half-size pixels, and the node that holds a half-size pixel.
double CentreOf(int node) { return (node + 0.5) * kNodeHalfPixels - 0.5; }
int NodeOf(double half_pixel) {
  return static_cast<int>(std::floor((half_pixel + 0.5) / kNodeHalfPixels));
}

}  // namespace

std::vector<cv::Point2f> RegionFlows(const NodeRegions& previous,
                                     const std::vector<PointTrack>& tracks) {
  std::vector<std::vector<float>> u(previous.regions.size()), v(previous.regions.size());
  const cv::Rect nodes({0, 0}, previous.labels.size());
  for (const PointTrack& track : tracks) {
    if (track.seen.size() < 2) continue;
    const Eigen::Vector3d& before = track.seen[track.seen.size() - 2];
    const cv::Point node(static_cast<int>(before.x()) / kNodePixels,
                         static_cast<int>(before.y()) / kNodePixels);
    if (!nodes.contains(node) || previous.labels(node) == 0) continue;
    const auto region = static_cast<std::size_t>(previous.labels(node) - 1);
    u[region].push_back(static_cast<float>(track.now().x() - before.x()));
    v[region].push_back(static_cast<float>(track.now().y() - before.y()));
  }
  std::vector<cv::Point2f> flows;
  for (std::size_t r = 0; r < u.size(); ++r)
    flows.emplace_back(Median(std::move(u[r])), Median(std::move(v[r])));
  return flows;
}

LabelMemory CarryMemory(const LabelMemory& previous, const std::vector<cv::Point2f>& region_flows,
                        const cv::Mat1f& node_disparity, const Eigen::Isometry3d& T_before_now,
                        const StereoCamera& half) {
  LabelMemory carried;
  carried.log_odds = cv::Mat1f(node_disparity.size(), 0.0F);
  carried.regions.labels = cv::Mat1i(node_disparity.size(), 0);
  carried.regions.regions = previous.regions.regions;
  if (previous.log_odds.empty()) return carried;
  const cv::Rect nodes({0, 0}, node_disparity.size());

  for (int y = 0; y < node_disparity.rows; ++y) {
    for (int x = 0; x < node_disparity.cols; ++x) {
      const double disparity = std::max(node_disparity(y, x), 0.01F);
      const Eigen::Vector3d point =
          T_before_now * Backproject(half, {CentreOf(x), CentreOf(y), disparity});
      if (point.z() < 0.05) continue;
      const Eigen::Vector3d before = Project(half, point);
      const cv::Point from(NodeOf(before.x()), NodeOf(before.y()));
      if (nodes.contains(from) && previous.regions.labels(from) == 0) {
        carried.log_odds(y, x) = previous.log_odds(from);
      }
    }
  }
  for (std::size_t r = 0; r < region_flows.size(); ++r) {
    const cv::Point shift(cvRound(region_flows[r].x / kNodePixels),
                          cvRound(region_flows[r].y / kNodePixels));
    const cv::Rect reach = (previous.regions.regions[r].box + shift) & nodes;
    for (int y = reach.y; y < reach.y + reach.height; ++y) {
      for (int x = reach.x; x < reach.x + reach.width; ++x) {
        const cv::Point from = cv::Point(x, y) - shift;
        if (!nodes.contains(from) || previous.regions.labels(from) != static_cast<int>(r) + 1) {
          continue;
        }
        carried.log_odds(y, x) = std::max(carried.log_odds(y, x), previous.log_odds(from));
        carried.regions.labels(y, x) = static_cast<int>(r) + 1;
      }
    }
  }
  return carried;
}

}  // namespace aisle::slam::dynamic
