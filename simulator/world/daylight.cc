#include <cmath>
#include <numbers>

#include "simulator/world/fittings.h"
#include "simulator/world/wall_frame.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

/// Share of the way up to which the yard outside reaches.
constexpr float kYard = 0.34f;

/// A sectional door that has run up under the roof: rails, and its leaf along them.
void AddRaisedLeaf(TriangleMesh* mesh, const Eigen::Isometry3f& frame, float width, float height,
                   const Palette& palette) {
  const float in = std::min(height, 3.2f);
  Eigen::Isometry3f leaf = frame;
  leaf.translate(Vector3f(0.35f + in / 2, 0, height + 0.32f));
  const Vector3f size(in, width, 0.05f);
  AddBox(mesh, leaf, size, BoxPaint::Whole(palette.door));
  for (const float side : {-1.0f, 1.0f}) {
    const float y = side * (width / 2 + 0.05f);
    std::vector<Vector3f> rail = {{0.14f, y, 0.3f},
                                  {0.14f, y, height - 0.1f},
                                  {0.2f, y, height + 0.2f},
                                  {0.42f, y, height + 0.32f},
                                  {0.42f + in, y, height + 0.36f}};
    for (Vector3f& point : rail) point = frame * point;
    AddTube(mesh, Smooth(rail, 4), 0.028f, 8, palette.steel);
  }
  Eigen::Isometry3f shaft = frame;
  shaft.translate(Vector3f(0.2f, 0, height + 0.5f));
  AddTube(mesh, {shaft * Vector3f(0, -width / 2, 0), shaft * Vector3f(0, width / 2, 0)}, 0.035f, 12,
          palette.steel);
}

}  // namespace

void AddOpenDoor(const HallSpec& hall, const DoorSpec& door, const Palette::Day& day,
                 const Palette& palette, TriangleMesh* mesh) {
  const Opening opening = OpeningOf(hall, door);
  const Wall& wall = opening.wall;
  const float half = opening.width / 2, sill = kYard * opening.height;
  const auto pane = [&](float low, float high, std::uint16_t material) {
    AddQuad(mesh, wall.At(opening.middle - half, high, 0.03f), 2 * half * wall.along,
            Vector3f(0, 0, low - high), {{0, 0}, {opening.width / 5, (high - low) / 1.5f}},
            material);
  };
  pane(sill, opening.height, day.sky);
  pane(0, sill, day.yard);
  AddRaisedLeaf(mesh, wall.Frame(opening.middle, 0, 0), opening.width, opening.height, palette);
}

std::array<AreaLight, kLightsOfDoor> DaylightOf(const HallSpec& hall, const DoorSpec& door) {
  const Opening opening = OpeningOf(hall, door);
  const float sill = kYard * opening.height;
  const auto between = [&](float low, float high, float radiance) -> AreaLight {
    const Eigen::Isometry3f frame = opening.wall.Frame(opening.middle, (low + high) / 2, 0.06f);
    return {frame.translation(), frame.linear().col(1) * opening.width / 2,
            frame.linear().col(2) * (high - low) / 2, radiance};
  };
  const auto day = static_cast<float>(door.daylight);
  return {between(sill, opening.height, day), between(0, sill, kYardShare * day)};
}

float CloudAt(const HallSpec& hall, double time_s) {
  // Two periods that never meet again, steep at the clouds' edges and flat between them.
  const double turn = 2 * std::numbers::pi * time_s / hall.cloud_s;
  const double cover = 0.5 + 0.5 * std::sin(turn - 1.2) * (0.75 + 0.25 * std::sin(0.377 * turn));
  const double t = std::clamp((cover - 0.3) / 0.45, 0.0, 1.0);
  return static_cast<float>(1 - hall.cloud * t * t * (3 - 2 * t));
}

}  // namespace aisle::sim
