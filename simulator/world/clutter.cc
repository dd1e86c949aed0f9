#include <cmath>

#include "simulator/motion/route.h"
#include "simulator/scene/hall.h"
#include "simulator/scene/obstacles.h"
#include "simulator/world/fittings.h"
#include "simulator/world/wall_frame.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3f;

const Vector3f kX = Vector3f::UnitX(), kY = Vector3f::UnitY(), kZ = Vector3f::UnitZ();
constexpr float kFlat_m = 0.0016f;     ///< paint on the floor is at 1.2 mm
constexpr double kFlatPer_m2 = 0.2;    ///< pieces at clutter 1
constexpr double kStandsPer_m = 0.22;  ///< of wall
constexpr double kWay_m = 0.7;         ///< nothing stands nearer to the rig's way

float Between(Dice* dice, double low, double high) {
  return static_cast<float>(dice->Between(low, high));
}

/// A drop of water or oil and smaller ones about it.
void AddWet(const Maker& make, std::uint16_t material, float radius, Dice* dice) {
  const int drops = 1 + dice->Pick(4);
  for (int i = 0; i < drops; ++i) {
    const float away = i == 0 ? 0 : Between(dice, 1.1, 2.2) * radius;
    const float angle = Between(dice, 0, 6.28), size = i == 0 ? radius : 0.3f * radius;
    Eigen::Isometry3f at = make.pose();
    at.translate(Vector3f(away * std::cos(angle), away * std::sin(angle),
                          kFlat_m + 0.0002f * static_cast<float>(i)));
    const Dice rim = dice->Fork();
    const float slim = Between(dice, 0.45, 0.9);
    AddSpot(make.mesh(), at, Vector2f(size, size * slim), 0.16f, rim, material);
  }
}

void AddStroke(const Maker& make, const Vector2f& from, const Vector2f& to, float wide) {
  const Vector2f along = to - from;
  const Vector2f left = Vector2f(-along.y(), along.x()).normalized() * wide;
  const Vector2f corner = from + left / 2;
  AddQuad(make.mesh(), make.pose() * Vector3f(corner.x(), corner.y(), kFlat_m + 0.0006f),
          make.pose().linear() * Vector3f(along.x(), along.y(), 0),
          make.pose().linear() * Vector3f(-left.x(), -left.y(), 0), {}, make.f.chalk);
}

/// What somebody has chalked on the floor: a cross, an arrow, a ring or strokes that count.
void AddChalk(const Maker& make, Dice* dice) {
  const float s = Between(dice, 0.1, 0.28), w = Between(dice, 0.012, 0.02);
  switch (dice->Pick(4)) {
    case 0:
      AddStroke(make, {-s, -s}, {s, s}, w);
      AddStroke(make, {-s, s}, {s, -s}, w);
      break;
    case 1:
      AddStroke(make, {-1.6f * s, 0}, {s, 0.03f}, w);
      AddStroke(make, {0.4f * s, 0.5f * s}, {s, 0}, w);
      AddStroke(make, {0.35f * s, -0.5f * s}, {s, 0.02f}, w);
      break;
    case 2:
      for (int i = 0; i < 15; ++i) {
        const auto at = [&](int k) {
          const float angle = 0.43f * static_cast<float>(k);
          const float reach = s * (1 + 0.02f * static_cast<float>(k));
          return Vector2f(reach * std::cos(angle), 0.9f * reach * std::sin(angle));
        };
        AddStroke(make, at(i), at(i + 1), w);
      }
      break;
    default:
      for (int i = 0; i < 4; ++i) {
        const float x = 0.07f * static_cast<float>(i);
        AddStroke(make, {x, -0.1f}, {x + Between(dice, -0.02, 0.02), 0.1f}, w);
      }
      AddStroke(make, {-0.04f, -0.06f}, {0.26f, 0.07f}, w);
  }
}

/// A scrap of film: thin, creased, curled at its rims.
void AddFilm(const Maker& make, Dice* dice) {
  constexpr int kSide = 13;
  const float length = Between(dice, 0.3, 0.9), wide = Between(dice, 0.15, 0.45);
  const float a = Between(dice, 0, 6), b = Between(dice, 0, 6), c = Between(dice, 2, 9);
  std::vector<Vector3f> points;
  for (int i = 0; i < kSide * kSide; ++i) {
    const float u = static_cast<float>(i % kSide) / (kSide - 1) - 0.5f;
    const float v = static_cast<float>(i / kSide) / (kSide - 1) - 0.5f;
    const float crease =
        std::abs(std::sin(c * u + 3 * v + a)) * std::abs(std::cos(7 * v - 2 * u + b));
    const float up = 0.004f + 0.045f * crease * (0.4f + std::abs(u) + std::abs(v));
    points.push_back(make.pose() * Vector3f(length * (u + 0.12f * std::sin(5 * v + a)),
                                            wide * (v + 0.2f * std::sin(4 * u + b)), up));
  }
  AddSheet(make.mesh(), points, kSide, make.f.film);
}

/// Strapping band cut off a load: a springy loop that lies on its edge.
void AddBand(const Maker& make, Dice* dice) {
  const float radius = Between(dice, 0.1, 0.22);
  std::vector<Vector3f> points;
  const int parts = 40;
  for (int row = 0; row < parts; ++row) {
    const float t = static_cast<float>(row) / (parts - 1);
    const float angle = (7.5f + 2 * radius) * t, reach = radius * (0.75f + 0.5f * t);
    const float lean = 0.004f * std::sin(2 * angle);
    for (const float z : {0.002f, 0.016f}) {
      points.push_back(make.pose() * Vector3f((reach + lean * z * 60) * std::cos(angle),
                                              0.8f * reach * std::sin(angle), z + 0.004f * t));
    }
  }
  AddSheet(make.mesh(), points, 2, dice->Chance(0.6) ? make.f.dark : make.f.white);
}

void AddScrap(const Maker& make, Dice* dice) {
  const int pieces = 1 + dice->Pick(4);
  for (int i = 0; i < pieces; ++i) {
    const float y = Between(dice, -0.35, 0.35), x = Between(dice, -0.35, 0.35);
    const bool wood = dice->Chance(0.4);
    Eigen::Isometry3f pose = make.At({x, y, 0.006f});
    pose.rotate(Eigen::AngleAxisf(Between(dice, 0, 6.28), kZ));
    pose.rotate(Eigen::AngleAxisf(Between(dice, -0.03, 0.03), kX));
    const float wide = wood ? Between(dice, 0.015, 0.04) : Between(dice, 0.08, 0.24);
    const float length = wood ? Between(dice, 0.06, 0.22) : Between(dice, 0.1, 0.3);
    AddRounded(make.mesh(), pose, {length, wide, wood ? 0.01f : 0.005f}, 0.002f,
               wood ? make.p.wood : make.f.card, 0.4f);
  }
}

/// Flat enough to drive over.
void AddFlat(const Maker& make, Dice dice) {
  const double kind = dice.Unit();
  if (kind < 0.16) return AddWet(make, make.f.puddle, Between(&dice, 0.12, 0.5), &dice);
  if (kind < 0.36) return AddWet(make, make.f.oil, Between(&dice, 0.02, 0.11), &dice);
  if (kind < 0.5) return AddChalk(make, &dice);
  if (kind < 0.66) return AddFilm(make, &dice);
  if (kind < 0.8) return AddBand(make, &dice);
  AddScrap(make, &dice);
}

/// A hose or cable in coils on the floor, one turn slung over the others.
void AddCoil(const Maker& make, Dice* dice) {
  const float radius = Between(dice, 0.16, 0.26), thick = Between(dice, 0.008, 0.016);
  const int turns = 3 + dice->Pick(4);
  std::vector<Vector3f> way;
  for (int i = 0; i < 18 * turns; ++i) {
    const float t = static_cast<float>(i) / 18, angle = 6.2832f * t;
    const float reach =
        radius * (1 + 0.08f * std::sin(2.3f * t)) - 0.5f * thick * std::fmod(t, 2.0f);
    way.emplace_back(reach * std::cos(angle), 0.92f * reach * std::sin(angle),
                     thick * (1 + 1.5f * t));
  }
  const Vector3f last = way.back();
  way.emplace_back(last.x() + 0.05f, last.y() + 0.12f, 1.2f * thick);
  way.emplace_back(last.x() + 0.02f, last.y() + 0.34f, thick);
  make.Pipe(way, thick, dice->Chance(0.5) ? make.f.rubber : make.f.dark, 7);
}

/// A hose that was dropped along the wall.
void AddHose(const Maker& make, Dice* dice) {
  std::vector<Vector3f> points;
  const float thick = Between(dice, 0.009, 0.015);
  for (int i = 0; i < 8; ++i) {
    points.emplace_back(Between(dice, -0.13, 0.13), 0.34f * static_cast<float>(i) - 1.2f, thick);
  }
  make.Pipe(Smooth(points, 7), thick, dice->Chance(0.5) ? make.f.rubber : make.f.dark, 8);
}

void AddBucket(const Maker& make, Dice* dice) {
  const std::uint16_t material = dice->Chance(0.5) ? make.f.dark : make.f.white;
  make.Turn(Vector3f::Zero(), kZ,
            {{0, 0},
             {0.11f, 0},
             {0.12f, 0.01f},
             {0.145f, 0.27f},
             {0.155f, 0.275f},
             {0.15f, 0.285f},
             {0.135f, 0.28f},
             {0.11f, 0.05f},
             {0, 0.05f}},
            material, 24);
  std::vector<Vector3f> bail;
  for (int i = 0; i <= 12; ++i) {
    const float angle = 3.1416f * static_cast<float>(i) / 12;
    bail.emplace_back(0.15f * std::sin(angle) * 0.85f, 0.15f * std::cos(angle),
                      0.27f + 0.05f * std::sin(angle));
  }
  make.Pipe(bail, 0.004f, make.f.chrome, 6);
}

/// Stands against the wall behind it: a broom, a shovel, a bar.
void AddLeaning(const Maker& make, Dice* dice) {
  const float tall = Between(dice, 1.2, 1.5), side = Between(dice, -0.12, 0.12);
  const Vector3f foot(0.22f, 0, 0.05f), head(-0.2f, side, tall);
  make.Pipe({foot, head}, 0.013f, make.p.wood, 10);
  if (dice->Chance(0.6)) {
    make.Block(foot + Vector3f(0, 0, 0.03f), {0.07f, 0.42f, 0.04f}, make.p.wood, 0.012f, 0.6f);
    make.Block(foot - Vector3f(0, 0, 0.015f), {0.085f, 0.42f, 0.065f}, make.f.dark, 0.015f);
  } else {
    make.Block(foot + Vector3f(0.01f, 0, 0.11f), {0.025f, 0.24f, 0.3f}, make.p.steel, 0.01f, 0.5f);
  }
}

/// Film rolls, tins, a reel, totes: what waits at the foot of a wall.
void AddOnFloor(const Maker& make, Dice* dice) {
  switch (dice->Pick(4)) {
    case 0:
      for (int i = 0; i < 2 + dice->Pick(3); ++i) {
        const Vector3f at(Between(dice, -0.08, 0.08), 0.14f * static_cast<float>(i) - 0.2f, 0);
        make.Turn(at, kZ,
                  {{0.02f, 0.5f},
                   {0.02f, 0.01f},
                   {0.05f, 0},
                   {0.055f, 0.01f},
                   {0.055f, 0.49f},
                   {0.05f, 0.5f},
                   {0.02f, 0.5f}},
                  make.f.film, 18);
      }
      break;
    case 1: {
      const float wide = Between(dice, 0.14, 0.2);
      make.Turn({0, -0.12f, 0.21f}, kY,
                {{0, 0},
                 {0.205f, 0},
                 {0.21f, 0.01f},
                 {0.205f, 0.025f},
                 {wide - 0.03f, 0.025f},
                 {wide, 0.12f},
                 {wide - 0.02f, 0.215f},
                 {0.205f, 0.215f},
                 {0.21f, 0.23f},
                 {0.205f, 0.24f},
                 {0, 0.24f}},
                dice->Chance(0.5) ? make.p.wood : make.f.dark, 28);
      break;
    }
    case 2:
      for (int i = 0; i < 1 + dice->Pick(3); ++i) {
        make.Block(
            {0, 0.02f * static_cast<float>(dice->Signed()), 0.16f + 0.31f * static_cast<float>(i)},
            {0.4f, 0.58f, 0.3f}, make.p.tote, 0.02f, 0.6f);
      }
      break;
    default:
      for (int i = 0; i < 3; ++i) {
        make.Turn({Between(dice, -0.1, 0.1), 0.17f * static_cast<float>(i) - 0.15f, 0}, kZ,
                  {{0, 0},
                   {0.07f, 0},
                   {0.075f, 0.008f},
                   {0.072f, 0.016f},
                   {0.072f, 0.19f},
                   {0.075f, 0.2f},
                   {0.06f, 0.205f},
                   {0.055f, 0.195f},
                   {0, 0.195f}},
                  dice->Chance(0.5) ? make.f.enamel : make.f.dark, 20);
      }
  }
}

/// A kind of thing that stands or lies at the foot of a wall.
struct Standing {
  double share;    ///< of all
  double reach_m;  ///< along the wall, to both sides of its middle
  void (*add)(const Maker& make, Dice* dice);
};
constexpr std::array kStandings = {Standing{0.2, 0.32, AddCoil}, Standing{0.16, 1.25, AddHose},
                                   Standing{0.16, 0.32, AddBucket}, Standing{0.2, 0.32, AddLeaning},
                                   Standing{0.28, 0.32, AddOnFloor}};
constexpr double kStandingOut_m = 0.29;  ///< each reaches so far out, to both sides of its middle

const Standing& PickStanding(Dice* dice) {
  double left = dice->Unit();
  for (const Standing& standing : kStandings) {
    if (left < standing.share) return standing;
    left -= standing.share;
  }
  return kStandings.back();
}

/// Where things may be put. Actors do not count: who is taken out of a scene leaves no trace.
class Ways {
 public:
  explicit Ways(const Scene& scene) : scene_(scene), obstacles_(ObstaclesOf(scene)) {
    if (!scene.rig.poses.empty()) {
      for (const TimedPose& pose : scene.rig.poses) {
        points_.push_back(pose.T_world_body.translation().head<2>());
      }
      return;
    }
    const Route route(scene.rig.route.plan, scene.rig.route.limits);
    for (double t = 0; t <= route.duration_s(); t += 0.25) points_.push_back(route.At(t).position);
  }

  bool Taken(const Vector2d& point, double margin) const {
    return !InHall(scene_.hall, point, margin) ||
           std::ranges::any_of(obstacles_, [&](const Obstacle& obstacle) {
             return obstacle.DistanceTo(point) < margin;
           });
  }
  /// From now on something is there, too.
  void Put(const Obstacle& thing) { obstacles_.push_back(thing); }
  bool OnWay(const Vector2d& point) const {
    return std::ranges::any_of(points_,
                               [&](const Vector2d& at) { return (at - point).norm() < kWay_m; });
  }

 private:
  const Scene& scene_;
  std::vector<Obstacle> obstacles_;
  std::vector<Vector2d> points_;
};

/// A door is no wall to lean things against.
bool AtDoor(const Scene& scene, WallSide side, const Vector2d& point) {
  const bool along_x = side == WallSide::kNorth || side == WallSide::kSouth;
  const double along = along_x ? point.x() : point.y();
  return std::ranges::any_of(scene.doors, [&](const DoorSpec& door) {
    return door.wall == side && std::abs(door.at_m - along) < door.width_m / 2 + 1.2;
  });
}

/// A place at the foot of a wall.
struct WallPlace {
  WallSide side;
  Vector2d at;
  Vector2d along;      ///< unit, along the wall
  double heading_rad;  ///< into the hall
};

/// Anywhere along the walls, each metre as likely as any other.
WallPlace SomeWallPlace(const HallSpec& hall, Dice* dice) {
  const std::array<Wall, 4> walls = WallsOf(hall);
  const double out = dice->Between(0.3, 0.36);
  double right = dice->Between(0, 2 * (hall.to - hall.from).sum());
  std::size_t side = 0;
  for (; side + 1 < walls.size() && right >= walls[side].length; ++side) {
    right -= walls[side].length;
  }
  const Wall& wall = walls[side];
  const Vector3f at = wall.At(static_cast<float>(right), 0, static_cast<float>(out));
  return {static_cast<WallSide>(side), at.head<2>().cast<double>(),
          wall.along.head<2>().cast<double>(), std::atan2(wall.inward.y(), wall.inward.x())};
}

/// Whether nothing is in the way of a thing that reaches so far along the wall.
bool IsFree(const Scene& scene, const Ways& ways, const WallPlace& place, double reach_m) {
  constexpr double kStep_m = 0.25;
  const double end = std::max(0.0, reach_m - kStandingOut_m);
  const int steps = static_cast<int>(std::ceil(2 * end / kStep_m));
  for (int i = 0; i <= steps; ++i) {
    const double along = -end + 2 * end * i / std::max(1, steps);
    const Vector2d point = place.at + along * place.along;
    if (AtDoor(scene, place.side, point) || ways.Taken(point, kStandingOut_m) ||
        ways.OnWay(point)) {
      return false;
    }
  }
  return true;
}

}  // namespace

void AddClutter(const Scene& scene, const Kit& kit, std::uint64_t seed, WorldBuilder* builder) {
  const HallSpec& hall = scene.hall;
  if (hall.clutter <= 0) return;
  Ways ways(scene);
  const Vector2d size = hall.to - hall.from;
  Dice dice(seed, {350});
  const auto put = [&](const Vector2d& at, double heading, ObjectClass kind, const char* name,
                       int i, const auto& draw) {
    const Vector2f point = at.cast<float>();
    const Eigen::Isometry3f pose = At(point.x(), point.y(), 0, static_cast<float>(heading));
    builder->Add(fmt::format("{}_{}", name, i), kind,
                 [&](TriangleMesh* mesh) { draw(Maker(kit, pose, mesh)); });
  };
  const int flats = static_cast<int>(hall.clutter * kFlatPer_m2 * size.prod());
  for (int i = 0; i < flats; ++i) {
    Dice own = dice.Fork();
    const double y = own.Unit(), x = own.Unit();
    const Vector2d at = hall.from + size.cwiseProduct(Vector2d(x, y));
    const double heading = own.Between(0, 6.28);
    if (ways.Taken(at, 0.35)) continue;
    put(at, heading, ObjectClass::kFloor, "litter", i,
        [&](const Maker& make) { AddFlat(make, own.Fork()); });
  }
  const int stands = static_cast<int>(hall.clutter * kStandsPer_m * 2 * size.sum());
  for (int i = 0; i < stands; ++i) {
    Dice own = dice.Fork();
    const Standing& standing = PickStanding(&own);
    const WallPlace place = SomeWallPlace(hall, &own);
    if (!IsFree(scene, ways, place, standing.reach_m)) continue;
    ways.Put({"", place.at, {kStandingOut_m, standing.reach_m}, place.heading_rad});
    put(place.at, place.heading_rad, ObjectClass::kFurniture, "left_standing", i,
        [&](const Maker& make) { standing.add(make, &own); });
  }
}

}  // namespace aisle::sim
