#include "simulator/scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace aisle::sim {
namespace {

// Half widths of the movers, for keeping clear of what stands.
constexpr double kPersonRadius_m = 0.22;
constexpr double kVehicleRadius_m = 0.5;
constexpr double kRigRadius_m = 0.3;

/// A rectangle on the floor that nobody can pass.
struct Obstacle {
  std::string name;
  Eigen::Vector2d center;
  Eigen::Vector2d half;
  double heading_rad = 0;

  double DistanceTo(const Eigen::Vector2d& point) const {
    const Eigen::Vector2d local = Eigen::Rotation2Dd(-heading_rad) * (point - center);
    return (local.cwiseAbs() - half).cwiseMax(0).norm();
  }
};

std::vector<Obstacle> ObstaclesOf(const Scene& scene) {
  std::vector<Obstacle> obstacles;
  for (std::size_t i = 0; i < scene.racks.size(); ++i) {
    const RackSpec& rack = scene.racks[i];
    const double length = rack.bays * rack.bay_m;
    const Eigen::Vector2d along(std::cos(rack.heading_rad), std::sin(rack.heading_rad));
    obstacles.push_back({fmt::format("racks[{}]", i),
                         rack.from + along * length / 2,
                         {length / 2, rack.depth_m / 2},
                         rack.heading_rad});
  }
  for (std::size_t i = 0; i < scene.stacks.size(); ++i) {
    const StackSpec& stack = scene.stacks[i];
    obstacles.push_back({fmt::format("stacks[{}]", i), stack.at, {0.6, 0.4}, stack.heading_rad});
  }
  for (std::size_t i = 0; i < scene.columns.size(); ++i) {
    const ColumnSpec& column = scene.columns[i];
    const double half = column.size_m / 2;
    obstacles.push_back({fmt::format("columns[{}]", i), column.at, {half, half}, 0});
  }
  return obstacles;
}

class Checker {
 public:
  Checker(const Scene& scene, Issues* issues)
      : scene_(scene), issues_(issues), obstacles_(ObstaclesOf(scene)) {}

  void Run() {
    if (!CheckHall()) return;  // all else is measured against it
    CheckCamera();
    CheckLights();
    CheckStanding();
    CheckRoute(scene_.rig.route, "rig", kRigRadius_m);
    CheckActors(scene_.people, "people", kPersonRadius_m);
    CheckActors(scene_.vehicles, "vehicles", kVehicleRadius_m);
    CheckHandles();
    if (issues_->empty()) CheckMeetings();
    for (std::size_t i = 0; i < scene_.vehicles.size(); ++i) CheckMast(scene_.vehicles[i], i);
    if (scene_.rig.mount.height_m >= scene_.hall.height_m) {
      issues_->Add(scene_.rig.mark, "rig.camera_height_m", "the camera is above the roof");
    }
  }

 private:
  bool InHall(const Eigen::Vector2d& point, double margin) const {
    const Eigen::Array2d inside =
        (point - scene_.hall.from).array().min((scene_.hall.to - point).array());
    return inside.minCoeff() >= margin;
  }

  std::string HallText() const {
    return fmt::format("the hall, x {:g} to {:g} and y {:g} to {:g}", scene_.hall.from.x(),
                       scene_.hall.to.x(), scene_.hall.from.y(), scene_.hall.to.y());
  }

  bool CheckHall() {
    if (((scene_.hall.to - scene_.hall.from).array() >= 2).all()) return true;
    issues_->Add(scene_.hall.mark, "hall",
                 "`to` must lie at least 2 m beyond `from` in x and y; example: from: [-5, -8], "
                 "to: [20, 8]");
    return false;
  }

  void CheckCamera() {
    const CameraSpec& camera = scene_.camera;
    const bool bent = std::ranges::any_of(camera.distortion_coefficients,
                                          [](double value) { return value != 0; });
    if (bent && camera.distortion == Distortion::kNone) {
      issues_->Add(camera.mark, "camera.distortion",
                   "there are distortion_coefficients, but nothing says of which model; example: "
                   "distortion: radial-tangential");
    }
    const double frame_ms = 1000 / scene_.rate_hz;
    const double exposure_ms =
        scene_.sensor.auto_exposure ? scene_.sensor.auto_longest_ms : scene_.sensor.exposure_ms;
    if (exposure_ms + scene_.sensor.readout_ms > frame_ms) {
      issues_->Add(
          scene_.sensor.mark, "sensor",
          fmt::format("the shutter is open for {:g} ms of exposure and {:g} ms of readout, "
                      "but a frame comes every {:g} ms",
                      exposure_ms, scene_.sensor.readout_ms, frame_ms));
    }
  }

  void CheckLights() {
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const LightsSpec& lights = scene_.lights[i];
      const std::string key = fmt::format("lights[{}]", i);
      if (lights.height_m >= scene_.hall.height_m) {
        issues_->Add(lights.mark, key + ".height_m",
                     fmt::format("the lamps hang at {:g} m, above the roof at {:g} m",
                                 lights.height_m, scene_.hall.height_m));
      }
      if (lights.from.has_value() != lights.to.has_value()) {
        issues_->Add(lights.mark, key, "`from` and `to` go together; give both or neither");
      }
      for (const auto& corner : {lights.from, lights.to}) {
        if (corner && !InHall(*corner, 0)) {
          issues_->Add(lights.mark, key, "the lit rectangle leaves " + HallText());
        }
      }
      for (const Blackout& off : lights.off) {
        if (off.to_s <= off.from_s) {
          issues_->Add(lights.mark, key + ".off", "`to_s` must be later than `from_s`");
        }
      }
    }
  }

  void CheckInside(Mark mark, const std::string& key, const Eigen::Vector2d& point) {
    if (!InHall(point, 0)) {
      issues_->Add(mark, key,
                   fmt::format("[{:g}, {:g}] is outside {}", point.x(), point.y(), HallText()));
    }
  }

  void CheckStanding() {
    for (std::size_t i = 0; i < scene_.racks.size(); ++i) {
      const RackSpec& rack = scene_.racks[i];
      const Eigen::Vector2d along(std::cos(rack.heading_rad), std::sin(rack.heading_rad));
      const std::string key = fmt::format("racks[{}]", i);
      CheckInside(rack.mark, key + ".from", rack.from);
      CheckInside(rack.mark, key + " (its far end)", rack.from + along * rack.bays * rack.bay_m);
    }
    for (std::size_t i = 0; i < scene_.stacks.size(); ++i) {
      CheckInside(scene_.stacks[i].mark, fmt::format("stacks[{}].at", i), scene_.stacks[i].at);
    }
    for (std::size_t i = 0; i < scene_.columns.size(); ++i) {
      CheckInside(scene_.columns[i].mark, fmt::format("columns[{}].at", i), scene_.columns[i].at);
    }
    for (std::size_t i = 0; i < scene_.props.size(); ++i) {
      const PropSpec& prop = scene_.props[i];
      CheckInside(prop.mark, fmt::format("props[{}].at", i), prop.at);
      if (prop.to) CheckInside(prop.mark, fmt::format("props[{}].to", i), *prop.to);
    }
    for (std::size_t i = 0; i < scene_.mezzanines.size(); ++i) CheckMezzanine(i);
  }

  void CheckMezzanine(std::size_t index) {
    const MezzanineSpec& mezzanine = scene_.mezzanines[index];
    const std::string key = fmt::format("mezzanines[{}]", index);
    CheckInside(mezzanine.mark, key + ".from", mezzanine.from);
    CheckInside(mezzanine.mark, key + ".to", mezzanine.to);
    if (((mezzanine.to - mezzanine.from).array() < 2).any()) {
      issues_->Add(mezzanine.mark, key,
                   "`to` must lie at least 2 m beyond `from` in x and y; example: from: [2, 3], "
                   "to: [9, 6]");
    }
    if (mezzanine.height_m + 1.1 >= scene_.hall.height_m) {
      issues_->Add(mezzanine.mark, key + ".height_m", "its railing is above the roof");
    }
  }

  template <class Actor>
  void CheckActors(const std::vector<Actor>& actors, const std::string& list, double radius) {
    for (std::size_t i = 0; i < actors.size(); ++i) {
      const Actor& actor = actors[i];
      const std::string key = fmt::format("{}[{}]", list, i);
      if (!actor.name.empty() && !names_.insert(actor.name).second) {
        issues_->Add(actor.mark, key + ".name",
                     fmt::format("'{}' is taken by another actor; names are unique", actor.name));
      }
      CheckRoute(actor.route, key, radius);
    }
  }

  /// Each step does one thing, can be driven, and keeps clear of what stands.
  void CheckRoute(const RouteSpec& route, const std::string& key, double radius) {
    bool sound = true;
    for (std::size_t i = 0; i < route.plan.steps.size(); ++i) {
      const RouteStep& step = route.plan.steps[i];
      const int kinds =
          (step.go.empty() ? 0 : 1) + step.wait_s.has_value() + step.turn_to_rad.has_value();
      if (kinds != 1) {
        issues_->Add(route.marks[i].step, fmt::format("{}.steps[{}]", key, i),
                     "a step is one of go, wait_s and turn_to_deg; example: {go: [[5, 0]], "
                     "speed_mps: 0.9}");
        sound = false;
      }
    }
    if (!sound) return;
    try {
      CheckClearance(Route(route.plan, route.limits), route, key, radius);
    } catch (const RouteError& error) {
      const bool known = error.step() >= 0;
      issues_->Add(known ? route.marks[static_cast<std::size_t>(error.step())].step : route.mark,
                   known ? fmt::format("{}.steps[{}]", key, error.step()) : key, error.what());
    }
  }

  void CheckClearance(const Route& way, const RouteSpec& route, const std::string& key,
                      double radius) {
    constexpr double kStep_s = 0.05;
    for (double t = 0; t <= way.duration_s() + kStep_s; t += kStep_s) {
      const RouteState state = way.At(t);
      const std::string hit = Blocking(state.position, radius);
      if (hit.empty()) continue;
      const bool moving = state.step >= 0 && t > 0;
      issues_->Add(
          moving ? route.marks[static_cast<std::size_t>(state.step)].step : route.mark,
          moving ? fmt::format("{}.steps[{}]", key, state.step) : key + ".start",
          fmt::format("at [{:.2f}, {:.2f}] it {}", state.position.x(), state.position.y(), hit));
      return;  // the first place is enough
    }
  }

  std::string Blocking(const Eigen::Vector2d& point, double radius) const {
    if (!InHall(point, radius)) return "runs into a wall or leaves " + HallText();
    for (const Obstacle& obstacle : obstacles_) {
      if (obstacle.DistanceTo(point) < radius) {
        return fmt::format("runs through {} (it needs {:g} m around it)", obstacle.name, radius);
      }
    }
    return "";
  }

  /// Who is pushed has a pusher, and no steps of its own.
  void CheckHandles() {
    for (std::size_t i = 0; i < scene_.vehicles.size(); ++i) {
      const VehicleSpec& vehicle = scene_.vehicles[i];
      if (vehicle.pushed_by.empty()) continue;
      const std::string key = fmt::format("vehicles[{}].pushed_by", i);
      const auto pusher = std::ranges::find(scene_.people, vehicle.pushed_by, &PersonSpec::name);
      if (pusher == scene_.people.end()) {
        issues_->Add(vehicle.mark, key,
                     fmt::format("there is nobody '{}' among the people", vehicle.pushed_by));
      } else if (!vehicle.route.plan.steps.empty()) {
        issues_->Add(vehicle.mark, key, "it goes where its pusher goes; leave out `steps`");
      } else if (pusher->level > vehicle.level) {
        issues_->Add(vehicle.mark, key, "its level must be that of its pusher or above");
      }
    }
  }

  /// The rig and the actors, as written, never run into one another.
  void CheckMeetings() {
    const Route rig(scene_.rig.route.plan, scene_.rig.route.limits);
    for (std::size_t i = 0; i < scene_.people.size(); ++i) {
      CheckMeeting(rig, scene_.people[i], fmt::format("people[{}]", i), kPersonRadius_m);
    }
    for (std::size_t i = 0; i < scene_.vehicles.size(); ++i) {
      if (!scene_.vehicles[i].pushed_by.empty()) continue;
      CheckMeeting(rig, scene_.vehicles[i], fmt::format("vehicles[{}]", i), kVehicleRadius_m);
    }
  }

  template <class Actor>
  void CheckMeeting(const Route& rig, const Actor& actor, const std::string& key, double radius) {
    constexpr double kStep_s = 0.05;
    const Route way(actor.route.plan, actor.route.limits);
    for (double t = 0; t <= scene_.duration_s(); t += kStep_s) {
      const RouteState state = way.At(t);
      const double apart = (state.position - rig.At(t).position).norm();
      if (apart >= radius + kRigRadius_m) continue;
      const bool moving = state.step >= 0 && !actor.route.marks.empty();
      issues_->Add(
          moving ? actor.route.marks[static_cast<std::size_t>(state.step)].step : actor.route.mark,
          key,
          fmt::format("at {:.2f} s it is {:.2f} m from the rig's middle, which needs "
                      "{:g} m: let one of them wait or go round",
                      t, apart, radius + kRigRadius_m));
      return;
    }
  }

  void CheckMast(const VehicleSpec& vehicle, std::size_t index) {
    try {
      MastLift(vehicle.mast, kMastSpeed_mps, kMastAcceleration_mps2);
    } catch (const std::invalid_argument& error) {
      issues_->Add(vehicle.mark, fmt::format("vehicles[{}].mast", index), error.what());
    }
  }

  const Scene& scene_;
  Issues* issues_;
  std::vector<Obstacle> obstacles_;
  std::set<std::string> names_;
};

}  // namespace

void CheckScene(const Scene& scene, Issues* issues) { Checker(scene, issues).Run(); }

}  // namespace aisle::sim
