#include "simulator/world/fittings.h"

#include <gtest/gtest.h>

#include "simulator/scene/fixture.h"
#include "simulator/scene/obstacles.h"
#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using test::Box;

/// The scene's fixtures, or what lies about in it, and nothing else.
WorldParts Drawn(const Scene& scene, std::uint64_t seed) {
  const Palette palette;
  const Fittings fittings;
  WorldParts parts;
  WorldBuilder builder(&parts);
  AddFixtures(scene, {palette, fittings}, seed, &builder);
  AddClutter(scene, {palette, fittings}, seed, &builder);
  return parts;
}

Scene With(FixtureKind kind, double length_m) {
  Scene scene;
  scene.fixtures.resize(1);
  scene.fixtures[0].kind = kind;
  scene.fixtures[0].length_m = length_m;
  return scene;
}

/// Boxes around the parts that stand on a level.
std::vector<Box> On(const std::vector<Box>& items, float z_m) {
  std::vector<Box> on;
  for (const Box& item : items) {
    if (std::abs(item.min().z() - z_m) < 0.012f) on.push_back(item);
  }
  return on;
}

bool Overlap(const Box& one, const Box& other) {
  return (one.intersection(other).sizes().head<2>().array() > 0.002f).all();
}

TEST(Worktops, ThingsLieOnThemOneBesideTheOther) {
  for (const FixtureKind kind : {FixtureKind::kBench, FixtureKind::kToolCart}) {
    std::size_t things = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const Scene scene = With(kind, 0);
      const Vector2f half = SizeOf(scene.fixtures[0]).head<2>().cast<float>() / 2;
      const float top = static_cast<float>(SizeOf(scene.fixtures[0]).z());
      const std::vector<Box> lying = On(test::ItemsOf(Drawn(scene, seed).statics.mesh), top);
      things += lying.size();
      for (std::size_t i = 0; i < lying.size(); ++i) {
        EXPECT_LE((lying[i].max().head<2>() - half).maxCoeff(), 0.01f) << seed;
        EXPECT_GE((lying[i].min().head<2>() + half).minCoeff(), -0.01f) << seed;
        for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(Overlap(lying[i], lying[k])) << seed;
      }
    }
    EXPECT_GT(things, 60u * 3);
  }
}

TEST(Bench, TotesStandOnItsShelfBesideTheDrawers) {
  for (const double length : {1.0, 1.2, 1.6, 2.0, 3.0}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const std::vector<Box> items =
          test::ItemsOf(Drawn(With(FixtureKind::kBench, length), seed).statics.mesh);
      const std::vector<Box> totes = On(items, 0.215f);
      if (length >= 2) {
        EXPECT_EQ(totes.size(), 3u);
      }
      for (const Box& tote : totes) {
        EXPECT_LE(tote.max().y(), length / 2) << length;
        EXPECT_GE(tote.min().y(), -length / 2) << length;
        for (const Box& drawers : On(items, 0.24f)) {
          EXPECT_FALSE(Overlap(tote, drawers)) << length << ", seed " << seed;
        }
      }
    }
  }
}

Scene Cluttered(const Vector2d& size) {
  Scene scene;
  scene.hall.from = {-3, 2};
  scene.hall.to = scene.hall.from + size;
  scene.hall.clutter = 1;
  scene.rig.route.plan.start = scene.hall.from + size / 2;
  return scene;
}

/// Boxes around what stands at the walls, each thing one.
std::vector<Box> AtWalls(const WorldParts& parts) {
  std::map<std::uint16_t, Box> boxes;
  const TriangleMesh& mesh = parts.statics.mesh;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::uint16_t thing = parts.statics.instances[i];
    if (!parts.instances[thing].name.starts_with("left_standing")) continue;
    for (const std::uint32_t v : mesh.triangles[i]) boxes[thing].extend(mesh.positions[v]);
  }
  std::vector<Box> all;
  for (const auto& [thing, box] : boxes) all.push_back(box);
  return all;
}

TEST(Clutter, StandsInTheHallAndNotInItself) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = Cluttered({12, 9});
    const std::vector<Box> things = AtWalls(Drawn(scene, seed));
    for (std::size_t i = 0; i < things.size(); ++i) {
      const Vector2d low = things[i].min().head<2>().cast<double>() - scene.hall.from;
      const Vector2d high = scene.hall.to - things[i].max().head<2>().cast<double>();
      EXPECT_GT(std::min(low.minCoeff(), high.minCoeff()), -0.02) << seed;
      for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(Overlap(things[i], things[k])) << seed;
    }
  }
}

TEST(Clutter, StandsBesidePropsAndColumns) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Scene scene = Cluttered({12, 9});
    scene.props.resize(1);
    scene.props[0].model = "roll_cage";
    scene.props[0].at = scene.hall.from + Vector2d(1, 0.5);
    scene.props[0].to = scene.hall.from + Vector2d(11, 0.5);
    scene.props[0].every_m = 2.5;
    scene.mezzanines.resize(1);
    scene.mezzanines[0].from = scene.hall.from + Vector2d(0.2, 3);
    scene.mezzanines[0].to = scene.hall.from + Vector2d(5, 8.8);
    const std::vector<Obstacle> obstacles = ObstaclesOf(scene);
    for (const Box& thing : AtWalls(Drawn(scene, seed))) {
      const Vector2d middle = thing.center().head<2>().cast<double>();
      for (const Obstacle& obstacle : obstacles) {
        EXPECT_GT(obstacle.DistanceTo(middle), 0.15) << obstacle.name << ", seed " << seed;
      }
    }
  }
}

TEST(Clutter, IsAsDenseAtAShortWallAsAtALongOne) {
  int at_short = 0, at_long = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = Cluttered({10, 60});
    for (const Box& thing : AtWalls(Drawn(scene, seed))) {
      const double y = thing.center().y() - scene.hall.from.y();
      ++(y < 1 || y > 59 ? at_short : at_long);
    }
  }
  const double short_per_m = at_short / 20.0 / 20, long_per_m = at_long / 20.0 / 116;
  EXPECT_GT(long_per_m, 0.1);
  EXPECT_NEAR(short_per_m / long_per_m, 1, 0.35);
}

}  // namespace
}  // namespace aisle::sim
