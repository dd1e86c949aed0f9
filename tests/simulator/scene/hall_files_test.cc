#include "simulator/scene/hall_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "simulator/scene/essence.h"
#include "simulator/scene/load.h"
#include "simulator/scene/vary.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kWide = R"(about: A wide room.
hall: {from: [-5, -8], to: [20, 8], height_m: 6, wear: 0.3}
racks:
  - {from: [0, 3], bays: 3}
stacks:
  - {at: [9, 5]}
lights:
  - {rows: 2, per_row: 4, height_m: 5}
views:
  - {at: [1, 0], heading_deg: 10}
  - {at: [18, 2], heading_deg: 180, height_m: 2, pitch_deg: 5}
)";
constexpr const char* kNarrow = R"(about: A narrow room.
hall: {from: [-5, -3], to: [20, 3], height_m: 9}
racks:
  - {from: [0, 2], bays: 5}
  - {from: [0, -2], bays: 5}
lights:
  - {rows: 1, per_row: 4, height_m: 8}
)";
constexpr const char* kDrive =
    "about: It drives.\nrig: {start: [0, 0], steps: [{go: [[8, 0]], speed_mps: 0.9}]}\n";

class HallFilesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_halls_{}", ::getpid());
    fs::create_directories(folder_ / "halls");
    Write("halls/wide.yaml", kWide);
    Write("halls/narrow.yaml", kNarrow);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string Write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string Drive(const std::string& rest, const std::string& name = "s.yaml") const {
    return Write(name, kDrive + rest);
  }
  std::string PathOf(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
};

TEST_F(HallFilesTest, HoldWhereTheSceneSaysNothing) {
  const Scene scene = LoadScene(Drive("hall: {use: halls/wide.yaml, wear: 0.9}\nstacks: []\n"));
  EXPECT_EQ(scene.about, "It drives.");
  EXPECT_EQ(scene.hall.use, "halls/wide.yaml");
  EXPECT_EQ(HallName(scene.hall.use), "wide");
  EXPECT_EQ(scene.hall.height_m, 6);
  EXPECT_EQ(scene.hall.wear, 0.9);  // key by key
  EXPECT_EQ(scene.racks.size(), 1u);
  EXPECT_TRUE(scene.stacks.empty());  // lists whole
  EXPECT_THAT(scene.files, ElementsAre(PathOf("s.yaml"), PathOf("halls/wide.yaml")));
  EXPECT_THAT(SceneFiles(PathOf("s.yaml")), testing::ElementsAreArray(scene.files));
}

TEST_F(HallFilesTest, TakeThePlaceOfAllThatAnExtendedSceneSaysOfItsOwn) {
  Drive(std::string(kWide).substr(std::string(kWide).find('\n') + 1), "base.yaml");
  const Scene scene =
      LoadScene(Write("s.yaml", "extend: base\nabout: x\nhall: {use: halls/narrow}\n"));
  EXPECT_EQ(scene.hall.height_m, 9);
  EXPECT_EQ(scene.hall.wear, 0.5);
  EXPECT_EQ(scene.racks.size(), 2u);
  EXPECT_TRUE(scene.stacks.empty());
  EXPECT_TRUE(scene.views.empty());
  EXPECT_EQ(scene.rig.route.plan.steps.size(), 1u);
  // Nearer files lie over the hall that a farther one names.
  Drive("hall: {use: halls/narrow}\n", "base.yaml");
  const Scene nearer = LoadScene(Write("s.yaml", "extend: base\nabout: x\nhall: {height_m: 10}\n"));
  EXPECT_EQ(nearer.hall.height_m, 10);
  EXPECT_EQ(nearer.racks.size(), 2u);
}

TEST_F(HallFilesTest, MistakesAreReportedWhereTheyStand) {
  EXPECT_THAT(CheckScene(Drive("hall: {use: halls/none}\n")),
              ElementsAre(StartsWith(PathOf("s.yaml") + ":3:13: hall.use: " +
                                     PathOf("halls/none.yaml") + ": no such file")));
  EXPECT_THAT(CheckScene(Drive("hall: {use: [a]}\n")),
              ElementsAre(HasSubstr(":3:13: hall.use: expected the path of a hall's file")));
  Write("halls/bad.yaml", std::string(kNarrow) + "people: []\nracksx: []\n");
  EXPECT_THAT(CheckScene(Drive("hall: {use: halls/bad}\n")),
              ElementsAre(StartsWith(PathOf("halls/bad.yaml") + ":8:1: people: not allowed in"),
                          StartsWith(PathOf("halls/bad.yaml") + ":9:1: racksx: not allowed in")));
  Write("halls/bad.yaml", "hall: {use: wide}\n");
  EXPECT_THAT(
      CheckScene(Drive("hall: {use: halls/bad}\n")),
      ElementsAre(HasSubstr("halls/bad.yaml:1:13: hall.use: not allowed in a hall's file")));
  Write("halls/bad.yaml", "hall: {height_m: low}\nlights: [{rows: 1}]\n");
  EXPECT_THAT(CheckScene(Drive("hall: {use: halls/bad}\n")),
              ElementsAre(StartsWith(PathOf("halls/bad.yaml") + ":1:18: hall.height_m: expected")));
  EXPECT_THAT(CheckScene(Drive("hall: {use: halls/wide}\nvary: {hall: [halls/wide]}\n")),
              ElementsAre(HasSubstr(":4:14: vary.hall: the hall is already chosen")));
  EXPECT_THAT(CheckScene(Drive("vary: {hall: []}\n")),
              ElementsAre(HasSubstr("vary.hall: expected a list of paths of halls' files")));
}

TEST_F(HallFilesTest, SeedsDealThemInTurn) {
  const Scene scene =
      LoadScene(Drive("vary: {hall: [halls/wide.yaml, halls/narrow.yaml]}\nhall: {wear: 0.7}\n"));
  ASSERT_EQ(scene.dealt.size(), 2u);
  EXPECT_EQ(scene.hall.height_m, 6);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Scene seeded = Seeded(scene, seed);
    EXPECT_EQ(HallName(seeded.hall.use), seed % 2 == 1 ? "wide" : "narrow");
    EXPECT_EQ(seeded.hall.height_m, seed % 2 == 1 ? 6 : 9);
    EXPECT_EQ(seeded.racks.size(), seed % 2 == 1 ? 1u : 2u);
    EXPECT_EQ(seeded.hall.wear, 0.7);
    EXPECT_TRUE(seeded.dealt.empty());
  }
}

TEST_F(HallFilesTest, EachThatASeedMayDealIsChecked) {
  const std::string halls = "vary: {hall: [halls/wide, halls/narrow]}\n";
  EXPECT_THAT(CheckScene(Drive(halls)), ElementsAre());
  const std::string into_a_rack =
      "about: x\nrig: {start: [0, 0], steps: [{go: [[8, 0], [8, -2]], speed_mps: 0.9}]}\n";
  EXPECT_THAT(CheckScene(Write("s.yaml", into_a_rack + halls)),
              ElementsAre(HasSubstr("rig.steps[0]: in halls/narrow with seed 2 at [8.00, -1.")));
}

TEST_F(HallFilesTest, MeshesOfEachThatASeedMayDealAreFound) {
  const std::string props = "props: [{at: [17, 2], mesh: shelf.glb}]\n";
  Write("halls/own.yaml", kNarrow + props);
  const std::string drive = Drive("vary: {hall: [halls/wide, halls/own]}\n");
  const std::string shelf = PathOf("halls/shelf.glb");
  EXPECT_THAT(CheckScene(drive),
              ElementsAre(testing::AllOf(StartsWith(PathOf("halls/own.yaml") + ":8:"),
                                         HasSubstr("props[0].mesh: no such file: " + shelf))));
  Write("halls/shelf.glb", "glTF");
  const Scene scene = LoadScene(drive);
  EXPECT_THAT(scene.mesh_files, ElementsAre(shelf));
  EXPECT_THAT(SceneFiles(drive), testing::Contains(shelf));
  ASSERT_EQ(Seeded(scene, 2).props.size(), 1u);
  EXPECT_EQ(Seeded(scene, 2).props[0].mesh.file, shelf);
}

TEST_F(HallFilesTest, MeshesOfEachThatASeedMayDealCountByTheirBytes) {
  Write("halls/own.yaml", kNarrow + std::string("props: [{at: [17, 2], mesh: shelf.glb}]\n"));
  const std::string drive = Drive("vary: {hall: [halls/wide, halls/own]}\n");
  const auto made_of = [&](const char* bytes) {
    Write("halls/shelf.glb", bytes);
    return EssenceOf(drive, true);
  };
  const std::string own = made_of("glTF a");
  EXPECT_EQ(made_of("glTF a"), own);
  EXPECT_NE(made_of("glTF b"), own);
}

TEST_F(HallFilesTest, AMistakeThatHallsShareIsToldOnce) {
  const std::string both = "props: [{at: [17, 2], model: drum, mesh: none.glb}]\n";
  EXPECT_THAT(CheckScene(Drive("vary: {hall: [halls/wide, halls/narrow]}\n" + both)),
              ElementsAre(HasSubstr("it has both a `model` and a `mesh`"),
                          HasSubstr("no such file: " + PathOf("none.glb"))));
}

TEST_F(HallFilesTest, AreScenesByThemselvesWhereTheyHaveViews) {
  const Scene hall = LoadScene(PathOf("halls/wide.yaml"));
  EXPECT_EQ(hall.frames, 2);
  ASSERT_EQ(hall.rig.poses.size(), 2u);
  EXPECT_EQ(hall.rig.poses[1].time_ns, 50'000'000);
  const Eigen::Isometry3d& pose = hall.rig.poses[1].T_world_body;
  EXPECT_TRUE(pose.translation().isApprox(Eigen::Vector3d(18, 2, 2)));
  // Ahead is the camera's z.
  EXPECT_TRUE(pose.linear().col(2).isApprox(
      Eigen::Vector3d(-std::cos(std::atan(1.0) / 9), 0, -std::sin(std::atan(1.0) / 9))));
  EXPECT_THAT(CheckScene(PathOf("halls/narrow.yaml")), ElementsAre(HasSubstr("rig: missing key")));
}

TEST_F(HallFilesTest, CountByWhatTheyHoldNotByTheirNames) {
  const auto essence = [&](const std::string& rest) { return EssenceOf(Drive(rest), true); };
  const std::string wide = essence("hall: {use: halls/wide}\n");
  Write("halls/same.yaml", kWide);
  EXPECT_EQ(essence("hall: {use: halls/same}\n"), wide);
  EXPECT_NE(essence("hall: {use: halls/narrow}\n"), wide);
  Write("halls/same.yaml", std::string(kWide) + "doors: [{wall: east}]\n");
  EXPECT_NE(essence("hall: {use: halls/same}\n"), wide);
  const std::string both = essence("vary: {hall: [halls/wide, halls/narrow]}\n");
  EXPECT_NE(essence("vary: {hall: [halls/narrow, halls/wide]}\n"), both);
  EXPECT_NE(both, wide);
}

}  // namespace
}  // namespace aisle::sim
