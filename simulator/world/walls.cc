#include <cmath>

#include "simulator/world/wall_frame.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kPlinth_m = 0.35f;

void AddWallFace(TriangleMesh* mesh, const Wall& wall, float height, const Palette& palette) {
  const UvRect uv{{0, 1 - (height - kPlinth_m) / kWallSheet_m},
                  {wall.length / palette.wall_wide_m, (height - kPlinth_m) / kWallSheet_m}};
  AddQuad(mesh, wall.At(0, height, 0), wall.length * wall.along, Vector3f(0, 0, kPlinth_m - height),
          uv, palette.wall);
  AddQuad(mesh, wall.At(0, kPlinth_m, 0.04f), wall.length * wall.along, Vector3f(0, 0, -kPlinth_m),
          {}, palette.plinth);
  AddQuad(mesh, wall.At(0, kPlinth_m, 0), wall.length * wall.along, 0.04f * wall.inward, {},
          palette.plinth);
}

const UvRect& AnySign(const Palette& palette, Dice* dice) {
  const int count = static_cast<int>(palette.wall_signs.size());
  return palette.wall_signs[static_cast<std::size_t>(dice->Pick(count))];
}

/// What doors that stand open cover of each wall: from, to, metres to its right.
std::array<std::vector<Vector2f>, 4> OpeningsOf(const Scene& scene) {
  std::array<std::vector<Vector2f>, 4> openings;
  for (const DoorSpec& door : scene.doors) {
    if (door.daylight <= 0) continue;
    const auto& [wall, middle, width, height] = OpeningOf(scene.hall, door);
    const float half = width / 2 + 0.3f;
    openings[static_cast<std::size_t>(door.wall)].emplace_back(middle - half, middle + half);
  }
  return openings;
}

/// Pipes, cable trays, cabinets, extinguishers: what every wall collects; no posts in `openings`.
void AddWallFittings(TriangleMesh* mesh, const Wall& wall, float height, const Palette& palette,
                     const std::vector<Vector2f>& openings, Dice dice) {
  const float tray = height * 0.62f;
  AddBar(mesh, wall.At(0.1f, tray, 0.12f), wall.At(wall.length - 0.1f, tray, 0.12f), 0.12f,
         palette.steel);
  AddBar(mesh, wall.At(0.1f, tray + 0.5f, 0.07f), wall.At(wall.length - 0.1f, tray + 0.5f, 0.07f),
         0.06f, palette.lamp_housing);
  for (float at = 2; at < wall.length - 1; at += static_cast<float>(dice.Between(3, 6))) {
    const auto covers = [&](const Vector2f& open) { return at > open.x() && at < open.y(); };
    if (!std::ranges::any_of(openings, covers)) {
      AddBar(mesh, wall.At(at, 0, 0.08f), wall.At(at, height, 0.08f), 0.16f, palette.steel);
    }
    const float beside = at + 0.7f;
    if (dice.Chance(0.35)) {
      const Vector3f size(0.25f, 0.8f, 1.1f);
      AddBox(mesh, wall.Frame(beside, 1.2f, 0.13f), size,
             BoxPaint::Tiled(palette.steel, size, 1.1f));
    } else if (dice.Chance(0.5)) {
      AddCylinder(mesh, wall.Frame(beside, 0.5f, 0.16f), 0.08f, 0.5f, 12, palette.tote, {}, {});
    }
    if (dice.Chance(0.6)) {
      const Vector3f size(0.03f, 0.7f, 0.7f);
      AddBox(mesh, wall.Frame(beside, 2.3f, 0.02f), size,
             BoxPaint::Whole(palette.sign, AnySign(palette, &dice)));
    }
  }
}

/// An overcast sky all around and above.
void AddSky(const HallSpec& hall, const Palette& palette, WorldBuilder* builder) {
  const float height = static_cast<float>(hall.height_m);
  builder->Add("sky", ObjectClass::kNone, [&](TriangleMesh* mesh) {
    for (const Wall& wall : WallsOf(hall)) {
      AddQuad(mesh, wall.At(0, height, 0), wall.length * wall.along, {0, 0, -height}, {},
              palette.sky);
    }
    const Vector2f low = hall.from.cast<float>(), size = (hall.to - hall.from).cast<float>();
    AddQuad(mesh, {low.x(), low.y(), height}, {size.x(), 0, 0}, {0, size.y(), 0}, {}, palette.sky);
  });
}

}  // namespace

std::array<Wall, 4> WallsOf(const HallSpec& hall) {
  const Vector2f low = hall.from.cast<float>(), high = hall.to.cast<float>();
  const Vector3f x = Vector3f::UnitX(), y = Vector3f::UnitY();
  const Vector2f size = high - low;
  return {{{{low.x(), high.y(), 0}, x, -y, size.x()},
           {{high.x(), low.y(), 0}, -x, y, size.x()},
           {{high.x(), high.y(), 0}, -y, -x, size.y()},
           {{low.x(), low.y(), 0}, y, x, size.y()}}};
}

Opening OpeningOf(const HallSpec& hall, const DoorSpec& door) {
  const Wall wall = WallsOf(hall)[static_cast<std::size_t>(door.wall)];
  const bool along_x = door.wall == WallSide::kNorth || door.wall == WallSide::kSouth;
  const float at = static_cast<float>(door.at_m);
  return {wall, std::abs(at - (along_x ? wall.corner.x() : wall.corner.y())),
          static_cast<float>(door.width_m), static_cast<float>(door.height_m)};
}

void AddWalls(const Scene& scene, const Palette& palette, std::uint64_t seed,
              WorldBuilder* builder) {
  const HallSpec& hall = scene.hall;
  if (hall.walls == WallKind::kSky) return AddSky(hall, palette, builder);
  const float height = static_cast<float>(hall.height_m);
  const std::array<Wall, 4> walls = WallsOf(hall);
  const std::array<std::vector<Vector2f>, 4> openings = OpeningsOf(scene);
  constexpr std::array<const char*, 4> kNames = {"wall_north", "wall_south", "wall_east",
                                                 "wall_west"};
  for (std::size_t i = 0; i < walls.size(); ++i) {
    builder->Add(kNames[i], ObjectClass::kWall,
                 [&](TriangleMesh* mesh) { AddWallFace(mesh, walls[i], height, palette); });
    // Plain means nothing to hold on to; panels that keep the cold in are not drilled.
    if (hall.walls == WallKind::kPlain || hall.walls == WallKind::kInsulated ||
        hall.walls == WallKind::kCassettes) {
      continue;
    }
    builder->Add(
        std::string(kNames[i]) + "_fittings", ObjectClass::kFurniture, [&](TriangleMesh* mesh) {
          AddWallFittings(mesh, walls[i], height, palette, openings[i], Dice(seed, {210, i}));
        });
  }
  AddRoof(scene, palette, builder);
}

void AddDoors(const Scene& scene, const Palette& palette, WorldBuilder* builder) {
  for (std::size_t i = 0; i < scene.doors.size(); ++i) {
    const DoorSpec& door = scene.doors[i];
    const auto& [wall, middle, width, height] = OpeningOf(scene.hall, door);
    builder->Add(fmt::format("door_{}", i), ObjectClass::kFurniture, [&](TriangleMesh* mesh) {
      if (door.daylight > 0) {
        AddOpenDoor(scene.hall, door, palette.days[i], palette, mesh);
      } else {
        const Vector3f leaf(0.06f, width, height);
        AddBox(mesh, wall.Frame(middle, height / 2, 0.07f), leaf, BoxPaint::Whole(palette.door));
      }
      const Vector3f post(0.24f, 0.2f, height + 0.2f);
      for (const float side : {-1.0f, 1.0f}) {
        AddBox(mesh, wall.Frame(middle + side * (width / 2 + 0.1f), post.z() / 2, 0.14f), post,
               BoxPaint::Tiled(palette.stripes, post, 0.5f));
      }
      const Vector3f lintel(0.24f, width + 0.4f, 0.3f);
      AddBox(mesh, wall.Frame(middle, height + 0.15f, 0.14f), lintel,
             BoxPaint::Tiled(palette.steel, lintel, 1));
      const Vector3f sign(0.03f, 0.6f, 0.6f);
      AddBox(mesh, wall.Frame(middle + width / 2 + 0.7f, 2.0f, 0.05f), sign,
             BoxPaint::Whole(palette.sign, palette.wall_signs[8 + i % 2]));
    });
  }
}

}  // namespace aisle::sim
