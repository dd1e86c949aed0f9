#include "slam/dynamic/spread_features.h"

#include <tbb/parallel_for.h>

#include <opencv2/features2d.hpp>
#include <queue>

namespace aisle::slam::dynamic {
namespace {

constexpr int kFastRadius = 3;  // FAST compares with a circle of this radius

struct Node {
  cv::Rect2f area;
  std::vector<Corner> corners;
  int depth = 0;
  int serial = 0;  // order of birth: breaks ties the same way in every run
};

struct SplitsLater {
  bool operator()(const Node& a, const Node& b) const {
    if (a.depth != b.depth) return a.depth > b.depth;
    if (a.corners.size() != b.corners.size()) return a.corners.size() < b.corners.size();
    return a.serial > b.serial;
  }
};

bool CanSplit(const Node& node) { return node.corners.size() > 1 && node.area.width > 1.0F; }

std::array<Node, 4> Split(const Node& node) {
  const float w = node.area.width / 2, h = node.area.height / 2;
  std::array<Node, 4> children;
  for (int k = 0; k < 4; ++k) {
    const float column = static_cast<float>(k % 2), row = static_cast<float>(k / 2);
    children[static_cast<std::size_t>(k)].area =
        cv::Rect2f(node.area.x + column * w, node.area.y + row * h, w, h);
    children[static_cast<std::size_t>(k)].depth = node.depth + 1;
  }
  for (const Corner& corner : node.corners) {
    const int column = corner.position.x < node.area.x + w ? 0 : 1;
    const int row = corner.position.y < node.area.y + h ? 0 : 1;
    children[static_cast<std::size_t>(2 * row + column)].corners.push_back(corner);
  }
  return children;
}

Corner Strongest(const std::vector<Corner>& corners) {
  return *std::max_element(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return a.response < b.response;
  });
}

std::vector<Node> InitialNodes(const std::vector<Corner>& corners, cv::Size image) {
  const int columns = std::max(1, cvRound(static_cast<double>(image.width) / image.height));
  const float width = static_cast<float>(image.width) / static_cast<float>(columns);
  std::vector<Node> nodes(static_cast<std::size_t>(columns));
  for (int k = 0; k < columns; ++k) {
    nodes[static_cast<std::size_t>(k)].area =
        cv::Rect2f(static_cast<float>(k) * width, 0, width, static_cast<float>(image.height));
  }
  for (const Corner& corner : corners) {
    const int k = std::clamp(static_cast<int>(corner.position.x / width), 0, columns - 1);
    nodes[static_cast<std::size_t>(k)].corners.push_back(corner);
  }
  return nodes;
}

}  // namespace

std::vector<Corner> DetectInCells(const cv::Mat1b& image, const SpreadOptions& options) {
  const cv::Rect inner(options.border_px, options.border_px, image.cols - 2 * options.border_px,
                       image.rows - 2 * options.border_px);
  if (inner.width <= 0 || inner.height <= 0) return {};
  const int columns = (inner.width + options.cell_px - 1) / options.cell_px;
  const int rows = (inner.height + options.cell_px - 1) / options.cell_px;
  std::vector<std::vector<Corner>> cells(static_cast<std::size_t>(columns * rows));

  tbb::parallel_for(0, columns * rows, [&](int cell) {
    const cv::Rect square = inner & cv::Rect(inner.x + cell % columns * options.cell_px,
                                             inner.y + cell / columns * options.cell_px,
                                             options.cell_px, options.cell_px);
    // FAST cannot judge the rim of what it is given: give it the neighbours' rim as well.
    const cv::Rect seen(square.x - kFastRadius, square.y - kFastRadius,
                        square.width + 2 * kFastRadius, square.height + 2 * kFastRadius);
    std::vector<cv::KeyPoint> found;
    cv::FAST(image(seen), found, options.fast_threshold, true);
    if (found.empty()) cv::FAST(image(seen), found, options.fast_threshold_low, true);
    for (const cv::KeyPoint& point : found) {
      cells[static_cast<std::size_t>(cell)].push_back(
          {point.pt + cv::Point2f(seen.tl()), point.response});
    }
  });

  std::vector<Corner> corners;
  for (const auto& cell : cells) corners.insert(corners.end(), cell.begin(), cell.end());
  return corners;
}

std::vector<Corner> SpreadByQuadtree(const std::vector<Corner>& corners, cv::Size image,
                                     int count) {
  std::priority_queue<Node, std::vector<Node>, SplitsLater> open;
  std::vector<Node> leaves;
  int serial = 0;
  const auto admit = [&](Node node) {
    if (node.corners.empty()) return;
    node.serial = serial++;
    if (CanSplit(node)) {
      open.push(std::move(node));
    } else {
      leaves.push_back(std::move(node));
    }
  };

  for (Node& node : InitialNodes(corners, image)) admit(std::move(node));
  while (!open.empty() && static_cast<int>(open.size() + leaves.size()) < count) {
    const Node node = open.top();
    open.pop();
    for (Node& child : Split(node)) admit(std::move(child));
  }
  for (; !open.empty(); open.pop()) leaves.push_back(open.top());

  std::vector<Corner> kept;
  kept.reserve(leaves.size());
  for (const Node& leaf : leaves) kept.push_back(Strongest(leaf.corners));
  return kept;
}

std::vector<cv::Point2f> SpreadFeatures(const cv::Mat1b& image, const SpreadOptions& options) {
  std::vector<cv::Point2f> points;
  for (const Corner& corner :
       SpreadByQuadtree(DetectInCells(image, options), image.size(), options.points)) {
    points.push_back(corner.position);
  }
  return points;
}

}  // namespace aisle::slam::dynamic
