#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "simulator/mesh/import.h"
#include "simulator/scene/footprint.h"
#include "simulator/scene/load.h"
#include "simulator/scene/obstacles.h"
#include "simulator/world/build.h"
#include "tests/simulator/world/mechanism_scene.h"

namespace aisle::sim {
namespace {

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";

/// Heights in which something would be run into: from a kerb's to a tall person's.
bool IsInTheWay(const Eigen::Vector3f& point) { return point.z() > 0.07f && point.z() < 1.7f; }

/// What is checked of a vehicle is what is drawn of it: as long and as broad, to what the line with
/// its radius leaves out of corners and mirrors.
TEST(Outlines, FootprintsAreAsLongAndBroadAsVehiclesAreDrawn) {
  for (const std::string name :
       {"agv", "bus", "car_dark", "car_van", "cyclist", "forklift_driver", "order_picker",
        "pallet_jack", "reach_truck", "scrubber", "tow_tractor", "tow_trailer"}) {
    const Footprint footprint = FootprintOf(name);
    const float drawbar_m = name == "tow_trailer" ? 0.1f : 0;  // it lies under its tractor
    double front = -100, back = 100, broad = 0;
    for (const Eigen::Vector3f& point :
         ImportModel(fmt::format("{}/vehicles/{}.glb", kAssets, name)).mesh.positions) {
      if (!IsInTheWay(point) || std::abs(point.y()) < drawbar_m) continue;
      front = std::max<double>(front, point.x());
      back = std::min<double>(back, point.x());
      broad = std::max<double>(broad, std::abs(point.y()));
    }
    EXPECT_NEAR(front, footprint.front_m + footprint.radius_m, 0.2) << name;
    EXPECT_NEAR(back, footprint.back_m - footprint.radius_m, 0.2) << name;
    EXPECT_GT(broad, footprint.radius_m - 0.05) << name;
    EXPECT_LT(broad, footprint.radius_m + 0.3) << name << ": mirrors, handlebars, brushes";
  }
}

/// Obstacles are rectangles around things as they are drawn, to the collar of a column, the
/// guards at a rack's posts and the handles of a lathe.
TEST(Outlines, ObstaclesAreWhereThingsStand) {
  const Scene scene = ParseScene(kHall + R"(stacks: [{at: [5, 1], heading_deg: 35}]
columns: [{at: [9, -2], size_m: 0.6}]
racks: [{from: [12, 1], bays: 2, heading_deg: 35}]
fixtures: [{kind: lathe, at: [1, -4], heading_deg: 35}]
)",
                                 "s.yaml");
  const World world = BuildWorld(scene, kAssets, 1);
  const StaticWorld& statics = world.statics();
  const std::map<std::string, std::pair<ObjectClass, double>> expected = {
      {"stacks[0]", {ObjectClass::kGoods, 0.02}},
      {"columns[0]", {ObjectClass::kColumn, 0.07}},
      {"racks[0]", {ObjectClass::kRack, 0.1}},
      {"fixtures[0]", {ObjectClass::kFurniture, 0.3}}};
  const std::vector<Obstacle> obstacles = ObstaclesOf(scene);
  ASSERT_EQ(obstacles.size(), expected.size());
  for (const Obstacle& obstacle : obstacles) {
    const auto& [object_class, slack_m] = expected.at(obstacle.name);
    Eigen::AlignedBox2d box;  // in the obstacle's frame
    for (std::size_t i = 0; i < statics.instances.size(); ++i) {
      if (world.instances()[statics.instances[i]].object_class != object_class) continue;
      for (const std::uint32_t vertex : statics.mesh.triangles[i]) {
        const Eigen::Vector3f& point = statics.mesh.positions[vertex];
        const Eigen::Vector2d off = point.head<2>().cast<double>() - obstacle.center;
        if (!IsInTheWay(point) || off.norm() > 4) continue;  // the rack's goods
        box.extend(Eigen::Rotation2Dd(-obstacle.heading_rad) * off);
      }
    }
    EXPECT_LT((box.max() - obstacle.half).cwiseAbs().maxCoeff(), slack_m) << obstacle.name;
    EXPECT_LT((box.min() + obstacle.half).cwiseAbs().maxCoeff(), slack_m) << obstacle.name;
  }
}

/// A prop is its model, turned by its heading about its place.
TEST(Outlines, PropsAreTurnedByTheirHeading) {
  const Scene scene =
      ParseScene(kHall + "props: [{model: guard_rail, at: [5, 1], heading_deg: 35}]\n", "s.yaml");
  const World world = BuildWorld(scene, kAssets, 1);
  const StaticWorld& statics = world.statics();
  Eigen::AlignedBox2f drawn, model;
  for (std::size_t i = 0; i < statics.instances.size(); ++i) {
    if (!world.instances()[statics.instances[i]].name.starts_with("guard_rail")) continue;
    for (const std::uint32_t vertex : statics.mesh.triangles[i]) {
      const Eigen::Vector2f off = statics.mesh.positions[vertex].head<2>() - Eigen::Vector2f(5, 1);
      drawn.extend(Eigen::Rotation2Df(-35 * std::numbers::pi_v<float> / 180) * off);
    }
  }
  for (const Eigen::Vector3f& point : ImportModel(kAssets + "/kit/guard_rail.glb").mesh.positions) {
    model.extend(point.head<2>());
  }
  EXPECT_GT(model.sizes().maxCoeff(), 3 * model.sizes().minCoeff()) << "it is long";
  EXPECT_TRUE(drawn.isApprox(model, 1e-4f));
}

}  // namespace
}  // namespace aisle::sim
