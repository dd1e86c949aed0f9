#include "simulator/world/captured_person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "simulator/scene/load.h"
#include "simulator/world/recorded_ways.h"
#include "tests/simulator/mesh/capture/made_walk.h"

namespace aisle::sim {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A walk straight on that sways across its way, by a metre a second at the most.
std::string SwayingWalk() {
  std::istringstream lines(test::WalkWriter({}).Write());
  std::string text;
  int frame = -1;
  for (std::string line; std::getline(lines, line);) {
    if (frame >= 0) {
      const double left_cm = 50 * std::sin(2 * frame++ / test::MadeWalk::kRate_hz);
      line = fmt::format("{:.9f}{}", left_cm, line.substr(line.find(' ')));
    }
    if (line.starts_with("Frame Time")) frame = 0;
    text += line + "\n";
  }
  return text;
}

std::filesystem::path Folder() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("aisle_captured_{}", ::getpid());
  std::filesystem::create_directories(folder);
  return folder;
}

TEST(CapturedPerson, HasTheVelocityOfItsOriginSidewaysToo) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("aisle_sway_{}.bvh", ::getpid());
  std::ofstream(file) << SwayingWalk();
  PersonSpec person;
  person.name = "sways";
  person.capture.bvh = {{}, "sway.bvh", file.string()};
  person.route.plan.start = {3, -1};
  person.route.plan.heading_rad = 0.4;
  AssetLibrary assets(std::string(AISLE_SOURCE_DIR) + "/assets");
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  const Actor actor = MakeCapturedPerson(person, &assets, &wardrobe);
  std::filesystem::remove(file);
  constexpr double kHalf_s = 0.005;
  double fastest_aside_mps = 0;
  for (double t = 0.1; t < 3.8; t += 0.13) {
    const MoverState now = actor.At(t);
    const Eigen::Vector3d moved = (actor.At(t + kHalf_s).T_world_object.translation() -
                                   actor.At(t - kHalf_s).T_world_object.translation()) /
                                  (2 * kHalf_s);
    EXPECT_LT((now.velocity_mps - moved).norm(), 1e-3) << t;
    fastest_aside_mps =
        std::max(fastest_aside_mps, std::abs(moved.dot(now.T_world_object.linear().col(1))));
  }
  EXPECT_GT(fastest_aside_mps, 0.8);
}

/// Somebody who walks straight on, at about MadeWalk's speed times how long the model's legs are.
std::vector<std::string> MessagesOfWalk(const std::string& keys, const std::string& rest = "",
                                        const std::string& motion = test::WalkWriter({}).Write()) {
  const std::filesystem::path folder = Folder();
  std::ofstream(folder / "walk.bvh") << motion;
  const Scene scene = ParseScene(
      "about: A walk.\nframes: 100\nrig: {start: [0, 0], steps: []}\n"
      "hall: {from: [-5, -5], to: [12, 5]}\nlights: [{height_m: 5}]\n"
      "people:\n  - {name: rita, bvh: walk.bvh, " +
          keys + "}\n" + rest,
      (folder / "s.yaml").string());
  AssetLibrary assets(std::string(AISLE_SOURCE_DIR) + "/assets");
  std::vector<std::string> messages = CheckCaptured(scene, &assets);
  std::filesystem::remove_all(folder);
  return messages;
}

TEST(CheckCaptured, HoldsTheWayOfAMotionAgainstAllOthers) {
  EXPECT_THAT(MessagesOfWalk("start: [1.5, 0]"), IsEmpty()) << "it walks away from the rig";
  EXPECT_THAT(
      MessagesOfWalk("start: [1.5, 0], heading_deg: 180"),
      ElementsAre(AllOf(HasSubstr("s.yaml:7:5: people[0]: at "), HasSubstr("from the rig"))));
  EXPECT_THAT(MessagesOfWalk("start: [2, 0]", "  - {name: tom, start: [3.5, 0.2]}\n"),
              ElementsAre(HasSubstr("from rita")));
  EXPECT_THAT(MessagesOfWalk("start: [2, 0]", "stacks: [{at: [4, 0]}]\n"),
              ElementsAre(AllOf(HasSubstr("s.yaml:7:18: people[0].bvh: at [3."),
                                HasSubstr("runs through stacks[0]"))));
  EXPECT_THAT(MessagesOfWalk("start: [11, 0]"), ElementsAre(HasSubstr("runs into a wall")));
}

TEST(CheckCaptured, TellsOfAMotionThatCannotBeRead) {
  EXPECT_THAT(MessagesOfWalk("start: [1.5, 0]", "", "HIERARCHY\n"),
              ElementsAre(HasSubstr("s.yaml:7:18: people[0].bvh: ")));
}

TEST(CheckCaptured, TellsOfAClipThatAMeshLacks) {
  const auto with = [](const std::string& clip) {
    const std::filesystem::path folder = Folder();
    std::filesystem::copy_file(std::string(AISLE_SOURCE_DIR) + "/assets/people/worker_bea.glb",
                               folder / "bea.glb");
    const Scene scene = ParseScene(
        "about: A walk.\nrig: {start: [0, 0], steps: []}\n"
        "hall: {from: [-5, -5], to: [12, 5]}\nlights: [{height_m: 5}]\n"
        "people: [{name: bea, start: [4, 0], mesh: bea.glb, clip: " +
            clip + "}]\n",
        (folder / "s.yaml").string());
    AssetLibrary assets(std::string(AISLE_SOURCE_DIR) + "/assets");
    std::vector<std::string> messages = CheckCaptured(scene, &assets);
    std::filesystem::remove_all(folder);
    return messages;
  };
  EXPECT_THAT(with("wave"), IsEmpty());
  EXPECT_THAT(with("Breakdance"), ElementsAre(AllOf(HasSubstr("people[0].mesh: clip 'Breakdance'"),
                                                    HasSubstr("wave"))));
}

TEST(RecordedWay, IsWhereThePersonIs) {
  const std::filesystem::path file = Folder() / "sway.bvh";
  std::ofstream(file) << SwayingWalk();
  PersonSpec person;
  person.capture.bvh = {{}, "sway.bvh", file.string()};
  person.route.plan.start = {3, -1};
  person.route.plan.heading_rad = 0.4;
  person.route.plan.start_s = 1.5;
  AssetLibrary assets(std::string(AISLE_SOURCE_DIR) + "/assets");
  WorldParts parts;
  Wardrobe wardrobe(&parts);
  const Actor actor = MakeCapturedPerson(person, &assets, &wardrobe);
  const FloorWay way = RecordedWay(person, &assets);
  std::filesystem::remove_all(file.parent_path());
  for (double t = 0; t < 6; t += 0.13) {
    const Eigen::Vector3d there = actor.At(t).T_world_object.translation();
    EXPECT_LT((way.At(t - 1.5) - there.head<2>()).norm(), 5e-3) << t;
  }
}

}  // namespace
}  // namespace aisle::sim
