#include "simulator/scene/footprint.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace aisle::sim {
namespace {

using Line = std::array<Eigen::Vector2d, 2>;

double DistanceToLine(const Eigen::Vector2d& point, const Eigen::Vector2d& from,
                      const Eigen::Vector2d& to) {
  const Eigen::Vector2d along = to - from;
  const double squared = along.squaredNorm();
  const double share = squared > 0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0;
  return (point - from - share * along).norm();
}

double DistanceOfLines(const Line& a, const Line& b) {
  const auto side = [](const Eigen::Vector2d& p, const Line& line) {
    const Eigen::Vector2d along = line[1] - line[0], to = p - line[0];
    return along.x() * to.y() - along.y() * to.x();
  };
  if (side(a[0], b) * side(a[1], b) < 0 && side(b[0], a) * side(b[1], a) < 0) return 0;
  return std::min({DistanceToLine(a[0], b[0], b[1]), DistanceToLine(a[1], b[0], b[1]),
                   DistanceToLine(b[0], a[0], a[1]), DistanceToLine(b[1], a[0], a[1])});
}

/// The footprint's line on the floor.
Line LineOf(const Footprint& footprint, const RouteState& state) {
  const Eigen::Vector2d ahead(std::cos(state.heading_rad), std::sin(state.heading_rad));
  return {state.position + footprint.back_m * ahead, state.position + footprint.front_m * ahead};
}

}  // namespace

Footprint FootprintOf(const std::string& model) {
  if (model.starts_with("car_van")) return {-0.05, 3.15, 0.85};
  if (model.starts_with("car")) return {-0.1, 2.8, 0.85};
  if (model.starts_with("cyclist")) return {0, 1.05, 0.3};
  if (model.starts_with("agv")) return {-0.25, 0.3, 0.38};
  if (model.starts_with("pallet_jack")) return {-1.4, 0, 0.25};
  if (model.starts_with("reach_truck")) return {-1.4, 0.2, 0.55};
  if (model.starts_with("bus")) return {-1.8, 6.5, 1.2};
  if (model.starts_with("tow_tractor")) return {-0.1, 1.1, 0.45};
  if (model.starts_with("tow_trailer")) return {-0.4, 0.4, 0.45};
  if (model.starts_with("scrubber")) return {-0.3, 0.9, 0.42};
  if (model.starts_with("order_picker")) return {-1.4, 1.1, 0.45};
  return {-1.5, 1.0, 0.62};  // forklifts
}

double AheadOfPusher(const std::string& model) {
  constexpr double kHands_m = 0.53;
  return model.starts_with("pallet_jack") ? kHands_m + 1.62 : kHands_m;
}

std::vector<double> DiscsAlong(const Footprint& footprint, double origin_m) {
  const double length = footprint.front_m - footprint.back_m;
  const int discs = 1 + static_cast<int>(std::ceil(length / footprint.radius_m));
  std::vector<double> ahead_m;
  for (int i = 0; i < discs; ++i) {
    ahead_m.push_back(origin_m + footprint.back_m + length * i / std::max(1, discs - 1));
  }
  return ahead_m;
}

double Apart(const Footprint& one, const RouteState& one_at, const Footprint& other,
             const RouteState& other_at) {
  return DistanceOfLines(LineOf(one, one_at), LineOf(other, other_at));
}

}  // namespace aisle::sim
