#include "simulator/world/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

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

TEST(BuildWorld, ABrokenModelIsNamedWithThePlaceOfTheKeyThatNamesIt) {
  namespace fs = std::filesystem;
  const fs::path assets = fs::path(testing::TempDir()) / fmt::format("aisle-assets-{}", getpid());
  fs::create_directories(assets / "people");
  fs::create_directories(assets / "vehicles");
  fs::copy_file(fs::path(kAssets) / "manifest.json", assets / "manifest.json",
                fs::copy_options::overwrite_existing);
  std::ofstream(assets / "people/worker_anton.glb") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(assets / "vehicles/forklift.glb") << "glTF";
  const auto error_of = [&](const std::string& actors) {
    const std::string text =
        "about: A hall.\nrig: {start: [0, 0]}\n"
        "hall: {from: [-3, -3], to: [9, 6]}\nlights: [{height_m: 5}]\n" +
        actors;
    try {
      BuildWorld(ParseScene(text, "hall.yaml"), assets.string(), 1);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string person =
      error_of("people:\n  - name: walker\n    start: [1, 0]\n    model: worker_anton\n");
  EXPECT_THAT(person, testing::StartsWith("hall.yaml:8:5: model of walker: "));
  EXPECT_THAT(person, testing::HasSubstr("worker_anton.glb: it is named .glb, but holds OBJ text"));
  const std::string vehicle =
      error_of("vehicles:\n  - {name: truck, start: [5, 3], model: forklift}\n");
  EXPECT_THAT(vehicle, testing::StartsWith("hall.yaml:6:34: model of truck: "));
  EXPECT_THAT(vehicle, testing::HasSubstr("forklift.glb: it is cut"));
  const std::string prop = error_of("props:\n  - at: [1, 0]\n    model: drum\n");
  EXPECT_THAT(prop, testing::StartsWith("hall.yaml:7:5: props.model: "));
  EXPECT_THAT(prop, testing::HasSubstr("drum.glb: there is no such file"));
  fs::remove_all(assets);
}

}  // namespace
}  // namespace aisle::sim
