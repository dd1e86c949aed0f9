#include "simulator/world/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "simulator/scene/load.h"
#include "tests/simulator/world/mesh_items.h"

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

TEST(BuildWorld, MoreMoversThanRaysTellApartAreRefusedWithTheirLine) {
  std::string scene =
      "about: A hall.\nrig: {start: [0, 0]}\nhall: {from: [-3, -3], to: [99, 6]}\n"
      "lights: [{rows: 1, per_row: 2, height_m: 5}]\nvehicles:\n";
  for (std::size_t i = 0; i <= kMostMovers; ++i) {
    scene += fmt::format("  - {{name: v{}, model: agv, start: [{}, {}]}}\n", i,
                         3 + 1.4 * static_cast<double>(i % 64), i / 64 * 3);
  }
  try {
    BuildWorld(ParseScene(scene, "many.yaml"), kAssets, 1);
    FAIL() << "it was built";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("many.yaml:133"));
    EXPECT_THAT(error.what(), testing::HasSubstr("at most 127 movers"));
  }
}

TEST(BuildWorld, ActorsAreAllThatMayMoveAndNothingElse) {
  const World world = BuildWorld(
      ParseScene("about: A hall.\nrig: {start: [0, 0]}\nhall: {from: [-3, -3], to: [14, 6]}\n"
                 "lights: [{rows: 1, per_row: 2, height_m: 5}]\n"
                 "racks: [{from: [0, 4], bays: 2}]\npeople: [{name: anna, start: [3, 0]}]\n"
                 "vehicles: [{name: truck, start: [9, 0]}]\n"
                 "mechanisms: [{name: gate, at: [6, 1], parts: [{size_m: [0.1, 2, 2], joint: "
                 "{kind: slider, moves: [{at_s: 3, to_m: 2, over_s: 2}]}}, {name: post, size_m: "
                 "[0.1, 0.1, 2]}]}]\n",
                 "door.yaml"),
      kAssets, 1);
  std::set<std::string> actors, moved;
  for (const Instance& one : world.instances()) {
    if (one.is_actor) actors.insert(one.name);
  }
  for (const MoverState& mover : world.At(0).movers) {
    moved.insert(world.instances()[mover.instance].name);
  }
  EXPECT_THAT(actors, testing::ElementsAre("anna", "gate", "truck"));
  EXPECT_EQ(actors, moved);
  for (const std::uint16_t instance : world.statics().instances) {
    ASSERT_FALSE(world.instances()[instance].is_actor) << world.instances()[instance].name;
  }
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

/// A seed decides wear and what lies where, never the building, the furniture or the lamps.
TEST(BuildWorld, ASeedLeavesTheBuildingAsItIs) {
  const Scene scene = ParseScene(
      "about: A hall.\nrig: {start: [0, 0]}\nhall: {from: [-3, -6], to: [14, 6]}\n"
      "lights: [{height_m: 5}]\nracks: [{from: [0, 3], bays: 2}]\ncolumns: [{at: [5, 0]}]\n"
      "markings: [{from: [0, -1], to: [4, -1]}]\ndoors: [{wall: east, at_m: 0}]\n"
      "stacks: [{at: [8, -3]}]\nprops: [{model: drum, at: [1, -3]}]\n"
      "mezzanines: [{from: [5, -5], to: [12, -2]}]\n",
      "hall.yaml");
  const World one = BuildWorld(scene, kAssets, 1), other = BuildWorld(scene, kAssets, 2);
  ASSERT_EQ(one.instances().size(), other.instances().size());
  int kept = 0, changed = 0;
  for (std::size_t i = 1; i < one.instances().size(); ++i) {
    const std::string& name = one.instances()[i].name;
    EXPECT_EQ(name, other.instances()[i].name);
    const auto corners = [&](const World& world) {
      std::vector<std::array<float, 3>> all;
      for (const std::size_t t : test::TrianglesOf(world.instances(), world.statics(), name)) {
        for (const std::uint32_t v : world.statics().mesh.triangles[t]) {
          const Eigen::Vector3f& p = world.statics().mesh.positions[v];
          all.push_back({p.x(), p.y(), p.z()});
        }
      }
      return all;
    };
    const bool may = name.starts_with("goods") || name.starts_with("stack") ||
                     name.ends_with("goods") || name.ends_with("fittings");
    const bool same = corners(one) == corners(other);
    EXPECT_TRUE(may || same) << name;
    (same ? kept : changed) += 1;
  }
  EXPECT_GT(kept, 8);
  EXPECT_GT(changed, 2);
  ASSERT_EQ(one.lights().size(), other.lights().size());
  for (std::size_t i = 0; i < one.lights().size(); ++i) {
    EXPECT_EQ(one.lights()[i].center, other.lights()[i].center);
    EXPECT_EQ(one.lights()[i].radiance, other.lights()[i].radiance);
  }
  for (std::size_t i = 0; i < one.textures().size(); ++i) {
    const std::string& name = one.textures()[i].name;
    const bool worn = name.starts_with("floor_") || name == "line_paint" || name == "hatch";
    const double apart = cv::norm(one.textures()[i].image, other.textures()[i].image, cv::NORM_INF);
    EXPECT_EQ(apart > 0, worn) << name;
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

/// People of every kind of motion, vehicles that drive and stand, and a mechanism.
TEST(BuildWorld, VelocitiesAloneAreThoseOfWholeSnapshotsToTheBit) {
  for (const char* file : {"/scenes/weakness/conveyor.yaml", "/scenes/paper/scene2.yaml"}) {
    const World world = BuildWorld(LoadScene(kRoot + file), kAssets, 1);
    std::vector<ActorClock> clocks(world.mover_meshes().size(), {2'900'000'000, 0.7});
    clocks[0].rate = 0;
    const Snapshot now = world.At(3'000'000'000, clocks);
    const std::vector<std::int64_t> offsets = {-4'000'000, 2'000'000, 4'000'000};
    const std::vector<MoverVelocities> velocities = world.VelocitiesNear(now, offsets);
    ASSERT_EQ(velocities.size(), offsets.size());
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      const Snapshot then = world.Near(now, offsets[k]);
      ASSERT_EQ(velocities[k].size(), then.movers.size());
      for (std::size_t i = 0; i < then.movers.size(); ++i) {
        EXPECT_EQ(velocities[k][i], then.movers[i].velocities) << file << ", mover " << i;
      }
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
