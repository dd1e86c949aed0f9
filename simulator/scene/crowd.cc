#include "simulator/scene/crowd.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/motion/crowd.h"
#include "simulator/scene/degree.h"
#include "simulator/scene/footprint.h"
#include "simulator/scene/obstacles.h"
#include "simulator/scene/rig_path.h"

namespace aisle::sim {
namespace {

/// Places of one disc of a mover, `ahead_m` of where `at` has it.
CrowdIntruder DiscOf(const std::function<RouteState(double)>& at, double ahead_m, double radius_m,
                     double duration_s) {
  CrowdIntruder disc{{}, radius_m};
  const int steps = static_cast<int>(std::ceil(duration_s / kCrowdStep_s)) + 1;
  for (int i = 0; i <= steps; ++i) {
    const RouteState state = at(i * kCrowdStep_s);
    disc.places.emplace_back(
        state.position +
        ahead_m * Eigen::Vector2d(std::cos(state.heading_rad), std::sin(state.heading_rad)));
  }
  return disc;
}

std::vector<CrowdIntruder> IntrudersOf(const Scene& scene) {
  const double duration_s = scene.duration_s() + 5;
  std::vector<CrowdIntruder> all;
  const auto way_of = [](const RouteSpec& spec) {
    return [route = Route(spec.plan, spec.limits)](double time_s) { return route.At(time_s); };
  };
  all.push_back(DiscOf(RigFloorOf(scene), 0.1, kRigBerth_m, duration_s));
  for (const PersonSpec& person : scene.people) {
    all.push_back(DiscOf(way_of(person.route), 0, kPersonReach_m, duration_s));
  }
  for (const VehicleSpec& vehicle : scene.vehicles) {
    const Footprint footprint = FootprintOf(vehicle.model);
    const auto way = way_of(vehicle.route);
    const double origin_m = vehicle.pushed_by.empty() ? 0 : AheadOfPusher(vehicle.model);
    for (const double ahead_m : DiscsAlong(footprint, origin_m)) {
      all.push_back(DiscOf(way, ahead_m, footprint.radius_m, duration_s));
    }
  }
  return all;
}

}  // namespace

int CrowdPeople(const Scene& scene) {
  return (scene.crowd.people * static_cast<int>(scene.dynamics) + 2) / 3;
}

CrowdArea CrowdAreaOf(const Scene& scene) {
  const CrowdSpec& crowd = scene.crowd;
  if (crowd.in) {
    const auto& [x0, y0, x1, y1] = *crowd.in;
    return {{std::min(x0, x1), std::min(y0, y1)}, {std::max(x0, x1), std::max(y0, y1)}};
  }
  if (!crowd.between_racks) return {scene.hall.from, scene.hall.to};
  // Boxes around both rows; the aisle is what lies between them, as long as both are.
  std::array<Eigen::AlignedBox2d, 2> rows;
  for (std::size_t i = 0; i < 2; ++i) {
    const RackSpec& rack = scene.racks.at(static_cast<std::size_t>((*crowd.between_racks)[i]));
    const Eigen::Vector2d along(std::cos(rack.heading_rad), std::sin(rack.heading_rad));
    const Eigen::Vector2d across(-along.y(), along.x());
    for (const double end : {0.0, rack.bays * rack.bay_m}) {
      for (const double side : {-0.5, 0.5}) {
        rows[i].extend(rack.from + end * along + side * rack.depth_m * across);
      }
    }
  }
  CrowdArea area{rows[0].min().cwiseMax(rows[1].min()), rows[0].max().cwiseMin(rows[1].max())};
  for (int axis = 0; axis < 2; ++axis) {  // where they do not overlap, the gap is the aisle
    if (area.from[axis] > area.to[axis]) std::swap(area.from[axis], area.to[axis]);
  }
  return area;
}

void AddCrowd(std::uint64_t seed, Scene* scene) {
  const int people = CrowdPeople(*scene);
  if (people == 0) return;
  CrowdPlan plan;
  plan.people = people;
  const CrowdArea area = CrowdAreaOf(*scene);
  plan.from = area.from, plan.to = area.to;
  plan.speed_mps = scene->crowd.speed_mps;
  plan.speed_spread_mps = scene->crowd.speed_spread_mps;
  plan.pause_s = scene->crowd.pause_s;
  plan.distance_m = scene->crowd.distance_m;
  plan.duration_s = scene->duration_s();
  plan.limits = {.acceleration_mps2 = 0.9,
                 .lateral_acceleration_mps2 = 1.2,
                 .turn_rate_rad_s = 110 * kDegree,
                 .turn_acceleration_rad_s2 = 250 * kDegree,
                 .turns_on_the_spot = true};
  for (const Obstacle& obstacle : ObstaclesOf(*scene)) {
    plan.blocks.push_back({obstacle.center, obstacle.half, obstacle.heading_rad});
  }
  plan.intruders = IntrudersOf(*scene);
  std::vector<RoutePlan> routes;
  try {
    routes = WalkCrowd(plan, seed);
  } catch (const std::invalid_argument& error) {
    throw CrowdError(error.what());
  }
  for (std::size_t i = 0; i < routes.size(); ++i) {
    PersonSpec person;
    person.mark = person.model_mark = person.route.mark = scene->crowd.mark;
    person.place = 1000 + i;
    person.name = fmt::format("crowd_{}", i + 1);
    person.crowd = static_cast<int>(i) + 1;
    person.natural = true;
    person.route.plan = std::move(routes[i]);
    person.route.limits = plan.limits;
    scene->people.push_back(std::move(person));
  }
}

}  // namespace aisle::sim
