#include "simulator/world/ground.h"

#include <algorithm>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "simulator/scene/footprint.h"

namespace aisle::sim {
namespace {

constexpr double kSpacing_m = 0.02;  // of the way's points
constexpr float kFloor_m = 0.03f;    // what lies lower can be driven over
constexpr float kNear_m = 0.05f;     // parts nearer than this are one thing

std::vector<WayPoint> PointsOf(const Route::Leg& leg, const RoutePlan& plan,
                               const RouteLimits& limits) {
  std::vector<WayPoint> points;
  const auto& segments = leg.path.segments();
  const double length = leg.path.length_m();
  const int steps = std::max(1, static_cast<int>(std::ceil(length / kSpacing_m)));
  for (int k = 0; k <= steps; ++k) {
    const double at = length * k / steps;
    const PathPoint point = leg.path.At(at);
    std::size_t segment = 0;
    while (segment + 1 < segments.size() && segments[segment + 1].start_m <= at) ++segment;
    const auto step = static_cast<std::size_t>(leg.segment_steps[segment].step);
    const double bend = std::max(std::abs(point.curvature_per_m), 1e-9);
    points.push_back(
        {.distance_m = at,
         .position = point.position,
         .heading_rad = point.heading_rad,
         .curvature_per_m = point.curvature_per_m,
         .speed_mps = std::min(
             {plan.steps[step].speed_mps, std::sqrt(limits.lateral_acceleration_mps2 / bend),
              limits.turn_rate_rad_s / bend, leg.segment_steps[segment].followed_mps})});
  }
  return points;
}

std::vector<WayLeg> WayOf(const RouteSpec& route) {
  std::vector<WayLeg> way;
  const Route driven(route.plan, route.limits);
  for (const Route::Leg& leg : driven.legs()) {
    WayLeg next;
    next.duration_s = leg.duration_s;
    if (leg.turn_sign != 0) {
      next.kind = WayLeg::Kind::kTurn;
      next.turn_to_rad = leg.start.heading_rad + leg.turn_sign * leg.profile.length_m();
    } else if (leg.path.length_m() > 0) {
      next.kind = WayLeg::Kind::kDrive;
      next.reverse = leg.reverse;
      next.points = PointsOf(leg, route.plan, route.limits);
    }
    way.push_back(std::move(next));
  }
  return way;
}

/// The parts of a thing that are apart, by the boxes of their triangles: the columns of a platform
/// are several.
class Parts {
 public:
  explicit Parts(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t Of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::size_t a, std::size_t b) {
    parent_[std::max(Of(a), Of(b))] = std::min(Of(a), Of(b));
  }

 private:
  std::vector<std::size_t> parent_;
};

using Box = Eigen::AlignedBox2f;

/// Boxes that touch or nearly do belong together; numbered by the first of each part.
std::vector<std::size_t> PartsOf(const std::vector<Box>& boxes) {
  Parts parts(boxes.size());
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return boxes[i].min().x(); });
  for (std::size_t a = 0; a < order.size(); ++a) {
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      const Box &one = boxes[order[a]], &other = boxes[order[b]];
      if (other.min().x() > one.max().x() + kNear_m) break;
      const bool beside =
          other.min().y() > one.max().y() + kNear_m || one.min().y() > other.max().y() + kNear_m;
      if (!beside) parts.Join(order[a], order[b]);
    }
  }
  std::vector<std::size_t> part(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) part[i] = parts.Of(i);
  return part;
}

std::vector<Eigen::Vector2d> Outline(const std::vector<cv::Point2f>& points) {
  std::vector<cv::Point2f> hull;
  cv::convexHull(points, hull, false);  // image axes: clockwise there is counter-clockwise here
  std::vector<Eigen::Vector2d> outline;
  for (const cv::Point2f& point : hull) outline.emplace_back(point.x, point.y);
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()];
    area += a.x() * b.y() - b.x() * a.y();
  }
  if (area < 0) std::ranges::reverse(outline);
  return outline;
}

bool Stands(const Instance& instance) {
  return instance.object_class != ObjectClass::kFloor &&
         instance.object_class != ObjectClass::kWall &&
         instance.object_class != ObjectClass::kLuminaire;
}

/// The triangles of one instance that a vehicle of that height can touch, as parts.
void AddThing(const World& world, const std::vector<std::size_t>& triangles,
              const Instance& instance, std::vector<GroundThing>* things) {
  const TriangleMesh& mesh = world.statics().mesh;
  std::vector<Box> boxes;
  for (const std::size_t i : triangles) {
    Box box;
    for (const std::uint32_t corner : mesh.triangles[i]) {
      box.extend(mesh.positions[corner].head<2>());
    }
    boxes.push_back(box);
  }
  std::map<std::size_t, std::vector<cv::Point2f>> corners;
  const std::vector<std::size_t> parts = PartsOf(boxes);
  for (std::size_t k = 0; k < triangles.size(); ++k) {
    for (const std::uint32_t corner : mesh.triangles[triangles[k]]) {
      corners[parts[k]].emplace_back(mesh.positions[corner].x(), mesh.positions[corner].y());
    }
  }
  for (const auto& [part, points] : corners) {
    things->push_back(
        {instance.name, std::string(ClassName(instance.object_class)), Outline(points)});
  }
}

/// The four walls as the hall says, since their mesh is one thing around everything.
void AddWalls(const HallSpec& hall, std::vector<GroundThing>* things) {
  constexpr double kThick = 0.2;
  const Eigen::Vector2d &a = hall.from, &b = hall.to;
  const auto wall = [&](const char* name, double x0, double y0, double x1, double y1) {
    things->push_back({name, "wall", {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}});
  };
  wall("south wall", a.x(), a.y() - kThick, b.x(), a.y());
  wall("north wall", a.x(), b.y(), b.x(), b.y() + kThick);
  wall("west wall", a.x() - kThick, a.y(), a.x(), b.y());
  wall("east wall", b.x(), a.y(), b.x() + kThick, b.y());
}

std::vector<GroundThing> ThingsOf(const Scene& scene, const World& world) {
  const TriangleMesh& mesh = world.statics().mesh;
  const auto height = static_cast<float>(scene.drive.height_m);
  std::map<std::uint16_t, std::vector<std::size_t>> triangles;  // by instance
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!Stands(world.instances()[world.statics().instances[i]])) continue;
    const auto& [a, b, c] = mesh.triangles[i];
    const auto [low, high] =
        std::minmax({mesh.positions[a].z(), mesh.positions[b].z(), mesh.positions[c].z()});
    if (low < height && high > kFloor_m) {
      triangles[world.statics().instances[i]].push_back(i);
    }
  }
  std::vector<GroundThing> things;
  AddWalls(scene.hall, &things);
  for (const auto& [instance, its] : triangles) {
    AddThing(world, its, world.instances()[instance], &things);
  }
  return things;
}

/// Among the actors, people first: who pushes a vehicle, or tows it.
int MovedBy(const Scene& scene, const VehicleSpec& vehicle) {
  const auto pusher = std::ranges::find(scene.people, vehicle.pushed_by, &PersonSpec::name);
  if (!vehicle.pushed_by.empty() && pusher != scene.people.end()) {
    return static_cast<int>(pusher - scene.people.begin());
  }
  const auto tractor = std::ranges::find(scene.vehicles, vehicle.towed_by, &VehicleSpec::name);
  if (!vehicle.towed_by.empty() && tractor != scene.vehicles.end()) {
    return static_cast<int>(scene.people.size()) +
           static_cast<int>(tractor - scene.vehicles.begin());
  }
  return -1;
}

}  // namespace

Ground::Ground(const Scene& scene, const World& world)
    : start_{scene.rig.route.plan.start, scene.rig.route.plan.heading_rad},
      way_(WayOf(scene.rig.route)),
      frozen_(scene.frozen) {
  if (!scene.drive.there) return;
  things_ = ThingsOf(scene, world);
  for (const PersonSpec& person : scene.people) {
    actors_.push_back({.name = person.name,
                       .object_class = "person",
                       .back_m = 0,
                       .front_m = 0,
                       .radius_m = kPersonReach_m,
                       .yields = person.yields.yields,
                       .yields_within_m = person.yields.within_m});
    routes_.emplace_back(person.route.plan, person.route.limits);
  }
  for (const VehicleSpec& vehicle : scene.vehicles) {
    const Footprint footprint = FootprintOf(vehicle.model);
    actors_.push_back({.name = vehicle.name,
                       .object_class = "vehicle",
                       .back_m = footprint.back_m,
                       .front_m = footprint.front_m,
                       .radius_m = footprint.radius_m,
                       .yields = vehicle.yields.yields,
                       .yields_within_m = vehicle.yields.within_m,
                       .goes_with = MovedBy(scene, vehicle)});
    routes_.emplace_back(vehicle.route.plan, vehicle.route.limits);
  }
  const Snapshot first = world.At(0);
  for (std::size_t i = 0; i < routes_.size(); ++i) {
    const RouteState state = routes_[i].At(0);
    const Eigen::Vector2d ahead(std::cos(state.heading_rad), std::sin(state.heading_rad));
    const Eigen::Vector2d at = first.movers[i].T_world_object.translation().head<2>();
    ahead_m_.push_back(ahead.dot(at - state.position));
    actors_[i].object_class = ClassName(world.instances()[first.movers[i].instance].object_class);
  }
}

GroundPose Ground::ActorAt(std::size_t actor, std::int64_t time_ns) const {
  const RouteState state = routes_[actor].At(frozen_ ? 0 : 1e-9 * static_cast<double>(time_ns));
  const Eigen::Vector2d ahead(std::cos(state.heading_rad), std::sin(state.heading_rad));
  return {state.position + ahead_m_[actor] * ahead, state.heading_rad};
}

}  // namespace aisle::sim
