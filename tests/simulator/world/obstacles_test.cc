#include "simulator/scene/obstacles.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "simulator/scene/prop.h"
#include "simulator/world/assets.h"
#include "simulator/world/fittings.h"
#include "simulator/world/props.h"
#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3f;

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";
constexpr float kShin_m = 0.07f, kHead_m = 1.7f;
constexpr double kRound_m = 0.05;  ///< as near as a footprint is to what is drawn

/// Where the triangles of an instance are between shin and head height, on the floor.
std::vector<Vector2d> TouchedBy(const WorldParts& parts, const std::string& name) {
  std::vector<Vector2d> points;
  const TriangleMesh& mesh = parts.statics.mesh;
  for (const std::size_t i : test::TrianglesOf(parts.instances, parts.statics, name)) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3f from = mesh.positions[mesh.triangles[i][k]];
      const Vector3f way = mesh.positions[mesh.triangles[i][(k + 1) % 3]] - from;
      float first = 0, last = 1;
      for (const float sign : {1.0f, -1.0f}) {  // above the shin, below the head
        const float inside = sign * (from.z() - (sign > 0 ? kShin_m : kHead_m));
        const float rise = sign * way.z();
        if (rise > 0) first = std::max(first, -inside / rise);
        if (rise < 0) last = std::min(last, inside / -rise);
        if (rise == 0 && inside < 0) last = -1;
      }
      if (first > last) continue;
      for (const float share : {first, last}) {
        points.emplace_back((from + share * way).head<2>().cast<double>());
      }
    }
  }
  return points;
}

/// All that is there lies in the rectangle, and the rectangle is not much larger than that.
void ExpectHolds(const Obstacle& obstacle, const std::vector<Vector2d>& points,
                 const std::string& what, double spare_m = 0.15) {
  ASSERT_FALSE(points.empty()) << what;
  Eigen::AlignedBox2d box;
  for (const Vector2d& point : points) {
    EXPECT_LE(obstacle.DistanceTo(point), kRound_m) << what << " at " << point.transpose();
    box.extend(
        Eigen::Vector2d(Eigen::Rotation2Dd(-obstacle.heading_rad) * (point - obstacle.center)));
  }
  EXPECT_LE((obstacle.half - box.max()).maxCoeff(), spare_m) << what;
  EXPECT_LE((obstacle.half + box.min()).maxCoeff(), spare_m) << what;
}

TEST(Obstacles, HoldWhatFixturesAreBelowHeadHeight) {
  struct Kind {
    FixtureKind kind;
    const char* name;
  };
  constexpr std::array<Kind, 9> kKinds = {{{FixtureKind::kPanelWall, "panel_wall"},
                                           {FixtureKind::kLathe, "lathe"},
                                           {FixtureKind::kMill, "mill"},
                                           {FixtureKind::kDrill, "drill"},
                                           {FixtureKind::kBench, "bench"},
                                           {FixtureKind::kToolWall, "tool_wall"},
                                           {FixtureKind::kToolCart, "tool_cart"},
                                           {FixtureKind::kLocker, "locker"},
                                           {FixtureKind::kGasBottles, "gas_bottles"}}};
  Scene scene;
  for (const auto& [kind, name] : kKinds) {
    for (const double length : {0.0, 1.2, 3.0}) {
      FixtureSpec fixture;
      fixture.kind = kind;
      fixture.at = Vector2d(5, -3);
      fixture.heading_rad = 0.4 + static_cast<double>(scene.fixtures.size());
      fixture.length_m = length;
      scene.fixtures.push_back(fixture);
    }
  }
  const std::vector<Obstacle> obstacles = ObstaclesOf(scene);
  ASSERT_EQ(obstacles.size(), scene.fixtures.size());
  const Palette palette;
  const Fittings fittings;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    WorldParts parts;
    WorldBuilder builder(&parts);
    AddFixtures(scene, {palette, fittings}, seed, &builder);
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
      const std::string name = fmt::format("{}_{}", kKinds[i / 3].name, i);
      ExpectHolds(obstacles[i], TouchedBy(parts, name), fmt::format("{}, seed {}", name, seed));
    }
  }
}

/// Every model of assets/kit and assets/street, as it is there.
std::vector<std::string> Models() {
  std::vector<std::string> names;
  for (const char* folder : {"kit", "street"}) {
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(kAssets) / folder)) {
      if (entry.path().extension() == ".glb") names.push_back(entry.path().stem().string());
    }
  }
  return names;
}

TEST(Obstacles, HoldWhatPropsAreBelowHeadHeight) {
  Scene scene;
  for (const std::string& model : Models()) {
    PropSpec prop;
    prop.model = model;
    prop.at = {3, 4};
    prop.heading_rad = 0.3 + static_cast<double>(scene.props.size());
    scene.props.push_back(prop);
  }
  const std::vector<Obstacle> obstacles = ObstaclesOf(scene);
  ASSERT_EQ(obstacles.size(), scene.props.size()) << "a model has no footprint";
  WorldParts parts;
  WorldBuilder builder(&parts);
  AssetLibrary assets(kAssets);
  Wardrobe wardrobe(&parts);
  AddProps(scene, 1, &assets, &wardrobe, &builder);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const std::string& model = scene.props[i].model;
    ExpectHolds(obstacles[i], TouchedBy(parts, fmt::format("{}_{}_0", model, i)), model, kRound_m);
  }
}

TEST(Obstacles, AreAllPiecesOfARowAndNoneAboveHeads) {
  Scene scene;
  scene.props.resize(2);
  for (PropSpec& prop : scene.props) {
    prop.model = "drum";
    prop.at = {1, 2};
    prop.to = Vector2d(4, 2);
    prop.every_m = 1.5;
  }
  scene.props[1].above_m = 2.5;
  const std::vector<Obstacle> obstacles = ObstaclesOf(scene);
  ASSERT_EQ(obstacles.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(obstacles[i].name, "props[0]");
    const Vector2d middle(1 + 1.5 * static_cast<double>(i), 2);
    EXPECT_LT((obstacles[i].center - middle).norm(), 1e-9) << i;
  }
}

TEST(Obstacles, AreAMezzaninesColumnsAndStair) {
  Scene scene;
  scene.mezzanines.resize(2);
  scene.mezzanines[0].from = {0, 0};
  scene.mezzanines[0].to = {9, 6};
  scene.mezzanines[1].from = {20, -3};
  scene.mezzanines[1].to = {22, 1.5};
  scene.mezzanines[1].height_m = 4;
  WorldParts parts;
  WorldBuilder builder(&parts);
  AddMezzanines(scene, {}, 1, &builder);
  const std::vector<Obstacle> obstacles = ObstaclesOf(scene);
  EXPECT_EQ(obstacles.size(), (4u * 3 + 1) + (2u * 3 + 1));
  std::vector<int> hit(obstacles.size());
  for (const char* name : {"mezzanine_0", "mezzanine_1"}) {
    for (const Vector2d& point : TouchedBy(parts, name)) {
      bool held = false;
      for (std::size_t i = 0; i < obstacles.size(); ++i) {
        if (obstacles[i].DistanceTo(point) > kRound_m) continue;
        held = true;
        ++hit[i];
      }
      EXPECT_TRUE(held) << name << " at " << point.transpose();
    }
  }
  for (std::size_t i = 0; i < hit.size(); ++i) EXPECT_GT(hit[i], 0) << obstacles[i].name;
}

}  // namespace
}  // namespace aisle::sim
