#include "slam/dynamic/moving_regions.h"

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/median.h"

namespace aisle::slam::dynamic {
namespace {

struct Component {
  int pixels = 0;
  double best = -1e9;
  cv::Rect box;
  int dynamic_points = 0, static_points = 0;
  std::vector<Eigen::Vector3d> drifts;  ///< of the dynamic ones, where known
  std::map<int, int> overlap;           // previous region's index -> nodes
};

std::vector<Component> Describe(const cv::Mat1i& components, int count, const cv::Mat1f& log_odds,
                                const NodeRegions& previous) {
  std::vector<Component> described(static_cast<std::size_t>(count));
  for (int y = 0; y < components.rows; ++y) {
    for (int x = 0; x < components.cols; ++x) {
      if (components(y, x) == 0) continue;
      Component& component = described[static_cast<std::size_t>(components(y, x))];
      const cv::Rect node(x, y, 1, 1);
      component.box = component.pixels == 0 ? node : component.box | node;
      ++component.pixels;
      component.best = std::max(component.best, static_cast<double>(log_odds(y, x)));
      const int before = previous.labels.empty() ? 0 : previous.labels(y, x);
      if (before > 0) ++component.overlap[before - 1];
    }
  }
  return described;
}

void CountVotes(std::vector<Component>& components, const cv::Mat1i& labels,
                const std::vector<PointVote>& votes, const RegionOptions& options) {
  const cv::Rect nodes({0, 0}, labels.size());
  for (const PointVote& vote : votes) {
    if (!nodes.contains(vote.node)) continue;
    Component& component = components[static_cast<std::size_t>(labels(vote.node))];
    if (vote.log_odds > options.vote_log_odds) {
      ++component.dynamic_points;
      if (!vote.drift.isZero()) component.drifts.push_back(vote.drift);
    }
    if (vote.log_odds < -options.vote_log_odds) ++component.static_points;
  }
}

/// Share of the drifts that go the way the middle one goes: parts of one body go together, however
/// its limbs swing, while errors of matching go anywhere. One where too few are known.
double Togetherness(const std::vector<Eigen::Vector3d>& drifts) {
  if (drifts.size() < 3) return 1;
  Eigen::Vector3d middle;
  for (int k = 0; k < 3; ++k) {
    std::vector<double> parts;
    for (const Eigen::Vector3d& drift : drifts) parts.push_back(drift[k]);
    middle[k] = Median(std::move(parts));
  }
  const auto together = std::count_if(drifts.begin(), drifts.end(), [&](const auto& drift) {
    return (drift - middle).norm() < 0.6 * middle.norm();
  });
  return static_cast<double>(together) / static_cast<double>(drifts.size());
}

/// A new region needs points that move together; a known one must not be full of points that do not
/// move.
bool IsMoving(const Component& component, const RegionOptions& options) {
  const bool known = !component.overlap.empty();
  if (component.pixels < options.min_nodes) return false;
  const double share = known ? options.keep_share : options.birth_share;
  if (component.dynamic_points < component.static_points * share) return false;
  if (known && component.dynamic_points < options.keep_points) return false;
  return known || (Togetherness(component.drifts) >= options.birth_together &&
                   component.best >= options.birth_log_odds &&
                   component.dynamic_points >= options.birth_points);
}

/// Gives ids in order of falling overlap, so that the larger part of a split region keeps its name.
std::vector<int> AssignIds(const std::vector<Component>& components,
                           const std::vector<std::size_t>& kept, const NodeRegions& previous,
                           int& next_id) {
  struct Claim {
    int nodes;
    std::size_t component;
    int before;
  };
  std::vector<Claim> claims;
  for (const std::size_t c : kept) {
    for (const auto& [before, nodes] : components[c].overlap) claims.push_back({nodes, c, before});
  }
  std::stable_sort(claims.begin(), claims.end(),
                   [](const Claim& a, const Claim& b) { return a.nodes > b.nodes; });
  std::vector<int> ids(components.size(), -1);
  std::set<int> taken;
  for (const Claim& claim : claims) {
    const int id = previous.regions[static_cast<std::size_t>(claim.before)].id;
    if (ids[claim.component] >= 0 || !taken.insert(id).second) continue;
    ids[claim.component] = id;
  }
  for (const std::size_t c : kept) {
    if (ids[c] < 0) ids[c] = next_id++;
  }
  return ids;
}

}  // namespace

NodeRegions FindRegions(const cv::Mat1f& log_odds, const std::vector<PointVote>& votes,
                        const NodeRegions& previous, int& next_id, const RegionOptions& options) {
  cv::Mat1b above;
  cv::compare(log_odds, options.keep_log_odds, above, cv::CMP_GT);
  cv::Mat1i components;
  const int count = cv::connectedComponents(above, components, 4, CV_32S);
  auto described = Describe(components, count, log_odds, previous);
  CountVotes(described, components, votes, options);

  std::vector<std::size_t> kept;
  for (std::size_t c = 1; c < described.size(); ++c) {
    if (IsMoving(described[c], options)) kept.push_back(c);
  }
  const std::vector<int> ids = AssignIds(described, kept, previous, next_id);

  NodeRegions regions;
  regions.labels = cv::Mat1i(log_odds.size(), 0);
  std::vector<int> label_of(described.size(), 0);
  for (const std::size_t c : kept) {
    regions.regions.push_back({ids[c], described[c].box, described[c].best, {}});
    label_of[c] = static_cast<int>(regions.regions.size());
  }
  for (int k = 0; k < static_cast<int>(components.total()); ++k) {
    regions.labels(k) = label_of[static_cast<std::size_t>(components(k))];
  }
  return regions;
}

}  // namespace aisle::slam::dynamic
