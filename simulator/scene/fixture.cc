#include "simulator/scene/fixture.h"

namespace aisle::sim {
namespace {

/// How far it reaches beyond its size below head height.
struct Beyond {
  double back_m = 0, front_m = 0, right_m = 0, left_m = 0;
};

struct Usual {
  double depth_m, length_m, height_m;
  bool blocks;
  Beyond beyond = {};
};

Usual UsualOf(FixtureKind kind) {
  switch (kind) {
    case FixtureKind::kStripCurtain:
      return {0.12, 2.6, 2.8, false};
    case FixtureKind::kPanelWall:
      return {0.12, 4, 3.2, true, {.back_m = 0.125, .front_m = 0.125}};
    case FixtureKind::kEvaporator:
      return {0.85, 2.2, 3.4, false};
    case FixtureKind::kLathe:
      return {0.95, 2.3, 1.5, true, {.right_m = 0.055, .left_m = 0.03}};
    case FixtureKind::kMill:
      return {1.9, 2.4, 2.2, true, {0.015, 0.18, 0.09, 0.6}};
    case FixtureKind::kDrill:
      return {0.75, 0.5, 1.9, true, {.back_m = 0.06, .front_m = 0.05}};
    case FixtureKind::kBench:
      return {0.75, 2, 0.86, true, {.front_m = 0.08}};
    case FixtureKind::kToolWall:
      return {0.3, 2, 2.1, true, {.front_m = 0.025}};
    case FixtureKind::kToolCart:
      return {0.5, 0.75, 0.95, true, {.left_m = 0.085}};
    case FixtureKind::kLocker:
      return {0.5, 1.2, 1.9, true, {.back_m = 0.01, .front_m = 0.03}};
    case FixtureKind::kGasBottles:
      return {0.4, 0.85, 1.6, true};
    case FixtureKind::kDuct:
      return {0.5, 10, 4.5, false};
    case FixtureKind::kCableTray:
      return {0.3, 10, 3.6, false};
    case FixtureKind::kCableDrop:
      return {0.2, 0.2, 2, false};
    case FixtureKind::kCrane:
      return {0.9, 10, 5, false};
    case FixtureKind::kLeveller:
      return {2.4, 2, 0.02, false};
    case FixtureKind::kGuideRail:
      return {0.1, 10, 0.06, false};
  }
  return {};
}

}  // namespace

Eigen::Vector3d SizeOf(const FixtureSpec& fixture) {
  const Usual usual = UsualOf(fixture.kind);
  return {usual.depth_m, fixture.length_m > 0 ? fixture.length_m : usual.length_m,
          fixture.height_m > 0 ? fixture.height_m : usual.height_m};
}

Eigen::AlignedBox2d FootprintOf(const FixtureSpec& fixture) {
  const Eigen::Vector2d half = SizeOf(fixture).head<2>() / 2;
  const Beyond beyond = UsualOf(fixture.kind).beyond;
  return {-half - Eigen::Vector2d(beyond.back_m, beyond.right_m),
          half + Eigen::Vector2d(beyond.front_m, beyond.left_m)};
}

bool Blocks(const FixtureSpec& fixture) { return UsualOf(fixture.kind).blocks; }

}  // namespace aisle::sim
