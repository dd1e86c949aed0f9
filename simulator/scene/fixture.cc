#include "simulator/scene/fixture.h"

namespace aisle::sim {
namespace {

struct Usual {
  double depth_m, length_m, height_m;
  bool blocks;
};

Usual UsualOf(FixtureKind kind) {
  switch (kind) {
    case FixtureKind::kStripCurtain:
      return {0.12, 2.6, 2.8, false};
    case FixtureKind::kPanelWall:
      return {0.12, 4, 3.2, true};
    case FixtureKind::kEvaporator:
      return {0.85, 2.2, 3.4, false};
    case FixtureKind::kLathe:
      return {0.95, 2.3, 1.5, true};
    case FixtureKind::kMill:
      return {1.9, 2.4, 2.2, true};
    case FixtureKind::kDrill:
      return {0.75, 0.5, 1.9, true};
    case FixtureKind::kBench:
      return {0.75, 2, 0.86, true};
    case FixtureKind::kToolWall:
      return {0.3, 2, 2.1, true};
    case FixtureKind::kToolCart:
      return {0.5, 0.75, 0.95, true};
    case FixtureKind::kLocker:
      return {0.5, 1.2, 1.9, true};
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

bool Blocks(const FixtureSpec& fixture) { return UsualOf(fixture.kind).blocks; }

}  // namespace aisle::sim
