#include "simulator/truth/moving_now.h"

#include <gtest/gtest.h>

#include "simulator/camera/pixel_rays.h"
#include "simulator/scene/load.h"
#include "simulator/trace/hit_image.h"
#include "simulator/truth/truth.h"
#include "simulator/world/build.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

constexpr double kAmplitude_m = 0.05, kTurnsPerSecond = 1;
constexpr double kOmega = 2 * std::numbers::pi * kTurnsPerSecond;

double SwingSpeed(double time_s) { return kAmplitude_m * kOmega * std::cos(kOmega * time_s); }

/// One triangle whose corner 0 rests, 1 swings to and fro along x, and 2 three times as far.
WorldParts Swing(const std::function<double(double)>& speed_at) {
  WorldParts parts;
  parts.instances = {{"nothing", ObjectClass::kNone, false},
                     {"floor", ObjectClass::kFloor, false},
                     {"arm", ObjectClass::kPerson, true}};
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 5}, {1, 0, 0}, {0, -1, 0}, 1});
  test::MeshBuilder floor, arm;
  floor.Quad({-5, -5, 0}, {10, 0, 0}, {0, 10, 0}, 0, 1);
  arm.Quad({0, 0, 1}, {1, 0, 0}, {0, 0, 1}, 0, 2);
  parts.statics = {floor.mesh, floor.instances};
  parts.mover_meshes = {arm.mesh};
  parts.at = [mesh = arm.mesh, speed_at](std::int64_t stamp_ns) {
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    MoverState mover;
    mover.instance = 2;
    mover.positions = mesh.positions;
    mover.normals = mesh.normals;
    const auto speed = static_cast<float>(speed_at(1e-9 * static_cast<double>(stamp_ns)));
    for (const float share : {0.0f, 1.0f, 3.0f, 0.0f}) {
      mover.velocities.emplace_back(share * speed, 0, 0);
    }
    snapshot.movers.push_back(std::move(mover));
    return snapshot;
  };
  return parts;
}

/// Whether corner 1 of the triangle (0, 1, 2) moves now.
bool CornerMoves(const World& world, std::int64_t stamp_ns, const MovingOptions& options) {
  const Snapshot snapshot = world.At(stamp_ns);
  return MovingNow(world, snapshot, options)(0, 0, 1, 0);
}

/// The fastest that the corner gets within the window, by a fine comb.
double FastestWithin(double stamp_s, double window_s) {
  double fastest = 0;
  for (int k = -500; k <= 500; ++k) {
    fastest = std::max(fastest, std::abs(SwingSpeed(stamp_s + k * window_s / 1000)));
  }
  return fastest;
}

TEST(MovingNow, IsTheFastestWithinTheWindowAtAnyPhaseOfASwing) {
  const World world(Swing(SwingSpeed));
  int moving = 0, decided = 0;
  for (const double window_ms : {2.0, 8.0, 33.0, 100.0}) {
    for (int k = 0; k < 250; ++k) {
      const std::int64_t stamp_ns = 4'000'000LL * k;
      const double fastest = FastestWithin(1e-9 * static_cast<double>(stamp_ns), 1e-3 * window_ms);
      for (const float threshold : {0.01f, 0.05f, 0.2f}) {
        if (std::abs(fastest - threshold) < 0.002 * threshold) continue;
        const bool moves =
            CornerMoves(world, stamp_ns, {.threshold_mps = threshold, .window_ms = window_ms});
        EXPECT_EQ(moves, fastest > threshold)
            << "at " << stamp_ns << " ns, window " << window_ms << ", threshold " << threshold;
        moving += moves;
        ++decided;
      }
    }
  }
  EXPECT_GT(decided, 2900);
  EXPECT_GT(moving, decided / 10);
  EXPECT_LT(moving, 9 * decided / 10);
}

TEST(MovingNow, AtATurningPointTheInstantAloneWouldSeeNothing) {
  const World world(Swing(SwingSpeed));
  constexpr std::int64_t kTurn_ns = 250'000'000;  // a quarter of the swing
  ASSERT_LT(std::abs(SwingSpeed(0.25)), 1e-9);
  const auto threshold = static_cast<float>(0.9 * std::abs(SwingSpeed(0.25 + 0.004)));
  EXPECT_FALSE(CornerMoves(world, kTurn_ns, {.threshold_mps = threshold, .window_ms = 0}));
  EXPECT_TRUE(CornerMoves(world, kTurn_ns, {.threshold_mps = threshold, .window_ms = 8}));
  EXPECT_FALSE(CornerMoves(world, kTurn_ns, {.threshold_mps = threshold, .window_ms = 6}));
}

TEST(MovingNow, WhatRestsAndWhatGoesEvenlyAreSeenAlikeByEveryWindow) {
  for (const double speed : {0.0, 0.049, 0.051, 1.0}) {
    const World world(Swing([=](double) { return speed; }));
    for (const double window_ms : {0.0, 1.0, 8.0, 40.0, 200.0}) {
      EXPECT_EQ(CornerMoves(world, 1'000'000'000, {.window_ms = window_ms}), speed > 0.05)
          << speed << " m/s, window " << window_ms;
    }
  }
}

TEST(MovingNow, SurfaceAndWholeAgreeWithTheCorners) {
  const World world(Swing([](double) { return 0.03; }));
  const Snapshot snapshot = world.At(0);
  const MovingNow moving(world, snapshot, {});
  EXPECT_TRUE(moving.Any(0));
  EXPECT_FALSE(moving(0, 0, 1, 0));        // 0.03 m/s
  EXPECT_TRUE(moving(0, 0, 0, 1));         // 0.09 m/s
  EXPECT_TRUE(moving(0, 0, 0, 0.6f));      // 0.054 m/s
  EXPECT_FALSE(moving(0, 0, 0, 0.5f));     // 0.045 m/s
  EXPECT_TRUE(moving(0, 0, 0.5f, 0.45f));  // 0.0555 m/s
}

/// A person who waves, seen by a small camera.
class ArmsOnly : public testing::Test {
 protected:
  static constexpr float kThreshold = 0.05f;

  /// Fastest speed of the first person's vertices.
  double FastestVertex(std::int64_t stamp_ns) const {
    double fastest = 0;
    const Snapshot snapshot = world_.At(stamp_ns);
    for (const Eigen::Vector3f& v : snapshot.movers.front().velocities) {
      fastest = std::max(fastest, static_cast<double>(v.norm()));
    }
    return fastest;
  }

  /// Stamps at which the first person's arm turns back.
  std::vector<std::int64_t> Reversals(std::size_t count) const {
    constexpr std::int64_t kStep_ns = 10'000'000;
    std::vector<std::int64_t> found = {6'000'000'000};
    double before = 0, at = 0;
    for (std::int64_t t = 9'500'000'000; found.size() < count && t < 16'500'000'000;
         t += kStep_ns) {
      const double after = FastestVertex(t);
      if (at < before && at <= after) found.push_back(t - kStep_ns);
      before = at;
      at = after;
    }
    return found;
  }

  const World world_ = BuildWorld(LoadScene(AISLE_SOURCE_DIR "/scenes/weakness/arms_only.yaml"),
                                  AISLE_SOURCE_DIR "/assets", 1);
};

TEST_F(ArmsOnly, NothingThatMovesDuringTheExposureIsLeftOutAroundReversals) {
  const Tracer tracer(world_, {});
  const StereoCamera camera{
      .width = 376, .height = 240, .fx = 217.6, .fy = 217.6, .cx = 183.6, .cy = 126.1};
  const PixelRays rays = MakePixelRays(camera);
  // Half milliseconds of the window, and one more at each end: a velocity is a difference over a
  // millisecond.
  constexpr int kComb = 18;
  const std::vector<std::int64_t> reversals = Reversals(20);
  ASSERT_EQ(reversals.size(), 20u);
  int frames = 0, moving = 0, missed = 0, invented = 0, missed_at_the_instant = 0;
  for (const std::int64_t reversal : reversals) {
    for (int k = -5; k < 5; ++k) {
      const std::int64_t stamp_ns = reversal + 2'000'000LL * k;
      const std::array views = {CameraView(rays, world_.PlannedRigPose(stamp_ns))};
      const Instant instant = tracer.Pose(world_.At(stamp_ns));
      std::vector<HitImage> hits;
      TraceViews(instant, views, {}, &hits);
      const HitImage& image = hits[0];
      const cv::Mat1b now =
          LabelHits(world_, instant, image, MovingNow(world_, instant.snapshot(), {})).dynamic;
      const cv::Mat1b at_the_instant =
          LabelHits(world_, instant, image, MovingNow(world_, instant.snapshot(), {.window_ms = 0}))
              .dynamic;
      // Where the surfaces are over the window says how fast they are, apart from velocities.
      std::vector<Snapshot> comb;
      for (int j = 0; j <= kComb; ++j) {
        comb.push_back(world_.At(stamp_ns + 500'000LL * (j - kComb / 2)));
      }
      for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
          const std::size_t i = image.Index(x, y);
          if (image.geometry[i] == 0 || image.geometry[i] == kNoGeometry) continue;
          const std::size_t mover = image.geometry[i] - 1;
          const auto& [a, b, c] = world_.mover_meshes()[mover].triangles[image.primitive[i]];
          const auto point = [&](const Snapshot& at) {
            const auto& p = at.movers[mover].positions;
            return Eigen::Vector3f((1 - image.u[i] - image.v[i]) * p[a] + image.u[i] * p[b] +
                                   image.v[i] * p[c]);
          };
          double within = 0, around = 0;  // the fastest over a millisecond
          for (std::size_t j = 0; j + 2 <= kComb; ++j) {
            const double speed = (point(comb[j + 2]) - point(comb[j])).norm() / 1e-3;
            around = std::max(around, speed);
            if (j >= 1 && j + 3 <= kComb) within = std::max(within, speed);
          }
          // A twentieth for the rounding of positions.
          const bool is = within > 1.05 * kThreshold, is_not = around < 0.95 * kThreshold;
          moving += is;
          missed += is && !now(y, x);
          missed_at_the_instant += is && !at_the_instant(y, x);
          invented += is_not && now(y, x);
        }
      }
      ++frames;
    }
  }
  EXPECT_EQ(frames, 200);
  EXPECT_GT(moving, 50'000);
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(invented, 0);
  EXPECT_GT(missed_at_the_instant, 500) << "else these are no reversals";
}

}  // namespace
}  // namespace aisle::sim
