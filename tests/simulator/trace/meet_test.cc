#include "simulator/trace/meet.h"

#include <gtest/gtest.h>

#include <numeric>

#include "simulator/trace/tracer.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

Rays8 Through(const Eigen::Vector3f& from, std::span<const Eigen::Vector3f> targets) {
  Rays8 rays;
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Eigen::Vector3f d = targets[k % targets.size()] - from;
    rays.ox[k] = from.x();
    rays.oy[k] = from.y();
    rays.oz[k] = from.z();
    rays.dx[k] = d.x();
    rays.dy[k] = d.y();
    rays.dz[k] = d.z();
    rays.t_near[k] = 0;
    rays.t_far[k] = kInfinity;
    rays.valid[k] = -1;
  }
  return rays;
}

TEST(Meet, GivesTheBarycentricsAndTheDistanceThatThePointWasMadeFrom) {
  cv::RNG rng(5);
  const auto any = [&] {
    return Eigen::Vector3f(rng.uniform(1.f, 9.f), rng.uniform(-4.f, 4.f), rng.uniform(-2.f, 2.f));
  };
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3f a = any(), b = any(), c = any(), from(-1, 0.5f, 0.25f);
    const float u = rng.uniform(0.f, 0.5f), v = rng.uniform(0.f, 0.5f);
    const Eigen::Vector3d target =
        (1.0 - u - v) * a.cast<double>() + u * b.cast<double>() + v * c.cast<double>();
    const Eigen::Vector3d normal = (b - a).cross(c - a).cast<double>();
    const Eigen::Vector3d way = target - from.cast<double>();
    const double slope = std::abs(normal.normalized().dot(way.normalized()));
    if (slope < 0.1 || normal.norm() < 1) continue;
    const Corners one{a, b, c, 0.1f}, other{c, a, b, 2};
    std::array<const Corners*, kLanes> by_lane;
    for (std::size_t k = 0; k < kLanes; ++k) by_lane[k] = k % 3 == 1 ? &other : &one;
    const std::array targets = {Eigen::Vector3f(target.cast<float>())};
    const Rays8 rays = Through(from, targets);
    const Meetings8 met = Meet(rays, Corners8(one)), mixed = Meet(rays, Corners8(by_lane));
    for (int k = 0; k < kLanes; ++k) {
      EXPECT_NEAR(mixed.t[k], 1, 3e-6 / slope);
      EXPECT_NEAR(mixed.u[k], k % 3 == 1 ? 1 - u - v : u, 1e-5 / slope);
      EXPECT_NEAR(mixed.v[k], k % 3 == 1 ? u : v, 1e-5 / slope);
      EXPECT_EQ(mixed.on_rim[k], k % 3 == 1 ? -1 : met.on_rim[k]);
      EXPECT_NEAR(met.t[k], 1, 3e-6 / slope);
      EXPECT_NEAR(met.u[k], u, 1e-5 / slope);
      EXPECT_NEAR(met.v[k], v, 1e-5 / slope);
      const float inside = std::min({met.u[k], met.v[k], 1 - met.u[k] - met.v[k]});
      EXPECT_EQ(met.on_rim[k], inside < 0.1f ? -1 : 0);
    }
  }
}

TEST(Corners8, FoursOfLanesHaveOneTriangleEach) {
  const Corners one{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}, 0.1f};
  const Corners other{{-1, -2, -3}, {-4, -5, -6}, {-7, -8, -9}, 2};
  std::array<const Corners*, kLanes> by_lane;
  for (std::size_t k = 0; k < kLanes; ++k) by_lane[k] = k < 4 ? &one : &other;
  const Corners8 expected(by_lane), found(one, other);
  for (int k = 0; k < kLanes; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(found.a[axis][k], expected.a[axis][k]);
      EXPECT_EQ(found.b[axis][k], expected.b[axis][k]);
      EXPECT_EQ(found.c[axis][k], expected.c[axis][k]);
    }
    EXPECT_EQ(found.rim[k], expected.rim[k]);
  }
}

/// A disc in the plane x = 4 of as many triangles as there are numbers, all of which meet in its
/// middle; `order` says which comes first in the mesh.
World Fan(std::span<const int> order) {
  WorldParts parts;
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 5}, {1, 0, 0}, {0, -1, 0}, 1});
  parts.instances.push_back({"thing", ObjectClass::kFurniture, false});
  test::MeshBuilder fan;
  const int count = static_cast<int>(order.size());
  const auto at = [&](int i) {
    const double angle = 2 * M_PI * i / count;
    return Eigen::Vector3f(4, static_cast<float>(std::cos(angle)),
                           static_cast<float>(std::sin(angle)));
  };
  for (const int i : order) {
    const auto first = static_cast<std::uint32_t>(fan.mesh.positions.size());
    for (const Eigen::Vector3f& corner : {Eigen::Vector3f(4, 0, 0), at(i), at((i + 1) % count)}) {
      fan.mesh.positions.push_back(corner);
      fan.mesh.normals.emplace_back(-1, 0, 0);
      fan.mesh.uvs.emplace_back(0, 0);
    }
    fan.mesh.triangles.push_back({first, first + 1, first + 2});
    fan.mesh.materials.push_back(0);
    fan.instances.push_back(1);
  }
  parts.statics = {fan.mesh, fan.instances};
  return World(std::move(parts));
}

TEST(Instant, WhereTrianglesMeetTheFirstOfTheMeshIsHitWhicheverThatIs) {
  std::vector<int> order(12);
  std::iota(order.begin(), order.end(), 0);
  for (int turn = 0; turn < 12; ++turn) {
    std::ranges::rotate(order, order.begin() + 5);
    const World world = Fan(order);
    const Tracer tracer(world, {});
    const std::array targets = {Eigen::Vector3f(4, 0, 0)};
    Hits8 hits;
    tracer.Pose(world.At(0))
        .Intersect(Through({0, 0, 0}, targets), Coherence::kCoherent, kEverything, &hits);
    for (int k = 0; k < kLanes; ++k) {
      EXPECT_EQ(hits.geometry[k], 0u);
      EXPECT_EQ(hits.primitive[k], 0u);
      EXPECT_FLOAT_EQ(hits.t[k], 1);
    }
  }
}

}  // namespace
}  // namespace aisle::sim
