#include "simulator/scene/prop.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "simulator/scene/footprint.h"

namespace aisle::sim {
namespace {

struct Known {
  const char* model;
  double back_m, right_m, front_m, left_m;  ///< x from, y from, x to, y to
};

/// Of assets/kit and assets/street, as their meshes are; a test holds them to it.
constexpr std::array kKnown = {Known{"bollard", -0.08, -0.08, 0.08, 0.08},
                               Known{"cone", -0.12, -0.12, 0.12, 0.12},
                               Known{"conveyor", -1, -0.37, 1, 0.37},
                               Known{"conveyor_loaded", -1, -0.37, 1, 0.37},
                               Known{"dock_door", -0.07, -1.67, 0.23, 1.67},
                               Known{"drum", -0.3, -0.3, 0.3, 0.3},
                               Known{"floor_sign", -0.15, -0.15, 0.15, 0.15},
                               Known{"guard_rail", -0.8, -0.06, 0.8, 0.06},
                               Known{"hedge", -0.42, -1.62, 0.41, 1.63},
                               Known{"house_brick", -9.06, -5.69, 0.75, 5.69},
                               Known{"house_grey", -9.06, -4.69, 0.75, 4.69},
                               Known{"house_plaster", -9.22, -6.31, 0.75, 6.31},
                               Known{"house_shop", -9.22, -7.06, 0.75, 7.06},
                               Known{"house_tall", -9.22, -5.06, 0.75, 5.06},
                               Known{"lamp_post", -0.11, -0.11, 0.11, 0.11},
                               Known{"pallet", -0.6, -0.4, 0.6, 0.4},
                               Known{"pallet_cartons", -0.6, -0.4, 0.6, 0.4},
                               Known{"pallet_wrapped", -0.6, -0.4, 0.6, 0.4},
                               Known{"roll_cage", -0.4, -0.35, 0.4, 0.35},
                               Known{"sign_crossing", -0.03, -0.03, 0.03, 0.03},
                               Known{"sign_parking", -0.03, -0.03, 0.03, 0.03},
                               Known{"sign_priority", -0.03, -0.03, 0.03, 0.03},
                               Known{"sign_speed", -0.03, -0.03, 0.03, 0.03},
                               Known{"step_ladder", -0.63, -0.32, 0.56, 0.32},
                               Known{"tote", -0.31, -0.2, 0.31, 0.2},
                               Known{"tree_round", -0.11, -0.15, 0.14, 0.11},
                               Known{"tree_slim", -0.13, -0.13, 0.15, 0.13},
                               Known{"waste_bin", -0.36, -0.3, 0.31, 0.3}};

}  // namespace

std::vector<Eigen::Vector2d> PlacesOf(const PropSpec& prop) {
  if (!prop.to) return {prop.at};
  const Eigen::Vector2d way = *prop.to - prop.at;
  const int steps = static_cast<int>(std::floor(way.norm() / prop.every_m + 1e-6));
  std::vector<Eigen::Vector2d> places;
  for (int i = 0; i <= steps; ++i) {
    places.push_back(prop.at + i * prop.every_m * way.normalized());
  }
  return places;
}

std::optional<Eigen::AlignedBox2d> FootprintOf(const PropSpec& prop) {
  const auto known = std::ranges::find(kKnown, prop.model, &Known::model);
  if (!prop.mesh.name.empty() || known == kKnown.end() || prop.above_m >= kHead_m) {
    return std::nullopt;
  }
  Eigen::AlignedBox2d box(Eigen::Vector2d(known->back_m, known->right_m),
                          Eigen::Vector2d(known->front_m, known->left_m));
  if (prop.to) {
    const Eigen::Vector2d far = box.max().cwiseMax(-box.min()) * kPropTurn_rad;
    const Eigen::Vector2d more(far.y(), far.x());
    box = {box.min() - more, box.max() + more};
  }
  return box;
}

}  // namespace aisle::sim
