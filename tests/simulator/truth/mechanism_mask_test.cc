#include <gtest/gtest.h>

#include "simulator/scene/load.h"
#include "simulator/truth/moving_now.h"
#include "simulator/world/build.h"
#include "tests/simulator/world/mechanism_scene.h"

namespace aisle::sim {
namespace {

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
