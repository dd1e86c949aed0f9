#include "simulator/shade/pass/mover_blockers.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <random>

#include "simulator/camera/pixel_rays.h"
#include "simulator/shade/lanes/ray_packets.h"
#include "simulator/shade/pass/lobe_lamps.h"
#include "simulator/shade/pass/other_camera.h"
#include "simulator/shade/surface/gloss.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  float In(float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(engine_);
  }
  Vector3f Point(const Eigen::AlignedBox3f& box) {
    return box.min() + box.sizes().cwiseProduct(Vector3f(In(0, 1), In(0, 1), In(0, 1)));
  }

 private:
  std::mt19937 engine_;
};

Vector3f Lane(const F8x3& v, int k) { return {v.x[k], v.y[k], v.z[k]}; }

void Set(const Vector3f& from, int k, F8x3* to) {
  to->x[k] = from.x();
  to->y[k] = from.y();
  to->z[k] = from.z();
}

/// A segment of which a fine walk finds a point inside meets the box; one that meets it has a point
/// of the walk close to it.
TEST(MeetBox, SaysWhichSegmentsPassThrough) {
  Random random(1);
  const Eigen::AlignedBox3f space(Vector3f::Constant(-3), Vector3f::Constant(3));
  for (int round = 0; round < 300; ++round) {
    Eigen::AlignedBox3f box(random.Point(space));
    box.extend(random.Point(space));
    F8x3 from, to;
    for (int k = 0; k < 8; ++k) {
      Set(random.Point(space), k, &from);
      Vector3f way = random.Point(space);
      if (k == 3) way.x() = 0;  // along a wall of the box
      Set(way, k, &to);
    }
    const I8 meets = MeetBox(box, from, to);
    for (int k = 0; k < 8; ++k) {
      float nearest = 1e9f;
      for (int i = 0; i <= 400; ++i) {
        const Vector3f at = Lane(from, k) + static_cast<float>(i) / 400 * Lane(to, k);
        nearest = std::min(nearest, box.exteriorDistance(at));
      }
      if (nearest == 0) {
        EXPECT_TRUE(meets[k]) << round;
      }
      if (meets[k]) {
        EXPECT_LT(nearest, 0.03f) << round;
      }
    }
  }
}

struct Stage {
  World world{test::Hall({.boxes = 0, .lights = 8})};
  Tracer tracer{world, {}};
  Instant instant = tracer.Pose(world.At(2'000'000'000));
};

/// What is left out must not matter: no segment between the box and the lamp meets such a mover.
TEST(MoversBetween, LeavesOutNoMoverThatBlocksAnything) {
  const Stage stage;
  Random random(2);
  const Eigen::AlignedBox3f hall(Vector3f(1, -4, 0), Vector3f(28, 4, 2));
  int blocked_at_all = 0, left_out = 0;
  for (int round = 0; round < 400; ++round) {
    Eigen::AlignedBox3f box(random.Point(hall));
    box.extend((box.min() + random.Point({Vector3f::Zero(), Vector3f::Constant(2)})).eval());
    const AreaLight& light = stage.world.lights()[static_cast<std::size_t>(round) % 8];
    const GeometryMask mask =
        MoversBetween(stage.instant, box, light.center, light.half_u, light.half_v);
    left_out += (mask & MoverBit(0)) == 0;
    for (int packet = 0; packet < 20; ++packet) {
      F8x3 from, to;
      for (int k = 0; k < 8; ++k) {
        const Vector3f start = random.Point(box);
        const Vector3f end =
            light.center + random.In(-1, 1) * light.half_u + random.In(-1, 1) * light.half_v;
        Set(start, k, &from);
        Set(end - start, k, &to);
      }
      const Segments8 ways{from, to, Wide(1), WideInt(-1)};
      const unsigned all = Blocked(stage.instant, kMoversOnly, Coherence::kCoherent, ways);
      const unsigned of_mask = Blocked(stage.instant, mask, Coherence::kCoherent, ways);
      blocked_at_all += all != 0;
      ASSERT_EQ(all, of_mask) << round;
    }
  }
  EXPECT_GT(blocked_at_all, 50);
  EXPECT_GT(left_out, 50) << "and it does leave out some";
}

TEST(MeetBoxes, AsksEachLaneForItsOwnBox) {
  Random random(7);
  const Eigen::AlignedBox3f space(Vector3f::Constant(-3), Vector3f::Constant(3));
  for (int round = 0; round < 200; ++round) {
    F8x3 low, high, from, to;
    std::array<Eigen::AlignedBox3f, 8> boxes;
    for (int k = 0; k < 8; ++k) {
      Eigen::AlignedBox3f& box = boxes[static_cast<std::size_t>(k)];
      box = Eigen::AlignedBox3f(random.Point(space));
      box.extend(random.Point(space));
      Set(box.min(), k, &low);
      Set(box.max(), k, &high);
      Set(random.Point(space), k, &from);
      Set(random.Point(space), k, &to);
    }
    const I8 meets = MeetBoxes(low, high, from, to);
    for (int k = 0; k < 8; ++k) {
      EXPECT_EQ(meets[k], MeetBox(boxes[static_cast<std::size_t>(k)], from, to)[k]);
    }
  }
}

/// A shaft says no only where no segment comes near, and it does say no beside a long thin one.
TEST(Shaft, MeetsAllThatItsSegmentsPass) {
  Random random(5);
  const Eigen::AlignedBox3f space(Vector3f(-6, -6, 0), Vector3f(6, 6, 3));
  int met = 0, left_out = 0;
  for (int round = 0; round < 6000; ++round) {
    Eigen::AlignedBox3f from(random.Point(space)), box(random.Point(space));
    from.extend(from.min() + Vector3f(random.In(0, 1), random.In(0, 1), random.In(0, 0.1f)));
    box.extend(box.min() + Vector3f(random.In(0.1f, 1), random.In(0.1f, 1), random.In(0.1f, 2)));
    const Vector3f center(random.In(-8, 8), random.In(-8, 8), 5);
    const Vector3f half_u(random.In(0, 1), random.In(0, 1), 0), half_v(0, -0.2f, 0);
    const bool meets = Shaft(from, center, half_u, half_v).Meets(box);
    for (int packet = 0; packet < 8; ++packet) {
      F8x3 start, way;
      for (int k = 0; k < 8; ++k) {
        const Vector3f at = random.Point(from);
        Set(at, k, &start);
        Set(center + random.In(-1, 1) * half_u + random.In(-1, 1) * half_v - at, k, &way);
      }
      const bool passes = Any(MeetBox(box, start, way));
      ASSERT_TRUE(meets || !passes) << round;
      met += passes;
    }
    left_out += !meets;
  }
  EXPECT_GT(met, 500);
  EXPECT_GT(left_out, 1500);
}

TEST(Shaft, LeavesOutMoversThatAThickSegmentDoesNot) {
  const Stage stage;
  Random random(6);
  const Eigen::AlignedBox3f hall(Vector3f(1, -4, 0), Vector3f(28, 4, 0.1f));
  int loose = 0, tight = 0;
  for (int round = 0; round < 2000; ++round) {
    Eigen::AlignedBox3f box(random.Point(hall));
    box.extend((box.min() + Vector3f(random.In(0, 0.3f), random.In(0, 0.3f), 0)).eval());
    const AreaLight& light = stage.world.lights()[static_cast<std::size_t>(round) % 8];
    const GeometryMask mask =
        MoversBetween(stage.instant, box, light.center, light.half_u, light.half_v);
    const GeometryMask in =
        MoversIn(Shaft(box, light.center, light.half_u, light.half_v), stage.instant, mask);
    EXPECT_EQ(in & ~mask, 0u);
    loose += std::popcount(mask);
    tight += std::popcount(in);
  }
  EXPECT_GT(tight, 0);
  EXPECT_LT(tight, loose);
}

/// Ways between places in the hall, as many lanes valid as bits are set.
Segments8 AnyWays(Random* random, unsigned valid) {
  const Eigen::AlignedBox3f hall(Vector3f(4, -3, 0), Vector3f(18, 3, 2.5f));
  Segments8 ways{.from = {}, .to = {}, .t_far = Wide(0.9f), .valid = LanesOf(valid)};
  for (int k = 0; k < 8; ++k) {
    const Vector3f start = random->Point(hall);
    Set(start, k, &ways.from);
    Set(random->Point(hall) - start, k, &ways.to);
  }
  return ways;
}

Rays8 RaysOf(const Segments8& ways) { return MakeRays(ways.from, ways.to, ways.t_far, ways.valid); }

TEST(Blocked, IsWhatRaysAgainstAllFind) {
  const Stage stage;
  Random random(3);
  unsigned any = 0;
  for (unsigned round = 0; round < 2000; ++round) {
    const Segments8 ways = AnyWays(&random, round & 255u);
    for (const GeometryMask geometries : {kEverything, kStaticOnly, kMoversOnly}) {
      const unsigned blocked = Blocked(stage.instant, geometries, Coherence::kIncoherent, ways);
      ASSERT_EQ(blocked, stage.instant.Occluded(RaysOf(ways), Coherence::kIncoherent, geometries));
      any |= geometries == kMoversOnly ? blocked : 0;
    }
  }
  EXPECT_EQ(any, 255u);
}

TEST(FindBlocked, ManyPacketsFindWhatEachFindsAlone) {
  const Stage stage;
  Random random(8);
  for (std::size_t count = 0; count < 40; ++count) {
    std::vector<Segments8> ways;
    for (std::size_t i = 0; i < count; ++i) {
      ways.push_back(AnyWays(&random, static_cast<unsigned>(7 * i) & 255u));
    }
    std::vector<unsigned> blocked(count, 255u);
    FindBlocked(stage.instant, kEverything, Coherence::kCoherent, ways, blocked);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(blocked[i], Blocked(stage.instant, kEverything, Coherence::kCoherent, ways[i]));
    }
  }
}

TEST(MayMeet, LeavesOutNoMoverThatAnyLaneMeets) {
  const Stage stage;
  Random random(9);
  int met = 0, left_out = 0;
  for (unsigned round = 0; round < 2000; ++round) {
    Segments8 ways = AnyWays(&random, 1u << round % 8 | 1u << round / 8 % 8);
    if (round % 2) ways.t_far = Wide(kInfinity);
    const GeometryMask may = MayMeet(stage.instant, kEverything, ways);
    ASSERT_TRUE(may & kStaticOnly);
    Hits8 all, of_mask;
    stage.instant.Intersect(RaysOf(ways), Coherence::kIncoherent, kEverything, &all);
    stage.instant.Intersect(RaysOf(ways), Coherence::kIncoherent, may, &of_mask);
    for (int k = 0; k < 8; ++k) {
      if (!ways.valid[k]) continue;
      ASSERT_EQ(all.geometry[k], of_mask.geometry[k]) << round;
      met += all.geometry[k] != 0 && all.geometry[k] != kNoGeometry;
    }
    left_out += may == kStaticOnly;
  }
  EXPECT_GT(met, 50);
  EXPECT_GT(left_out, 500);
  EXPECT_EQ(MayMeet(stage.instant, kMoversOnly, AnyWays(&random, 0)), 0u) << "nobody asks";
}

TEST(SolidOf, LeavesOutWhatIsSeenThrough) {
  const Stage stage;
  EXPECT_EQ(SolidOf(stage.instant), kEverything);
  Snapshot snapshot = stage.world.At(0);
  snapshot.movers[1].casts_shadow = false;
  EXPECT_EQ(SolidOf(stage.tracer.Pose(snapshot)), kEverything & ~MoverBit(1));
}

/// The other camera's pixel of a point is the one that sees that point.
TEST(OtherCamera, FindsThePixelThatShowsTheSamePoint) {
  const Stage stage;
  StereoCamera camera;
  camera.width = 101;
  camera.height = 60;
  camera.fx = camera.fy = 70;
  camera.cx = 48;
  camera.cy = 33;
  const PixelRays rays = MakePixelRays(camera);
  const CameraView left(rays, test::LookAlong({4, 0.1, 1.2}, 0.1));
  const CameraView right(rays, test::LookAlong({4.1, -0.3, 1.3}, 0.15));
  std::vector<HitImage> hits;
  TraceViews(stage.instant, std::vector{left, right}, {}, &hits);
  const OtherCamera other(left, hits[0]);
  int found = 0;
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x + 8 <= camera.width; x += 8) {
      const std::size_t i = hits[1].Index(x, y);
      const I8 active = LoadI(&hits[1].geometry[i]) == 0;
      F8x3 points{};
      for (int k = 0; k < 8; ++k) {
        if (!active[k]) continue;
        const Eigen::Vector2f ray = rays.At(x + k, y);
        Set(right.origin + hits[1].t[i + static_cast<std::size_t>(k)] *
                               (right.rotation * Vector3f(ray.x(), ray.y(), 1)),
            k, &points);
      }
      I8 pixels{};
      const I8 primitive = LoadI(&hits[1].primitive[i]);
      const I8 seen = other.Find(points, primitive, active, &pixels);
      for (int k = 0; k < 8; ++k) {
        if (!active[k]) {
          EXPECT_EQ(seen[k], 0);
          continue;
        }
        const Vector3f in_left = left.rotation.transpose() * (Lane(points, k) - left.origin);
        const double u = camera.fx * in_left.x() / in_left.z() + camera.cx;
        const double v = camera.fy * in_left.y() / in_left.z() + camera.cy;
        const int column = static_cast<int>(std::lround(u)), row = static_cast<int>(std::lround(v));
        const double rounding = std::max(std::abs(u - std::round(u)), std::abs(v - std::round(v)));
        if (rounding > 0.499) continue;  // on the border of two pixels
        const bool inside = in_left.z() > 0 && column >= 0 && row >= 0 && column < camera.width &&
                            row < camera.height;
        const std::size_t at = inside ? hits[0].Index(column, row) : 0;
        const bool expected = inside && hits[0].geometry[at] == 0 &&
                              hits[0].primitive[at] == static_cast<std::uint32_t>(primitive[k]);
        ASSERT_EQ(seen[k] != 0, expected) << x + k << ", " << y;
        if (expected) {
          EXPECT_EQ(pixels[k], static_cast<int>(at));
        }
        found += expected;
      }
    }
  }
  EXPECT_GT(found, 1000);
}

/// One ray a place, at a lamp chosen by its importance, is right in the mean: the lobe's integral
/// over all lamps.
TEST(LobeLamps, MirrorInTheMeanWhatTheIntegralOverTheLampsSays) {
  WorldParts parts;
  parts.materials.resize(1);
  parts.instances.push_back({"floor", ObjectClass::kFloor, false});
  test::MeshBuilder floor;
  floor.Quad({-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, 0, 1);
  parts.statics = {floor.mesh, floor.instances};
  parts.lights = {{{1, 0, 3}, {0.5f, 0, 0}, {0, -0.3f, 0}, 2},
                  {{-2, 1, 4}, {0.8f, 0, 0}, {0, -0.2f, 0}, 5},
                  {{3, 3, 3}, {0.5f, 0, 0}, {0, -0.5f, 0}, 4}};
  const World world(std::move(parts));
  const Tracer tracer(world, {});
  const std::vector<float> scale = {0.6f, 0.5f, 0};
  Snapshot snapshot = world.At(0);
  snapshot.light_scale = scale;
  const Instant instant = tracer.Pose(std::move(snapshot));
  const LobeLamps lamps(instant, world.lights());
  for (const float roughness : {0.2f, 0.38f}) {
    const Vector3f out = Vector3f(-0.5f, 0.1f, 0.6f).normalized();
    const LobePoints8 points{{Wide(0.2f), Wide(-0.1f), Wide(0.002f)},
                             Frame8({Wide(0), Wide(0), Wide(1)}),
                             {Wide(out.x()), Wide(out.y()), Wide(out.z())},
                             Wide(0.05f),
                             Wide(roughness)};
    double mean = 0;
    constexpr int kRounds = 20'000;
    Random random(4);
    for (int i = 0; i < kRounds; ++i) {
      LampChoice8 choice;
      for (int k = 0; k < 8; ++k) {
        choice.which[k] = random.In(0, 1);
        choice.a[k] = random.In(0, 1);
        choice.b[k] = random.In(0, 1);
      }
      mean += Sum(lamps.Mirrored(points, choice, WideInt(-1))) / (8.0 * kRounds);
    }
    double expected = 0;
    constexpr int kSide = 200;
    for (std::size_t l = 0; l < 2; ++l) {
      const AreaLight& light = world.lights()[l];
      const float area = 4 * light.half_u.norm() * light.half_v.norm();
      for (int c = 0; c < kSide * kSide; ++c) {
        const float u = (2 * static_cast<float>(c % kSide) + 1) / kSide - 1;
        const float v = (2 * static_cast<float>(c / kSide) + 1) / kSide - 1;
        const Vector3f way =
            light.center + u * light.half_u + v * light.half_v - Vector3f(0.2f, -0.1f, 0.002f);
        const Vector3f in = way.normalized();
        const float lobe = EvaluateLobe(Finish{0.05f, roughness}, {out.x(), out.y(), out.z()},
                                        {in.x(), in.y(), in.z()})
                               .reflected;
        expected += static_cast<double>(scale[l] * light.radiance * lobe * in.z() * area /
                                        way.squaredNorm()) /
                    (kSide * kSide);
      }
    }
    ASSERT_GT(expected, 0);
    EXPECT_NEAR(mean, expected, 0.03 * expected) << roughness;
  }
}

}  // namespace
}  // namespace aisle::sim
