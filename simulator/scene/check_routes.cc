#include "simulator/scene/check_routes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "simulator/scene/crowd.h"
#include "simulator/scene/footprint.h"
#include "simulator/scene/hall.h"
#include "simulator/scene/obstacles.h"
#include "simulator/scene/rig_path.h"
#include "simulator/scene/vary.h"

namespace aisle::sim {
namespace {

constexpr double kVehicleHalfWidth_m = 0.5;  // of any, for keeping clear of what stands

/// Somebody under way.
struct Walker {
  const RouteSpec* route = nullptr;
  std::function<RouteState(double time_s)> at;
  Footprint footprint;
  std::string key, name;
  std::string train;  ///< who tows or pushes it, or its own name
};

std::string KeyOf(const PersonSpec& person) {
  return person.crowd > 0 ? "crowd" : fmt::format("people[{}]", person.place);
}
std::string KeyOf(const VehicleSpec& vehicle) { return fmt::format("vehicles[{}]", vehicle.place); }

const std::string& TrainOf(const VehicleSpec& vehicle) {
  if (!vehicle.pushed_by.empty()) return vehicle.pushed_by;
  return vehicle.towed_by.empty() ? vehicle.name : vehicle.towed_by;
}

/// Whether the steps of its plan are its own: not its tractor's, nor a crowd's.
bool HasStep(const RouteSpec& route, int step) {
  return step >= 0 && static_cast<std::size_t>(step) < route.marks.size();
}

/// The line to blame for what a step does, or for the whole where the step is not its own.
Mark MarkOf(const RouteSpec& route, int step) {
  return HasStep(route, step) ? route.marks[static_cast<std::size_t>(step)].step : route.mark;
}

/// The line to blame for where a mover is.
Mark MarkOf(const RouteSpec& route, const RouteState& state) { return MarkOf(route, state.step); }

Eigen::Vector2d Ahead(const RouteState& state, double ahead_m) {
  return state.position +
         ahead_m * Eigen::Vector2d(std::cos(state.heading_rad), std::sin(state.heading_rad));
}

/// Where somebody is who moves as recorded.
std::function<RouteState(double)> AlongWay(const PersonSpec& person, const FloorWay& way) {
  return [way, start_s = person.route.plan.start_s](double time_s) {
    RouteState state;
    state.position = way.At(time_s - start_s);
    return state;
  };
}

/// Looks at the routes of one scene; `seeded` says which seed's they are, "" as written.
class RouteChecker {
 public:
  RouteChecker(const Scene& scene, std::string seeded, Issues* issues, const FloorWays& ways)
      : scene_(Coupled(scene)),
        seeded_(std::move(seeded)),
        issues_(issues),
        ways_(ways),
        obstacles_(ObstaclesOf(scene_)) {}

  void Run() {
    CheckRoute(scene_.rig.route, "rig", kRigHalfWidth_m);
    if (issues_->empty()) CheckBends();
    for (const PersonSpec& person : scene_.people) {
      CheckRoute(person.route, KeyOf(person), kPersonHalfWidth_m);
      CheckRecorded(person);
    }
    for (const VehicleSpec& vehicle : scene_.vehicles) {
      if (!vehicle.pushed_by.empty()) continue;
      CheckRoute(vehicle.route, KeyOf(vehicle), kVehicleHalfWidth_m);
    }
    if (issues_->empty()) CheckPushed();
    if (issues_->empty()) CheckMeetings();
  }

 private:
  /// Where a mover runs into what stands.
  struct Hit {
    double time_s = 0;
    RouteState state;
    Eigen::Vector2d place;
    std::string what;

    std::string Place() const { return fmt::format("at [{:.2f}, {:.2f}]", place.x(), place.y()); }
  };

  /// Each step does one thing, can be driven, and keeps clear of what stands.
  void CheckRoute(const RouteSpec& route, const std::string& key, double radius) {
    bool sound = true;
    for (std::size_t i = 0; i < route.plan.steps.size(); ++i) {
      const RouteStep& step = route.plan.steps[i];
      const int kinds =
          (step.go.empty() ? 0 : 1) + step.wait_s.has_value() + step.turn_to_rad.has_value();
      if (kinds != 1) {
        if (!HasStep(route, static_cast<int>(i))) return;  // said where it is written
        issues_->Add(
            route.marks[i].step, fmt::format("{}.steps[{}]", key, i),
            "expected one of go, wait_s and turn_to_deg; example: {go: [[5, 0]], speed_mps: 0.9}");
        sound = false;
      }
    }
    if (!sound) return;
    try {
      CheckClearance(Route(route.plan, route.limits), route, key, radius);
    } catch (const RouteError& error) {
      issues_->Add(
          MarkOf(route, error.step()),
          HasStep(route, error.step()) ? fmt::format("{}.steps[{}]", key, error.step()) : key,
          seeded_ + error.what());
    }
  }

  /// No bend of the rig's route is tighter than a steered wheel can follow.
  void CheckBends() {
    const RouteSpec& route = scene_.rig.route;
    if (!scene_.drive.there || route.limits.turns_on_the_spot) return;
    const double tightest = std::tan(scene_.drive.max_steering_rad) / scene_.drive.wheelbase_m;
    constexpr double kStep_s = 0.05, kRounding = 1e-6;
    const Route way(route.plan, route.limits);
    for (double t = 0; t <= way.duration_s(); t += kStep_s) {
      const RouteState state = way.At(t);
      if (std::abs(state.curvature_per_m) <= tightest + kRounding) continue;
      issues_->Add(
          MarkOf(route, state), fmt::format("rig.steps[{}]", state.step),
          fmt::format("{}it bends with a radius of {:.2g} m, but this vehicle's smallest is {:.2g} "
                      "m (drive.max_steering_deg, drive.wheelbase_m); use a larger corner_radius_m",
                      seeded_, 1 / std::abs(state.curvature_per_m), 1 / tightest));
      return;
    }
  }

  void CheckClearance(const Route& way, const RouteSpec& route, const std::string& key,
                      double radius) {
    const auto at = [&](double time_s) { return way.At(time_s); };
    const std::optional<Hit> hit = FirstHit(at, way.duration_s(), {0}, radius);
    if (!hit) return;
    const int step = hit->time_s > 0 ? hit->state.step : -1;
    std::string where = key;
    if (HasStep(route, step)) where += fmt::format(".steps[{}]", step);
    if (step < 0) where += ".start";
    issues_->Add(MarkOf(route, step), where,
                 fmt::format("{}{} it {}", seeded_, hit->Place(), hit->what));
  }

  /// Who moves as recorded keeps clear of what stands, too.
  void CheckRecorded(const PersonSpec& person) {
    const auto way = ways_.find(person.name);
    if (way == ways_.end()) return;
    const double end_s =
        std::min(scene_.duration_s(), person.route.plan.start_s + way->second.duration_s());
    const std::optional<Hit> hit =
        FirstHit(AlongWay(person, way->second), end_s, {0}, kPersonHalfWidth_m);
    if (!hit) return;
    issues_->Add(
        person.capture.bvh.mark, KeyOf(person) + ".bvh",
        fmt::format("{}{}, {:.2f} s, it {}", seeded_, hit->Place(), hit->time_s, hit->what));
  }

  /// So does what is pushed, ahead of who pushes it, all along its footprint.
  void CheckPushed() {
    for (const VehicleSpec& vehicle : scene_.vehicles) {
      if (vehicle.pushed_by.empty()) continue;
      const Footprint footprint = FootprintOf(vehicle.model);
      const Route way(vehicle.route.plan, vehicle.route.limits);
      const std::optional<Hit> hit =
          FirstHit([&](double time_s) { return way.At(time_s); }, way.duration_s(),
                   DiscsAlong(footprint, AheadOfPusher(vehicle.model)), footprint.radius_m);
      if (!hit) continue;
      const std::string when = hit->time_s > 0 && hit->state.step >= 0
                                   ? fmt::format("in steps[{}]", hit->state.step)
                                   : "at the start";
      issues_->Add(vehicle.mark, KeyOf(vehicle) + ".pushed_by",
                   fmt::format("{}{} it {}, {} of {}, which is behind it", seeded_, hit->Place(),
                               hit->what, when, vehicle.pushed_by));
    }
  }

  /// The first time at which one of the discs ahead of a mover touches what stands.
  std::optional<Hit> FirstHit(const std::function<RouteState(double)>& at, double end_s,
                              const std::vector<double>& ahead_m, double radius) const {
    constexpr double kStep_s = 0.05;
    for (double t = 0; t <= end_s + kStep_s; t += kStep_s) {
      const RouteState state = at(t);
      for (const double ahead : ahead_m) {
        const Eigen::Vector2d place = Ahead(state, ahead);
        std::string what = Blocking(place, radius);
        if (!what.empty()) return Hit{t, state, place, std::move(what)};
      }
    }
    return std::nullopt;
  }

  std::string Blocking(const Eigen::Vector2d& point, double radius) const {
    if (!InHall(scene_.hall, point, radius)) {
      return "runs into a wall or leaves " + HallText(scene_.hall);
    }
    for (const Obstacle& obstacle : obstacles_) {
      if (obstacle.DistanceTo(point) < radius) {
        return fmt::format("runs through {} (it needs {:g} m around it)", obstacle.name, radius);
      }
    }
    return "";
  }

  /// The rig and the actors never run into one another.
  void CheckMeetings() {
    const auto way_of = [](const RouteSpec& spec) {
      return [route = Route(spec.plan, spec.limits)](double time_s) { return route.At(time_s); };
    };
    std::vector<Walker> walkers = {
        {&scene_.rig.route, RigFloorOf(scene_), {0, 0, kRigHalfWidth_m}, "rig", "the rig", ""}};
    for (const PersonSpec& person : scene_.people) {
      const auto way = ways_.find(person.name);
      // Where a recorded motion goes is not known without the model it is laid on.
      if (way == ways_.end() && !person.capture.bvh.name.empty()) continue;
      walkers.push_back({&person.route,
                         way == ways_.end() ? way_of(person.route) : AlongWay(person, way->second),
                         {0, 0, kPersonHalfWidth_m},
                         KeyOf(person),
                         person.name,
                         person.name});
    }
    for (const VehicleSpec& vehicle : scene_.vehicles) {
      Footprint footprint = FootprintOf(vehicle.model);
      if (!vehicle.pushed_by.empty()) {
        footprint.back_m += AheadOfPusher(vehicle.model);
        footprint.front_m += AheadOfPusher(vehicle.model);
      }
      walkers.push_back({&vehicle.route, way_of(vehicle.route), footprint, KeyOf(vehicle),
                         vehicle.name, TrainOf(vehicle)});
    }
    for (std::size_t i = 0; i < walkers.size(); ++i) {
      for (std::size_t k = i + 1; k < walkers.size(); ++k) CheckMeeting(walkers[i], walkers[k]);
    }
  }

  void CheckMeeting(const Walker& one, const Walker& other) {
    if (one.train == other.train) return;  // coupled
    constexpr double kStep_s = 0.05;
    const double needed_m = one.footprint.radius_m + other.footprint.radius_m;
    for (double t = 0; t <= scene_.duration_s(); t += kStep_s) {
      const RouteState state = other.at(t);
      const double apart_m = Apart(one.footprint, one.at(t), other.footprint, state);
      if (apart_m >= needed_m) continue;
      issues_->Add(MarkOf(*other.route, state), other.key,
                   fmt::format("{}at {:.2f} s it is {:.2f} m from {}, middle to middle, but they "
                               "need {:g} m: let one of them wait or go round",
                               seeded_, t, apart_m, one.name, needed_m));
      return;
    }
  }

  Scene scene_;
  std::string seeded_;
  Issues* issues_;
  const FloorWays& ways_;
  std::vector<Obstacle> obstacles_;
};

/// Which of a scene's halls it is that a message is about, where there are several.
std::string InHallText(const Scene& scene, const Scene& seeded) {
  return scene.varied_halls.empty() ? "" : "in " + seeded.hall.use + " ";
}

}  // namespace

void CheckRoutesOfSeed(const Scene& scene, std::uint64_t seed, Issues* issues,
                       const FloorWays& ways) {
  try {
    const Scene seeded = Seeded(scene, seed);
    RouteChecker(seeded, InHallText(scene, seeded) + fmt::format("with seed {} ", seed), issues,
                 ways)
        .Run();
  } catch (const CrowdError& error) {
    issues->Add(scene.crowd.mark, "crowd", fmt::format("with seed {} {}", seed, error.what()));
  } catch (const RouteError& error) {
    // One that is not the crowd's was reported where it is written.
    if (issues->empty()) throw;
  }
}

void CheckRoutes(const Scene& scene, Issues* issues, const FloorWays& ways) {
  RouteChecker(scene, InHallText(scene, scene), issues, ways).Run();
  for (std::uint64_t seed = 1; seed <= kUsualSeeds && issues->empty(); ++seed) {
    CheckRoutesOfSeed(scene, seed, issues, ways);
  }
}

}  // namespace aisle::sim
