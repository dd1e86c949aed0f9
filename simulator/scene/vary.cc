#include "simulator/scene/vary.h"

#include <algorithm>

#include "simulator/scene/crowd.h"
#include "simulator/scene/dice.h"

namespace aisle::sim {
namespace {

RouteSpec Varied(RouteSpec route, const VarySpec& vary, Dice dice) {
  RoutePlan& plan = route.plan;
  plan.start_s = std::max(0.0, plan.start_s + vary.time_s * dice.Signed());
  const double faster = 1 + vary.speed * dice.Signed();
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    plan.steps[i].speed_mps *= faster;
    for (std::size_t k = 0; k < plan.steps[i].go.size(); ++k) {
      const bool is_end = i + 1 == plan.steps.size() && k + 1 == plan.steps[i].go.size();
      const double y = vary.path_m * dice.Signed(), x = vary.path_m * dice.Signed();
      if (!is_end) plan.steps[i].go[k] += Eigen::Vector2d(x, y);
    }
  }
  return route;
}

}  // namespace

Scene Coupled(Scene scene) {
  for (VehicleSpec& vehicle : scene.vehicles) {
    const auto pusher = std::ranges::find(scene.people, vehicle.pushed_by, &PersonSpec::name);
    if (!vehicle.pushed_by.empty() && pusher != scene.people.end()) {
      vehicle.route.plan = pusher->route.plan;
      vehicle.route.limits = pusher->route.limits;
    }
    const auto tractor = std::ranges::find(scene.vehicles, vehicle.towed_by, &VehicleSpec::name);
    if (vehicle.towed_by.empty() || tractor == scene.vehicles.end()) continue;
    vehicle.route.plan = tractor->route.plan;
    vehicle.route.plan.behind_m = vehicle.behind_m;
    vehicle.route.limits = tractor->route.limits;
  }
  return scene;
}

Scene Seeded(Scene scene, std::uint64_t seed) {
  if (!scene.dealt.empty()) {
    static_cast<Premises&>(scene) =
        scene.dealt[(seed + scene.dealt.size() - 1) % scene.dealt.size()];
    scene.dealt.clear();
  }
  for (PersonSpec& person : scene.people) {
    person.route = Varied(person.route, person.vary, Dice(seed, {400, person.place}));
  }
  for (VehicleSpec& vehicle : scene.vehicles) {
    vehicle.route = Varied(vehicle.route, vehicle.vary, Dice(seed, {410, vehicle.place}));
  }
  scene = Coupled(std::move(scene));
  AddCrowd(seed, &scene);  // last: it goes round all the others
  return scene;
}

Scene WithLooks(Scene scene, std::uint64_t seed, const std::vector<std::string>& models) {
  std::vector<std::string> circle = models;
  for (const PersonSpec& person : scene.people) {
    if (!person.vary.look) std::erase(circle, person.model);
  }
  for (PersonSpec& person : scene.people) {
    if (person.crowd > 0 && !models.empty()) {
      person.model = models[(static_cast<std::size_t>(person.crowd) + 3 * seed) % models.size()];
      continue;
    }
    const auto own = std::ranges::find(circle, person.model);
    if (!person.vary.look || own == circle.end()) continue;
    const auto place = static_cast<std::uint64_t>(own - circle.begin());
    person.model = circle[(place + seed - 1) % circle.size()];
  }
  return scene;
}

}  // namespace aisle::sim
