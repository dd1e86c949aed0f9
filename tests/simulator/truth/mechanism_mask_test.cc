#include <gtest/gtest.h>

#include "simulator/scene/load.h"
#include "simulator/truth/moving_now.h"
#include "simulator/world/build.h"

namespace aisle::sim {
namespace {

const std::string kHall = R"(about: Things move.
frames: 200
rig: {start: [0, 0], steps: []}
hall: {from: [-5, -8], to: [20, 8], height_m: 6}
lights: [{rows: 1, per_row: 2, height_m: 5}]
)";

const std::string kJoints = R"(mechanisms:
  - name: all
    at: [5, 1]
    heading_deg: 20
    parts:
      - {name: arm, size_m: [1, 0.1, 0.1], at_m: [0, 0, 2], joint: {kind: hinge, axis: [0, 0, 1], moves: [{at_s: 1, to_deg: 70, over_s: 1.5}]}}
      - {on: arm, size_m: [0.2, 0.2, 0.2], at_m: [0.5, 0, 0], joint: {kind: spin, axis: [1, 0, 0], rate_hz: 0.7, from_s: 2}}
      - {size_m: [0.1, 1, 1], at_m: [2, 0, 0.5], joint: {kind: slider, axis: [0, 1, 0], moves: [{at_s: 2, to_m: 1, over_s: 2}]}}
      - {shape: link, size_m: [0.1, 0.03, 0.14], at_m: [3, 0, 4], count: 10, joint: {kind: chain, axis: [1, 0, 0], length_m: 1, swing_m: 0.2, at_s: 0.5}}
      - {shape: cylinder, size_m: [0.1, 0.1, 0.5], at_m: [4, 0, 1], roll_deg: 90, count: 3, step_m: [0.2, 0, 0], delay_s: 0.3, joint: {kind: pendulum, axis: [0, 1, 0], swing_deg: 20, length_m: 0.7, decay_s: 2, at_s: 0.2}}
      - {size_m: [5, 0.2, 0.2], at_m: [2, 2, 0.1]}
)";

std::int64_t Nano(double time_s) { return std::llround(1e9 * time_s); }

/// What moves now is what brute force says of the corners: a point moves iff where it is a moment
/// later is not where it was.
TEST(Mechanism, TheMaskIsWhatBruteForceFinds) {
  const World world = BuildWorld(ParseScene(kHall + kJoints, "s.yaml"),
                                 std::string(AISLE_SOURCE_DIR) + "/assets", 1);
  constexpr double kHalf_s = 0.002;
  constexpr float kThreshold = 0.05f;
  int moving = 0, resting = 0;
  for (int step = 0; step < 50; ++step) {
    const double t = 0.0731 + 0.0917 * step;
    const Snapshot now = world.At(Nano(t));
    const Snapshot before = world.At(Nano(t - kHalf_s)), after = world.At(Nano(t + kHalf_s));
    const MovingNow mask(world, now, {.threshold_mps = kThreshold, .window_ms = 0.5});
    const TriangleMesh& mesh = world.mover_meshes()[0];
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      const std::uint32_t corner = mesh.triangles[i][0];
      const float speed =
          (after.movers[0].positions[corner] - before.movers[0].positions[corner]).norm() /
          static_cast<float>(2 * kHalf_s);
      if (std::abs(speed - kThreshold) < 5e-3f) continue;
      ASSERT_EQ(mask(0, i, 0, 0), speed > kThreshold) << "triangle " << i << " at " << t << " s";
      ++(speed > kThreshold ? moving : resting);
    }
  }
  EXPECT_GT(moving, 1000);
  EXPECT_GT(resting, 1000);
}

}  // namespace
}  // namespace aisle::sim
