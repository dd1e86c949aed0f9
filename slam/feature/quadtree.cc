#include "slam/feature/quadtree.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace aisle::slam {
namespace {

bool UpperLeft(const Corner& a, const Corner& b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); }

bool Stronger(const Corner& a, const Corner& b) {
  if (a.response != b.response) return a.response > b.response;
  return UpperLeft(a, b);
}

/// A square of the image and its share [begin, end) of the corners.
struct Node {
  int x, y, side;  // pixels; sides are powers of two, so squares of one depth are equal
  std::size_t begin, end;
  int order;  // of creation: the last tie-breaker

  std::size_t size() const { return end - begin; }
};

struct SplitLater {
  bool operator()(const Node& a, const Node& b) const {
    return std::make_tuple(a.side, a.size(), -a.order) <
           std::make_tuple(b.side, b.size(), -b.order);
  }
};

/// The non-empty quarters of a node, upper left first; reorders its share of the corners.
std::vector<Node> Quarter(const Node& node, std::vector<Corner>& corners, int& created) {
  const int half = node.side / 2;
  const auto at = [&](std::size_t i) { return corners.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto split = [&](std::size_t begin, std::size_t end, auto&& first_half) {
    return static_cast<std::size_t>(std::partition(at(begin), at(end), first_half) -
                                    corners.begin());
  };
  const auto upper = [&](const Corner& c) { return c.y < node.y + half; };
  const auto left = [&](const Corner& c) { return c.x < node.x + half; };
  const std::size_t middle = split(node.begin, node.end, upper);
  const std::size_t upper_middle = split(node.begin, middle, left);
  const std::size_t lower_middle = split(middle, node.end, left);
  std::vector<Node> quarters;
  for (const Node& quarter :
       {Node{node.x, node.y, half, node.begin, upper_middle, 0},
        Node{node.x + half, node.y, half, upper_middle, middle, 0},
        Node{node.x, node.y + half, half, middle, lower_middle, 0},
        Node{node.x + half, node.y + half, half, lower_middle, node.end, 0}}) {
    if (quarter.size() == 0) continue;
    quarters.push_back(quarter);
    quarters.back().order = created++;
  }
  return quarters;
}

}  // namespace

std::vector<Corner> DistributeCorners(std::span<const Corner> corners, int count) {
  std::vector<Corner> pool(corners.begin(), corners.end());
  if (!std::is_sorted(pool.begin(), pool.end(), UpperLeft)) {
    std::sort(pool.begin(), pool.end(), UpperLeft);
  }
  const auto wanted = static_cast<std::size_t>(std::max(count, 0));
  if (pool.size() <= wanted) return pool;
  if (wanted == 0) return {};

  int side = 1;
  for (const Corner& corner : pool) {
    while (side <= std::max(corner.x, corner.y)) side *= 2;
  }
  std::priority_queue<Node, std::vector<Node>, SplitLater> open;
  std::vector<Node> leaves;  // one corner each
  int created = 0;
  open.push({0, 0, side, 0, pool.size(), created++});
  while (!open.empty() && open.size() + leaves.size() < wanted) {
    const Node node = open.top();
    open.pop();
    for (const Node& quarter : Quarter(node, pool, created)) {
      // A square of one pixel holds more than one corner only where one was given twice.
      quarter.size() > 1 && quarter.side > 1 ? open.push(quarter) : leaves.push_back(quarter);
    }
  }
  for (; !open.empty(); open.pop()) leaves.push_back(open.top());

  std::vector<Corner> chosen;
  for (const Node& node : leaves) {
    chosen.push_back(*std::min_element(pool.begin() + static_cast<std::ptrdiff_t>(node.begin),
                                       pool.begin() + static_cast<std::ptrdiff_t>(node.end),
                                       Stronger));
  }
  // The last split may have brought up to three too many.
  std::sort(chosen.begin(), chosen.end(), Stronger);
  chosen.resize(std::min(chosen.size(), wanted));
  std::sort(chosen.begin(), chosen.end(), UpperLeft);
  return chosen;
}

}  // namespace aisle::slam
