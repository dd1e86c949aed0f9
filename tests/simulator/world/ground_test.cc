#include "simulator/world/ground.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/scene/load.h"
#include "simulator/scene/vary.h"
#include "simulator/world/build.h"
#include "simulator/world/check_models.h"
#include "simulator/world/plan.h"
#include "tests/simulator/world/mesh_items.h"

namespace aisle::sim {
namespace {

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";

Scene DriveScene() {
  return ParseScene(
      "about: A hall to drive in.\n"
      "rig: {start: [0, 0], steps: [{go: [[4, 0], [4, 3]], speed_mps: 0.8}, {wait_s: 1},\n"
      "  {turn_to_deg: 180}, {go: [[2, 3]], speed_mps: 0.5}]}\n"
      "drive: {height_m: 1.0}\n"
      "hall: {from: [-3, -6], to: [13, 7]}\nlights: [{height_m: 5}]\n"
      "stacks: [{at: [8, -3], heading_deg: 30}]\ncolumns: [{at: [7, 1]}]\n"
      "markings: [{from: [0, -1], to: [4, -1]}]\n"
      "mezzanines: [{from: [-2, -5.5], to: [5, -2], height_m: 2.8}]\n"
      "people:\n  - {name: pusher, start: [8, 4], steps: [{go: [[10, 4]]}]}\n"
      "vehicles:\n"
      "  - {name: truck, start: [9, 5.5], heading_deg: 180, steps: [{go: [[6, 5.5]]}]}\n"
      "  - {name: jack, model: pallet_jack, start: [8, 4], pushed_by: pusher}\n",
      "drive.yaml");
}

struct Built {
  Scene scene;
  World world;
  Ground ground;
};

const Built& TheBuilt() {
  static const Built built = [] {
    const Scene scene = Seeded(DriveScene(), 1);
    World world = BuildWorld(DriveScene(), kAssets, 1);
    Ground ground(scene, world);
    return Built{scene, std::move(world), std::move(ground)};
  }();
  return built;
}

double Cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool Inside(const std::vector<Eigen::Vector2d>& outline, const Eigen::Vector2d& point,
            double slack_m) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d edge = outline[(i + 1) % outline.size()] - outline[i];
    if (Cross(edge.normalized(), point - outline[i]) < -slack_m) return false;
  }
  return true;
}

TEST(GroundThings, AreConvexAndCounterClockwise) {
  ASSERT_FALSE(TheBuilt().ground.things().empty());
  for (const GroundThing& thing : TheBuilt().ground.things()) {
    const auto& outline = thing.outline;
    ASSERT_GE(outline.size(), 3u) << thing.name;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Eigen::Vector2d &a = outline[i], &b = outline[(i + 1) % outline.size()],
                            &c = outline[(i + 2) % outline.size()];
      EXPECT_GT(Cross(b - a, c - b), -1e-6) << thing.name;
    }
  }
}

/// A vehicle that keeps off the outlines touches no triangle it could reach.
TEST(GroundThings, CoverEveryTriangleAVehicleCanTouchAndNoFloor) {
  const auto& [scene, world, ground] = TheBuilt();
  const TriangleMesh& mesh = world.statics().mesh;
  int covered = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Instance& instance = world.instances()[world.statics().instances[i]];
    if (instance.object_class != ObjectClass::kGoods &&
        instance.object_class != ObjectClass::kColumn &&
        instance.object_class != ObjectClass::kFurniture) {
      continue;
    }
    float low = 1e9f, high = -1e9f;
    for (const std::uint32_t v : mesh.triangles[i]) {
      low = std::min(low, mesh.positions[v].z());
      high = std::max(high, mesh.positions[v].z());
    }
    if (low >= 1.0f || high <= 0.031f) continue;
    for (const std::uint32_t v : mesh.triangles[i]) {
      const Eigen::Vector2d at = mesh.positions[v].head<2>().cast<double>();
      ++covered;
      EXPECT_TRUE(std::ranges::any_of(ground.things(),
                                      [&](const GroundThing& thing) {
                                        return thing.name == instance.name &&
                                               Inside(thing.outline, at, 1e-4);
                                      }))
          << instance.name << " at " << at.transpose();
    }
  }
  EXPECT_GT(covered, 100);
  for (const GroundThing& thing : ground.things()) {
    EXPECT_NE(thing.object_class, "floor") << thing.name;
  }
}

TEST(GroundThings, OneDrivesUnderAMezzanineBetweenItsColumns) {
  int columns = 0;
  for (const GroundThing& thing : TheBuilt().ground.things()) {
    if (thing.name != "mezzanine_0") continue;
    ++columns;
    EXPECT_FALSE(Inside(thing.outline, {1.5, -3.75}, 0)) << "the middle of its floor is free";
  }
  EXPECT_GE(columns, 4);
}

TEST(GroundWay, GoesOnFromPointToPointAsItsHeadingSaysAndNoFasterThanAsked) {
  const std::vector<WayLeg>& way = TheBuilt().ground.way();
  Eigen::Vector2d at = TheBuilt().ground.start().position;
  double cruise = 0.8;
  std::vector<WayLeg::Kind> kinds;
  for (const WayLeg& leg : way) {
    kinds.push_back(leg.kind);
    if (leg.kind != WayLeg::Kind::kDrive) continue;
    EXPECT_LT((leg.points.front().position - at).norm(), 1e-9);
    for (std::size_t i = 1; i < leg.points.size(); ++i) {
      const WayPoint &a = leg.points[i - 1], &b = leg.points[i];
      const Eigen::Vector2d step = b.position - a.position;
      const double way_m = b.distance_m - a.distance_m;
      EXPECT_LE(way_m, 0.02 + 1e-9);
      EXPECT_NEAR(step.norm(), way_m, 1e-4);
      const double middle = (a.heading_rad + b.heading_rad) / 2;
      const Eigen::Vector2d ahead(std::cos(middle), std::sin(middle));
      EXPECT_GT(ahead.dot(step), (1 - 1e-4) * step.norm());
      EXPECT_NEAR(b.heading_rad - a.heading_rad,
                  way_m * (a.curvature_per_m + b.curvature_per_m) / 2, 0.02);
      EXPECT_LE(a.speed_mps, cruise + 1e-9);
    }
    at = leg.points.back().position;
    cruise = 0.5;
  }
  EXPECT_LT((at - Eigen::Vector2d(2, 3)).norm(), 1e-6) << "the route's last point";
  using Kind = WayLeg::Kind;
  EXPECT_THAT(kinds, testing::ElementsAre(Kind::kDrive, Kind::kPause, Kind::kTurn, Kind::kDrive));
}

/// Nor faster than the wheel can be steered, also where two corners leave it little room.
TEST(GroundWay, IsNoFasterThanItsWheelFollows) {
  for (const double steering_deg_s : {12.0, 60.0}) {
    const Scene scene = ParseScene(
        fmt::format("about: Bends.\n"
                    "rig: {{start: [0, 0], steps: [{{go: [[6, 0], [6, 5], [3.8, 5], [3.8, 9]],\n"
                    "  speed_mps: 0.9, corner_radius_m: 0.5}}]}}\n"
                    "drive: {{kind: tricycle, steering_rate_deg_s: {}}}\n"
                    "hall: {{from: [-3, -6], to: [13, 12]}}\nlights: [{{height_m: 5}}]\n",
                    steering_deg_s),
        "bends.yaml");
    const Ground ground(scene, BuildWorld(scene, kAssets, 1));
    const DriveSpec& drive = scene.drive;
    for (const WayLeg& leg : ground.way()) {
      for (std::size_t i = 1; i < leg.points.size(); ++i) {
        const WayPoint &a = leg.points[i - 1], &b = leg.points[i];
        const double steered = std::atan(drive.wheelbase_m * b.curvature_per_m) -
                               std::atan(drive.wheelbase_m * a.curvature_per_m);
        const double rate =
            std::abs(steered) / (b.distance_m - a.distance_m) * std::min(a.speed_mps, b.speed_mps);
        EXPECT_LE(rate, drive.steering_rate_rad_s * (1 + 1e-6)) << b.distance_m;
      }
    }
  }
}

TEST(GroundActors, AreWhereTheWorldShowsThemAtEveryTime) {
  const auto& [scene, world, ground] = TheBuilt();
  ASSERT_EQ(ground.actors().size(), 3u);
  for (const std::int64_t time_ns : {0L, 700'000'000L, 2'300'000'000L, 9'000'000'000L}) {
    const Snapshot snapshot = world.At(time_ns);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Isometry3d& shown = snapshot.movers[i].T_world_object;
      const GroundPose pose = ground.ActorAt(i, time_ns);
      EXPECT_LT((pose.position - shown.translation().head<2>()).norm(), 1e-6) << i;
      EXPECT_NEAR(std::cos(pose.heading_rad), shown.linear()(0, 0), 1e-9) << i;
      EXPECT_NEAR(std::sin(pose.heading_rad), shown.linear()(1, 0), 1e-9) << i;
    }
  }
  EXPECT_EQ(ground.actors()[2].goes_with, 0) << "whose clock it keeps";
  EXPECT_EQ(ground.actors()[1].goes_with, -1);
  EXPECT_THAT(ground.actors()[2].object_class, "pallet_jack");
}

TEST(GroundActors, TrailersKeepTheirTractorsClock) {
  const Scene scene = ParseScene(
      "about: A train.\n"
      "rig: {start: [0, -3], steps: [{go: [[4, -3]], speed_mps: 0.8}]}\n"
      "drive: {height_m: 1.0}\n"
      "hall: {from: [-6, -6], to: [14, 7]}\nlights: [{height_m: 5}]\n"
      "people:\n  - {name: walker, start: [8, 5], steps: [{go: [[10, 5]]}]}\n"
      "vehicles:\n"
      "  - {name: tractor, model: tow_tractor, start: [2, 2], yields: true,\n"
      "     steps: [{go: [[8, 2]], speed_mps: 1}]}\n"
      "  - {name: trailer, model: tow_trailer, start: [0.22, 2], towed_by: tractor, behind_m: "
      "1.78}\n",
      "train.yaml");
  const Ground ground(Seeded(scene, 1), BuildWorld(scene, kAssets, 1));
  ASSERT_EQ(ground.actors().size(), 3u);
  EXPECT_TRUE(ground.actors()[1].yields);
  EXPECT_EQ(ground.actors()[2].goes_with, 1);
}

/// Every place of the plan shows what is there: x to the right, y up.
TEST(DrawPlan, ShowsThingsWhereTheyStandAndTheWayOfTheRig) {
  constexpr int kWidth_px = 600;
  const PlanPicture plan = DrawPlan(TheBuilt().world, 2'000'000'000, kWidth_px);
  EXPECT_EQ(plan.picture.cols, kWidth_px);
  const auto at = [&](double x, double y) {
    return plan.picture(cvRound(plan.origin_px.y - plan.px_per_m * y),
                        cvRound(plan.origin_px.x + plan.px_per_m * x));
  };
  const auto rig_at = [&](std::int64_t stamp_ns) {
    const Eigen::Vector3d rig = TheBuilt().world.PlannedRigPose(stamp_ns).translation();
    return at(rig.x(), rig.y());
  };
  const cv::Vec3b floor = at(2, 5), way = rig_at(0), goods = at(8, -3);
  EXPECT_EQ(at(10, -5), floor);
  EXPECT_NE(goods, floor);
  EXPECT_NE(at(7, 1), floor) << "a column";
  EXPECT_NE(at(7, 1), goods);
  EXPECT_GT(way[2], way[0] + 100) << "the rig's way is red";
  EXPECT_EQ(rig_at(1'500'000'000), way);
  EXPECT_EQ(at(-1.5, 0), floor);
  const cv::Vec3b actor = at(8.5, 5.5);
  EXPECT_NE(actor, floor);
  EXPECT_EQ(at(2, -4), floor) << "what is higher than a door is not drawn";
}

TEST(CheckModels, NamesEveryUnknownModelWithItsPlaceAndReadsNone) {
  Scene scene = DriveScene();
  const AssetLibrary assets(kAssets);
  EXPECT_TRUE(CheckModels(scene, assets).empty());
  scene.people[0].model = "nobody";
  scene.vehicles[1].model = "hovercraft";
  const std::vector<std::string> messages = CheckModels(scene, assets);
  ASSERT_EQ(messages.size(), 2u);
  EXPECT_THAT(
      messages[0],
      testing::AllOf(testing::StartsWith("drive.yaml:"), testing::HasSubstr("model of pusher"),
                     testing::HasSubstr("'nobody'"), testing::HasSubstr("worker_anton")));
  EXPECT_THAT(messages[1], testing::HasSubstr("there is no model 'hovercraft'"));
}

TEST(AssetLibrary, EveryPictureOfAnAtlasLiesInIt) {
  const AssetLibrary assets(kAssets);
  for (int i = 0; i < 12; ++i) {
    const auto [left, top, width, height] = assets.Rect("cartons", fmt::format("side_{}", i));
    EXPECT_GE(std::min(left, top), 0);
    EXPECT_LE(std::max(left + width, top + height), 1);
    EXPECT_GT(std::min(width, height), 0);
  }
  EXPECT_THROW(assets.Rect("cartons", "side_99"), std::runtime_error);
  const std::vector<std::string> names = assets.PeopleNames();
  EXPECT_TRUE(std::ranges::is_sorted(names));
  for (const std::string& name : names) EXPECT_NO_THROW(assets.Person(name));
  EXPECT_THROW(AssetLibrary("/nowhere"), std::runtime_error);
}

}  // namespace
}  // namespace aisle::sim
