#include "simulator/world/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

const std::string kRoot = AISLE_SOURCE_DIR;
const std::string kAssets = kRoot + "/assets";

Scene SceneTwo() { return LoadScene(kRoot + "/scenes/paper/scene2.yaml"); }

/// A hall with one rack: quick to build.
Scene SmallScene() {
  return ParseScene(
      "about: A hall with one rack.\nrig: {start: [0, 0]}\nhall: {from: [-3, -3], to: [9, 6]}\n"
      "lights: [{rows: 1, per_row: 2, height_m: 5, off: [{from_s: 2, to_s: 3}]}]\n"
      "racks: [{from: [0, 3], bays: 2}]\n",
      "small.yaml");
}

bool SameMesh(const TriangleMesh& a, const TriangleMesh& b) {
  return a.positions == b.positions && a.uvs == b.uvs && a.triangles == b.triangles &&
         a.materials == b.materials;
}

TEST(BuildWorld, TheSameSeedGivesTheSameWorldAndAnotherSeedAnother) {
  const Scene scene = SmallScene();
  const World one = BuildWorld(scene, kAssets, 1), again = BuildWorld(scene, kAssets, 1);
  const World other = BuildWorld(scene, kAssets, 2);
  EXPECT_TRUE(SameMesh(one.statics().mesh, again.statics().mesh));
  EXPECT_FALSE(SameMesh(one.statics().mesh, other.statics().mesh));
  ASSERT_EQ(one.textures().size(), again.textures().size());
  for (std::size_t i = 0; i < one.textures().size(); ++i) {
    EXPECT_EQ(cv::norm(one.textures()[i].image, again.textures()[i].image, cv::NORM_INF), 0);
  }
}

TEST(BuildWorld, EverythingStandsInTheHall) {
  const Scene scene = SmallScene();
  const World world = BuildWorld(scene, kAssets, 3);
  for (const Eigen::Vector3f& p : world.statics().mesh.positions) {
    EXPECT_GT(p.z(), -1e-3f);
    EXPECT_LT(p.z(), scene.hall.height_m + 0.2);
    EXPECT_GT(p.x(), scene.hall.from.x() - 0.3);
    EXPECT_LT(p.x(), scene.hall.to.x() + 0.3);
  }
}

TEST(BuildWorld, NormalsPointOutOfTheirTriangles) {
  const World world = BuildWorld(SmallScene(), kAssets, 1);
  const TriangleMesh& mesh = world.statics().mesh;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3f normal =
        (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    EXPECT_GT(normal.dot(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]), 0);
  }
}

TEST(BuildWorld, LampsShineDownAndObeyTheirSwitch) {
  const World world = BuildWorld(SmallScene(), kAssets, 1);
  ASSERT_EQ(world.lights().size(), 2u);
  for (const AreaLight& light : world.lights()) {
    EXPECT_LT(light.half_u.cross(light.half_v).z(), 0);
  }
  EXPECT_THAT(world.At(1'000'000'000).light_scale, testing::ElementsAre(1, 1));
  EXPECT_THAT(world.At(2'500'000'000).light_scale, testing::ElementsAre(0, 0));
  EXPECT_THAT(world.At(3'000'000'000).light_scale, testing::ElementsAre(1, 1));
}

TEST(BuildWorld, ATypicalHallIsRichButNotTooRich) {
  const World world = BuildWorld(SceneTwo(), kAssets, 1);
  EXPECT_GT(world.statics().mesh.triangles.size(), 60'000u);
  EXPECT_LT(world.statics().mesh.triangles.size(), 300'000u);
  EXPECT_EQ(world.mover_meshes().size(), 2u);
}

TEST(BuildWorld, TheRigDrivesThePapersDistance) {
  const Scene scene = SceneTwo();
  const World world = BuildWorld(WithoutActors(scene), kAssets, 1);
  const auto end = static_cast<std::int64_t>(scene.duration_s() * 1e9);
  const Eigen::Isometry3d way = world.PlannedRigPose(0).inverse() * world.PlannedRigPose(end);
  EXPECT_NEAR(way.translation().norm(), 13.6, 1e-9);
  EXPECT_TRUE(world.At(0).movers.empty());
}

TEST(BuildWorld, FrozenActorsKeepTheirPlaceAndAreStill) {
  const World world = BuildWorld(Frozen(SceneTwo()), kAssets, 1);
  const Snapshot first = world.At(0), later = world.At(7'000'000'000);
  ASSERT_EQ(first.movers.size(), 2u);
  for (std::size_t i = 0; i < first.movers.size(); ++i) {
    EXPECT_EQ(first.movers[i].positions, later.movers[i].positions);
    for (const Eigen::Vector3f& velocity : later.movers[i].velocities) {
      EXPECT_EQ(velocity, Eigen::Vector3f::Zero());
    }
  }
}

TEST(BuildWorld, AMissingModelIsNamedWithItsPlaceInTheFile) {
  Scene scene = SceneTwo();
  scene.people[0].model = "nobody";
  try {
    BuildWorld(scene, kAssets, 1);
    FAIL() << "it was accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("scene2.yaml:"));
    EXPECT_THAT(error.what(), testing::HasSubstr("there is no model 'nobody'"));
  }
}

}  // namespace
}  // namespace aisle::sim
