#include "simulator/world/world.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/simulator/test_world.h"

namespace aisle::sim {
namespace {

/// One triangle under one light; a mover of one more.
WorldParts Small() {
  WorldParts parts;
  parts.instances.push_back({"floor", ObjectClass::kFloor, false});
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 3}, {1, 0, 0}, {0, -1, 0}, 1});
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.normals.assign(3, Eigen::Vector3f::UnitZ());
  mesh.uvs.assign(3, Eigen::Vector2f::Zero());
  mesh.triangles = {{0, 1, 2}};
  mesh.materials = {0};
  parts.statics = {mesh, {1}};
  parts.mover_meshes = {mesh};
  parts.at = [](std::int64_t stamp_ns) {
    return Snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
  };
  return parts;
}

struct Broken {
  const char* what;  ///< that the message must say
  std::function<void(WorldParts*)> breaks;
};

/// Each rule broken alone is refused, and by its own name; what stands in nobody's way passes.
TEST(World, RefusesPartsThatDoNotFitTogetherAndSaysWhich) {
  EXPECT_NO_THROW(World{Small()});
  const std::vector<Broken> all = {
      {"there is no light", [](WorldParts* p) { p->lights.clear(); }},
      {"static world: 3 positions but 2 normals",
       [](WorldParts* p) { p->statics.mesh.normals.pop_back(); }},
      {"static world: 3 positions but 3 normals and 4 uvs",
       [](WorldParts* p) { p->statics.mesh.uvs.emplace_back(0, 0); }},
      {"static world: 1 triangles but 0 material indices",
       [](WorldParts* p) { p->statics.mesh.materials.clear(); }},
      {"static world: a vertex is not finite",
       [](WorldParts* p) { p->statics.mesh.positions[1].y() = std::nanf(""); }},
      {"static world: a triangle names vertex 3, there are 3",
       [](WorldParts* p) { p->statics.mesh.triangles[0][2] = 3; }},
      {"static world: a triangle names material 1, there are 1",
       [](WorldParts* p) { p->statics.mesh.materials[0] = 1; }},
      {"one instance index is needed per triangle",
       [](WorldParts* p) { p->statics.instances.clear(); }},
      {"static world: a triangle names instance 2, there are 2",
       [](WorldParts* p) { p->statics.instances[0] = 2; }},
      {"mover 0: a triangle names vertex 9, there are 3",
       [](WorldParts* p) { p->mover_meshes[0].triangles[0][0] = 9; }},
      {"there are movers, but nothing says where they are",
       [](WorldParts* p) { p->at = nullptr; }}};
  for (const Broken& one : all) {
    WorldParts parts = Small();
    one.breaks(&parts);
    try {
      World{std::move(parts)};
      ADD_FAILURE() << "accepted: " << one.what;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(one.what));
    }
  }
}

TEST(World, WithNothingThatMovesEveryTimeIsTheSameWithAllLightsOn) {
  WorldParts parts = Small();
  parts.mover_meshes.clear();
  parts.at = nullptr;
  parts.lights.push_back(parts.lights[0]);
  const World world(std::move(parts));
  const Snapshot snapshot = world.At(1'234);
  EXPECT_EQ(snapshot.stamp_ns, 1'234);
  EXPECT_TRUE(snapshot.movers.empty());
  EXPECT_THAT(snapshot.light_scale, testing::ElementsAre(1, 1));
  EXPECT_TRUE(world.PlannedRigPose(77).isApprox(Eigen::Isometry3d::Identity()));
}

/// A world whose snapshot says by which clocks it was asked for.
World Clocked() {
  WorldParts parts = Small();
  parts.at_clocks = [](std::int64_t stamp_ns, std::span<const ActorClock> clocks) {
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    snapshot.clocks.assign(clocks.begin(), clocks.end());
    return snapshot;
  };
  return World(std::move(parts));
}

TEST(World, NearGoesOnByEachActorsOwnClock) {
  const World world = Clocked();
  const std::vector<ActorClock> clocks = {{1'000, 1}, {500, 0}, {2'000, 0.25}};
  const Snapshot now = world.At(4'000, clocks);
  for (const std::int64_t offset : {-800, 0, 400}) {
    const Snapshot then = world.Near(now, offset);
    EXPECT_EQ(then.stamp_ns, 4'000 + offset);
    ASSERT_EQ(then.clocks.size(), 3u);
    EXPECT_EQ(then.clocks[0].time_ns, 1'000 + offset);
    EXPECT_EQ(then.clocks[1].time_ns, 500) << "it stands";
    EXPECT_EQ(then.clocks[2].time_ns, 2'000 + offset / 4);
    // There and back again is where one was.
    const Snapshot back = world.Near(then, -offset);
    EXPECT_EQ(back.stamp_ns, now.stamp_ns);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(back.clocks[i].time_ns, clocks[i].time_ns);
  }
  EXPECT_TRUE(world.Near(world.At(5), 7).clocks.empty()) << "they keep the scene's time";
}

TEST(ClassName, EveryClassHasItsOwn) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(ObjectClass::kCyclist); ++i) {
    names.insert(ClassName(static_cast<ObjectClass>(i)));
  }
  EXPECT_EQ(names.size(), 14u);
  EXPECT_EQ(ClassName(ObjectClass::kPerson), "person");
  EXPECT_EQ(ClassName(ObjectClass::kCyclist), "cyclist");
  EXPECT_THROW(ClassName(static_cast<ObjectClass>(14)), std::out_of_range);
}

}  // namespace
}  // namespace aisle::sim
