#include "simulator/shade/light/radiosity.h"

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>
#include <random>
#include <ranges>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

using Eigen::Vector3f;

/// A closed room, 4 × 3 × 2.5 m, seen from inside.
World Room() {
  WorldParts parts;
  parts.instances.push_back({"room", ObjectClass::kWall, false});
  parts.materials.resize(1);
  parts.lights.push_back({{2, 1.5f, 2.4f}, {0.5f, 0, 0}, {0, -0.5f, 0}, 1});
  test::MeshBuilder room;
  const Vector3f o(0, 0, 0), x(4, 0, 0), y(0, 3, 0), z(0, 0, 2.5f);
  room.Quad(o, x, y, 0, 1);
  room.Quad(o + z, y, x, 0, 1);
  room.Quad(o, z, x, 0, 1);
  room.Quad(o + y, x, z, 0, 1);
  room.Quad(o, y, z, 0, 1);
  room.Quad(o + x, z, y, 0, 1);
  parts.statics = {room.mesh, room.instances};
  return World(std::move(parts));
}

struct Solved {
  World world = Room();
  Tracer tracer{world, {}};
  Instant instant = tracer.Pose(world.At(0));
  LightGrid grid = MakeLightGrid(world.statics().mesh, 0.4f);
  std::vector<SurfacePoint> points = LocatePoints(
      grid, world.statics().mesh, world.statics().mesh.positions, world.statics().mesh.normals);
};

std::vector<std::uint32_t> AllFixed(std::size_t points) {
  return std::vector<std::uint32_t>(points, kFixed);
}

/// Nothing shines by itself, nothing is loose.
Patches PatchesIn(const Solved& room, std::vector<float> albedo) {
  const std::size_t count = albedo.size();
  return MakePatches(AllFixed(count), room.points,
                     {std::move(albedo), std::vector<float>(count, 0)});
}

/// In a furnace every ray meets what leaves every wall: after n bounces the indirect light is
/// E (ρ + ρ² + … + ρⁿ), whatever the room's shape.
TEST(Radiosity, InAFurnaceIsTheGeometricSeries) {
  const Solved room;
  for (const float albedo : {0.0f, 0.3f, 0.8f}) {
    const Patches patches = PatchesIn(room, std::vector<float>(room.points.size(), albedo));
    for (const int bounces : {1, 2, 6}) {
      const std::vector<float> direct(patches.places.size(), 10.0f);
      SolveWatch watch({}, {});
      const Radiosity solved = SolveRadiosity(room.instant, room.grid, patches, direct,
                                              {.directions = 64, .bounces = bounces}, &watch);
      double expected = 0;
      for (int n = 1; n <= bounces; ++n) expected += 10 * std::pow(albedo, n);
      for (const float indirect : solved.indirect) {
        ASSERT_NEAR(indirect, expected, 1e-4 * (1 + expected)) << albedo << " " << bounces;
      }
      EXPECT_EQ(solved.direct, direct);
    }
  }
}

/// Walls that all shine by M and reflect ρ receive M (1 + ρ + ρ² + …), and the air sees it all.
TEST(Radiosity, WhatShinesByItselfLightsTheOthers) {
  const Solved room;
  const std::size_t count = room.points.size();
  const float albedo = 0.4f, emitted = 3;
  const Patches patches =
      MakePatches(AllFixed(count), room.points,
                  {std::vector<float>(count, albedo), std::vector<float>(count, emitted)});
  const std::vector<float> dark(patches.places.size(), 0);
  SolveWatch watch({}, {});
  const Radiosity solved = SolveRadiosity(room.instant, room.grid, patches, dark,
                                          {.directions = 64, .bounces = 12}, &watch);
  const double expected = emitted / (1 - albedo);
  for (const float indirect : solved.indirect) ASSERT_NEAR(indirect, expected, 1e-3);
  LightVolume volume(Eigen::AlignedBox3f(Vector3f(1, 1, 1), Vector3f(2, 2, 1.5f)), 0.5f);
  SolveWatch another({}, {});
  FillVolume(room.instant, room.grid, room.world.statics().mesh, patches, solved, 256, &volume,
             &another);
  EXPECT_NEAR(volume.node(0).mean, expected / std::numbers::pi, 1e-2);
}

/// Light is linear in its sources, and walls that reflect less send less.
TEST(Radiosity, IsLinearInTheDirectLightAndNeverMoreThanArrives) {
  const Solved room;
  std::mt19937 random(4);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<float> albedo(room.points.size());
  for (float& a : albedo) a = 0.9f * unit(random);
  const Patches patches = PatchesIn(room, albedo);
  const std::size_t count = patches.places.size();
  std::vector<float> a(count), b(count), both(count);
  for (std::size_t i = 0; i < count; ++i) {
    a[i] = 5 * unit(random);
    b[i] = 3 * unit(random);
    both[i] = 2 * a[i] + b[i];
  }
  const auto solve = [&](const std::vector<float>& direct) {
    SolveWatch watch({}, {});
    return SolveRadiosity(room.instant, room.grid, patches, direct, {}, &watch).indirect;
  };
  const std::vector<float> of_a = solve(a), of_b = solve(b), of_both = solve(both);
  const float brightest = std::ranges::max(a), most = std::ranges::max(patches.albedo);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(of_both[i], 2 * of_a[i] + of_b[i], 1e-4f * (1 + of_both[i]));
    EXPECT_LE(of_a[i], brightest * most / (1 - most) + 1e-4f);
    EXPECT_GE(of_a[i], 0);
  }
}

TEST(Patches, ArePartsOfThePointsWithTheirMeanAlbedo) {
  const Solved room;
  std::vector<float> albedo(room.points.size());
  for (std::size_t i = 0; i < albedo.size(); ++i) albedo[i] = 0.1f * static_cast<float>(i % 7);
  const Patches patches = PatchesIn(room, albedo);
  ASSERT_EQ(patches.of_point.size(), room.points.size());
  EXPECT_LT(patches.places.size(), room.points.size()) << "neighbours share a patch";
  std::vector<double> sum(patches.places.size()), members(patches.places.size());
  for (std::size_t i = 0; i < room.points.size(); ++i) {
    const std::uint32_t patch = patches.of_point[i];
    ASSERT_LT(patch, patches.places.size());
    sum[patch] += albedo[i];
    members[patch] += 1;
    const SurfacePoint& place = patches.places[patch];
    EXPECT_LT((place.position - room.points[i].position).norm(), 0.33f * std::sqrt(3.0f));
    EXPECT_GT(place.normal.dot(room.points[i].normal), 0.9f) << "no patch goes round a corner";
  }
  for (std::size_t i = 0; i < sum.size(); ++i) {
    ASSERT_GT(members[i], 0);
    EXPECT_NEAR(patches.albedo[i], sum[i] / members[i], 1e-5);
  }
}

TEST(Patches, MeansOfOneValueAreThatValueAndMiddlesAreTheirOwnPoints) {
  const Solved room;
  Patches patches = PatchesIn(room, std::vector<float>(room.points.size(), 0.5f));
  const LightGrid fine = MakeLightGrid(room.world.statics().mesh, 0.1f);
  const auto fine_points =
      LocatePoints(fine, room.world.statics().mesh, room.world.statics().mesh.positions,
                   room.world.statics().mesh.normals);
  const std::vector<std::uint32_t> patch_of = PatchesOf(fine, room.grid, patches);
  const std::vector<float> means = MeanByPatch(fine, std::vector<float>(fine.points.size(), 2.5f),
                                               patch_of, patches.places.size());
  for (std::uint32_t i = 0; i < means.size(); ++i) {
    const bool has_points = std::ranges::count(patch_of, i) > 0;
    EXPECT_NEAR(means[i], has_points ? 2.5f : 0, 1e-4f) << i;
  }
  CentrePatches(fine_points, patch_of, &patches);
  for (std::size_t i = 0; i < patches.places.size(); ++i) {
    const bool own = std::ranges::any_of(
        std::views::iota(std::size_t{0}, fine_points.size()), [&](std::size_t k) {
          return patch_of[k] == i && fine_points[k].position == patches.places[i].position;
        });
    EXPECT_EQ(own, std::ranges::count(patch_of, static_cast<std::uint32_t>(i)) > 0) << i;
  }
}

/// In the same furnace the air sees ρ (E + I) / π from everywhere, and nothing leans to a side.
TEST(FillVolume, FreeSpaceSeesTheWallsAndTheInsideOfThingsDoesNotCount) {
  const Solved room;
  const float albedo = 0.5f;
  const Patches patches = PatchesIn(room, std::vector<float>(room.points.size(), albedo));
  const Radiosity even{std::vector<float>(patches.places.size(), 8.0f),
                       std::vector<float>(patches.places.size(), 4.0f)};
  LightVolume volume(Eigen::AlignedBox3f(Vector3f(0.5f, 0.5f, 0.5f), Vector3f(3.5f, 2.5f, 2)),
                     0.5f);
  SolveWatch watch({}, {});
  FillVolume(room.instant, room.grid, room.world.statics().mesh, patches, even, 256, &volume,
             &watch);
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const Vector3f at = volume.Position(i);
    const bool inside = (at.array() > 0).all() && at.x() < 4 && at.y() < 3 && at.z() < 2.5f;
    if (!inside) continue;
    EXPECT_NEAR(volume.node(i).mean, albedo * 12 / std::numbers::pi, 1e-3) << at.transpose();
    EXPECT_LT(volume.node(i).slope.norm(), 0.15f);
    EXPECT_EQ(volume.node(i).weight, 1);
  }
  // Outside, close to a wall, half of all ways meet its back.
  LightVolume close(Eigen::AlignedBox3f(Vector3f(4.01f, 1, 1), Vector3f(4.02f, 1.01f, 1.01f)),
                    0.01f);
  SolveWatch another({}, {});
  FillVolume(room.instant, room.grid, room.world.statics().mesh, patches, even, 256, &close,
             &another);
  EXPECT_EQ(close.node(0).mean, 0);
  EXPECT_EQ(close.node(0).weight, 0);
}

}  // namespace
}  // namespace aisle::sim
