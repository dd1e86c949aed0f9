#include "simulator/scene/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "simulator/scene/check_beams.h"
#include "simulator/scene/check_loads.h"
#include "simulator/scene/check_mechanisms.h"
#include "simulator/scene/check_routes.h"
#include "simulator/scene/check_zones.h"
#include "simulator/scene/crowd.h"
#include "simulator/scene/hall.h"

namespace aisle::sim {
namespace {

// The largest warehouses have such a floor. Solving the light takes gigabytes beyond it, and hours
// beyond so many lamps: each is looked for from everywhere.
constexpr double kMostFloor_m2 = 250'000;
constexpr std::int64_t kMostLamps = 2'000;

/// Twice the signed area of a triangle, positive where it turns left.
double Turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// What is wrong with a vehicle's outline, or an empty string.
std::string FootprintError(const std::vector<Eigen::Vector2d>& corners) {
  const std::size_t n = corners.size();
  if (n < 3) return "an outline needs at least three corners";
  if (n > 64) return "an outline has at most 64 corners";
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % n];
    if ((a - b).norm() < 1e-3) return fmt::format("corners {} and the next coincide", i + 1);
    if (a.norm() > 20) return fmt::format("corner {} is more than 20 m from the axle", i + 1);
    for (std::size_t k = i + 2; k < n; ++k) {
      const Eigen::Vector2d &c = corners[k], &d = corners[(k + 1) % n];
      if ((k + 1) % n == i) continue;
      if (Turn(a, b, c) * Turn(a, b, d) <= 0 && Turn(c, d, a) * Turn(c, d, b) <= 0) {
        return fmt::format("its sides {} and {} cross", i + 1, k + 1);
      }
    }
  }
  return "";
}

class SceneChecker {
 public:
  SceneChecker(const Scene& scene, Issues* issues) : scene_(scene), issues_(issues) {}

  void Run() {
    if (!CheckHall()) return;  // all else is measured against it
    for (const DescribedCamera& one : DescribedCameras(scene_)) CheckLens(one);
    CheckShutter();
    CheckLights();
    CheckStanding();
    CheckNames(scene_.people, "people");
    CheckNames(scene_.vehicles, "vehicles");
    CheckNames(scene_.mechanisms, "mechanisms");
    CheckHandles();
    CheckMechanisms(scene_, issues_);
    CheckLoads(scene_, issues_);
    CheckBeams(scene_, issues_);
    CheckCrowd();
    CheckHitches();
    CheckDrive();
    CheckRoutes(scene_, issues_);
    if (issues_->empty()) CheckZones(scene_, issues_);
    for (std::size_t i = 0; i < scene_.vehicles.size(); ++i) CheckMast(scene_.vehicles[i], i);
    if (scene_.rig.mount.height_m >= scene_.hall.height_m) {
      issues_->Add(scene_.rig.mark, "rig.camera_height_m", "the camera is above the roof");
    }
    CheckPairs();
  }

 private:
  bool CheckHall() {
    const Eigen::Vector2d size = scene_.hall.to - scene_.hall.from;
    if (!(size.array() >= 2).all()) {
      issues_->Add(scene_.hall.mark, "hall",
                   "`to` must be at least 2 m beyond `from` in x and y; example: from: [-5, -8], "
                   "to: [20, 8]");
      return false;
    }
    if (size.prod() <= kMostFloor_m2) return true;
    issues_->Add(
        scene_.hall.mark, "hall",
        fmt::format("its floor of {:g} x {:g} m is {:.0f} m²; at most {:.0f} m² can be lit",
                    size.x(), size.y(), size.prod(), kMostFloor_m2));
    return false;
  }

  void CheckLens(const DescribedCamera& one) {
    const CameraSpec& camera = one.camera;
    const bool bent = std::ranges::any_of(camera.distortion_coefficients,
                                          [](double value) { return value != 0; });
    if (bent && camera.distortion == Distortion::kNone) {
      issues_->Add(camera.mark, one.key + ".distortion",
                   "distortion_coefficients without a distortion model; example: distortion: "
                   "radial-tangential");
    }
  }

  void CheckShutter() {
    const double frame_ms = 1000 / scene_.rate_hz;
    const double exposure_ms =
        scene_.sensor.auto_exposure ? scene_.sensor.auto_longest_ms : scene_.sensor.exposure_ms;
    if (exposure_ms + scene_.sensor.readout_ms > frame_ms) {
      issues_->Add(scene_.sensor.mark, "sensor",
                   fmt::format("the shutter is open for {:g} ms of exposure and {:g} ms of "
                               "readout, but frames are {:g} ms apart",
                               exposure_ms, scene_.sensor.readout_ms, frame_ms));
    }
  }

  void CheckPairs() {
    const RigSpec& rig = scene_.rig;
    std::set<std::string> names;
    for (std::size_t i = 0; i < rig.pairs.size(); ++i) {
      const PairSpec& pair = rig.pairs[i];
      const std::string key = fmt::format("rig.pairs[{}]", i);
      if (!pair.name.empty() && !names.insert(pair.name).second) {
        issues_->Add(pair.mark, key + ".name",
                     fmt::format("another pair is already named '{}'", pair.name));
      }
      if (pair.mount.height_m >= scene_.hall.height_m) {
        issues_->Add(pair.mark, key + ".camera_height_m", "the camera is above the roof");
      }
    }
    if (rig.pair.empty() || names.contains(rig.pair)) return;
    issues_->Add(rig.pair_mark, "rig.pair",
                 fmt::format("no pair named '{}' among rig.pairs", rig.pair));
  }

  /// All grids together; the first one too many is told.
  void CheckLampCount() {
    std::int64_t lamps = 0;
    for (std::size_t i = 0; i < scene_.lights.size(); ++i) {
      const LightsSpec& lights = scene_.lights[i];
      lamps += std::int64_t{lights.rows} * lights.per_row;
      if (lamps <= kMostLamps) continue;
      return issues_->Add(lights.mark, fmt::format("lights[{}]", i),
                          fmt::format("with this grid there are {} lamps; a scene has at most {}: "
                                      "use fewer `rows` and `per_row`, of a larger `size_m`",
                                      lamps, kMostLamps));
    }
  }

  void CheckLights() {
    CheckLampCount();
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
        if (corner && !InHall(scene_.hall, *corner, 0)) {
          issues_->Add(lights.mark, key,
                       "the lit rectangle extends beyond " + HallText(scene_.hall));
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
    if (!InHall(scene_.hall, point, 0)) {
      issues_->Add(
          mark, key,
          fmt::format("[{:g}, {:g}] is outside {}", point.x(), point.y(), HallText(scene_.hall)));
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
      if (prop.above_m >= scene_.hall.height_m) {
        issues_->Add(
            prop.mark, fmt::format("props[{}].above_m", i),
            fmt::format("{:g} m is above the roof at {:g} m", prop.above_m, scene_.hall.height_m));
      }
    }
    for (std::size_t i = 0; i < scene_.doors.size(); ++i) CheckDoor(i);
    for (std::size_t i = 0; i < scene_.mezzanines.size(); ++i) CheckMezzanine(i);
    for (std::size_t i = 0; i < scene_.fixtures.size(); ++i) {
      CheckInside(scene_.fixtures[i].mark, fmt::format("fixtures[{}].at", i),
                  scene_.fixtures[i].at);
    }
    for (std::size_t i = 0; i < scene_.views.size(); ++i) {
      const ViewSpec& view = scene_.views[i];
      const std::string key = fmt::format("views[{}]", i);
      CheckInside(view.mark, key + ".at", view.at);
      if (view.height_m >= scene_.hall.height_m) {
        issues_->Add(view.mark, key + ".height_m", "the camera is above the roof");
      }
    }
  }

  /// The opening is in its wall.
  void CheckDoor(std::size_t index) {
    const DoorSpec& door = scene_.doors[index];
    const HallSpec& hall = scene_.hall;
    const int along = door.wall == WallSide::kNorth || door.wall == WallSide::kSouth ? 0 : 1;
    const double from = door.at_m - door.width_m / 2, to = door.at_m + door.width_m / 2;
    constexpr double kRounding_m = 1e-9;
    if (from < hall.from[along] - kRounding_m || to > hall.to[along] + kRounding_m) {
      issues_->Add(
          door.mark, fmt::format("doors[{}].at_m", index),
          fmt::format(
              "its opening goes from {0} {1:g} to {2:g} m, but its wall goes from {3:g} to {4:g}",
              along == 0 ? 'x' : 'y', from, to, hall.from[along], hall.to[along]));
    }
    if (door.height_m > hall.height_m) {
      issues_->Add(door.mark, fmt::format("doors[{}].height_m", index),
                   fmt::format("its opening of {:g} m extends above the roof at {:g} m",
                               door.height_m, hall.height_m));
    }
  }

  void CheckMezzanine(std::size_t index) {
    const MezzanineSpec& mezzanine = scene_.mezzanines[index];
    const std::string key = fmt::format("mezzanines[{}]", index);
    CheckInside(mezzanine.mark, key + ".from", mezzanine.from);
    CheckInside(mezzanine.mark, key + ".to", mezzanine.to);
    if (((mezzanine.to - mezzanine.from).array() < 2).any()) {
      issues_->Add(
          mezzanine.mark, key,
          "`to` must be at least 2 m beyond `from` in x and y; example: from: [2, 3], to: [9, 6]");
    }
    if (mezzanine.height_m + 1.1 >= scene_.hall.height_m) {
      issues_->Add(mezzanine.mark, key + ".height_m", "its railing is above the roof");
    }
  }

  template <class Actor>
  void CheckNames(const std::vector<Actor>& actors, const std::string& list) {
    for (std::size_t i = 0; i < actors.size(); ++i) {
      const Actor& actor = actors[i];
      if (!actor.name.empty() && !names_.insert(actor.name).second) {
        issues_->Add(
            actor.mark, fmt::format("{}[{}].name", list, i),
            fmt::format("another actor is already named '{}'; names must be unique", actor.name));
      }
    }
  }

  /// Who is pushed has a pusher, and no steps of its own.
  void CheckHandles() {
    for (std::size_t i = 0; i < scene_.vehicles.size(); ++i) {
      const VehicleSpec& vehicle = scene_.vehicles[i];
      if (vehicle.pushed_by.empty()) continue;
      const std::string key = fmt::format("vehicles[{}].pushed_by", i);
      const auto pusher = std::ranges::find(scene_.people, vehicle.pushed_by, &PersonSpec::name);
      if (pusher == scene_.people.end()) {
        issues_->Add(vehicle.mark, key, fmt::format("no person named '{}'", vehicle.pushed_by));
      } else if (!pusher->capture.bvh.name.empty()) {
        issues_->Add(vehicle.mark, key,
                     fmt::format("'{}' moves with the motion of `bvh`, which cannot push anything; "
                                 "name a person with `steps`",
                                 vehicle.pushed_by));
      } else if (!vehicle.route.plan.steps.empty()) {
        issues_->Add(vehicle.mark, key, "it moves with the person who pushes it; remove `steps`");
      } else if (pusher->level > vehicle.level) {
        issues_->Add(vehicle.mark, key,
                     "its level must be that of the person who pushes it, or higher");
      }
    }
  }

  void CheckCrowd() {
    const CrowdSpec& crowd = scene_.crowd;
    if (crowd.people == 0) return;
    if (crowd.in && crowd.between_racks) {
      issues_->Add(crowd.mark, "crowd", "`in` and `between_racks` both give the area; keep one");
    }
    if (crowd.between_racks) {
      for (const int rack : *crowd.between_racks) {
        if (rack < static_cast<int>(scene_.racks.size())) continue;
        issues_->Add(crowd.mark, "crowd.between_racks",
                     fmt::format("racks[{}] does not exist; there are {}, counted from 0", rack,
                                 scene_.racks.size()));
        return;
      }
      if (crowd.between_racks->front() == crowd.between_racks->back()) {
        issues_->Add(crowd.mark, "crowd.between_racks",
                     "an aisle lies between two different rows; example: between_racks: [0, 1]");
        return;
      }
    }
    const CrowdArea area = CrowdAreaOf(scene_);
    CheckInside(crowd.mark, "crowd.in", area.from);
    CheckInside(crowd.mark, "crowd.in", area.to);
  }

  /// Who is towed has a vehicle before it that drives, and no steps of its own.
  void CheckHitches() {
    for (std::size_t i = 0; i < scene_.vehicles.size(); ++i) {
      const VehicleSpec& vehicle = scene_.vehicles[i];
      const std::string key = fmt::format("vehicles[{}].towed_by", i);
      if (vehicle.towed_by.empty()) continue;
      const auto tractor = std::ranges::find(scene_.vehicles, vehicle.towed_by, &VehicleSpec::name);
      if (tractor == scene_.vehicles.end()) {
        issues_->Add(vehicle.mark, key, fmt::format("no vehicle named '{}'", vehicle.towed_by));
      } else if (!tractor->towed_by.empty() || !tractor->pushed_by.empty()) {
        issues_->Add(vehicle.mark, key,
                     "it must drive itself: every trailer of a train names the tractor, and "
                     "`behind_m` gives its distance behind it");
      } else if (!vehicle.route.plan.steps.empty() || !vehicle.pushed_by.empty()) {
        issues_->Add(vehicle.mark, key,
                     "it moves with its tractor; remove `steps` and `pushed_by`");
      } else if (vehicle.behind_m <= 0) {
        issues_->Add(vehicle.mark, key,
                     "`towed_by` requires `behind_m` greater than 0; for the first trailer of "
                     "tow_tractor: 1.78");
      } else if (tractor->level > vehicle.level) {
        issues_->Add(vehicle.mark, key, "its level must be that of its tractor, or higher");
      }
    }
  }

  void CheckDrive() {
    const DriveSpec& drive = scene_.drive;
    if (!drive.there) return;
    if (const std::string wrong = FootprintError(drive.footprint); !wrong.empty()) {
      issues_->Add(drive.mark, "drive.footprint_m",
                   wrong + "; example: [[-0.3, -0.3], [0.7, -0.3], [0.7, 0.3], [-0.3, 0.3]]");
    }
    for (std::size_t i = 0; i < drive.zones.size(); ++i) {
      const ZoneSpec& zone = drive.zones[i];
      CheckInside(zone.mark, fmt::format("drive.zones[{}].from", i), zone.from);
      CheckInside(zone.mark, fmt::format("drive.zones[{}].to", i), zone.to);
    }
    const bool drives = std::ranges::any_of(scene_.rig.route.plan.steps,
                                            [](const RouteStep& step) { return !step.go.empty(); });
    if (!drives) {
      issues_->Add(drive.mark, "drive",
                   "the rig's route does not move: a closed drive needs a `go` among rig.steps");
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
  std::set<std::string> names_;
};

}  // namespace

void CheckScene(const Scene& scene, Issues* issues) { SceneChecker(scene, issues).Run(); }

}  // namespace aisle::sim
