#include "simulator/scene/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "simulator/scene/footprint.h"
#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Ten metres long, six across, three and a half high; the rig stands in it.
const std::string kRoom =
    "about: It is checked.\nframes: 100\nrig: {start: [0, 0], steps: []}\n"
    "hall: {from: [-4, -2], to: [6, 4], height_m: 3.5}\nlights: [{height_m: 3}]\n";

std::vector<std::string> MessagesOf(const std::string& text, const std::string& file = "s.yaml") {
  try {
    ParseScene(kRoom + text, file);
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

std::vector<std::string> MessagesOfDoor(const std::string& keys) {
  return MessagesOf("doors: [{" + keys + "}]\n");
}

TEST(Doors, OpenWithinTheirWall) {
  EXPECT_THAT(MessagesOfDoor("wall: east, at_m: 1, width_m: 6"), IsEmpty()) << "all of it";
  EXPECT_THAT(MessagesOfDoor("wall: north, at_m: 1, width_m: 10"), IsEmpty());
  for (const std::string wall : {"east", "west"}) {
    EXPECT_THAT(MessagesOfDoor("width_m: 2, wall: " + wall + ", at_m: 3.2"),
                ElementsAre(HasSubstr("s.yaml:6:9: doors[0].at_m: its opening goes from y 2.2 to "
                                      "4.2 m, but its wall goes from -2 to 4")));
  }
  for (const std::string wall : {"north", "south"}) {
    EXPECT_THAT(MessagesOfDoor("width_m: 2, wall: " + wall + ", at_m: 3.2"), IsEmpty());
    EXPECT_THAT(MessagesOfDoor("width_m: 2, wall: " + wall + ", at_m: -3.2"),
                ElementsAre(HasSubstr("from x -4.2 to -2.2 m, but its wall goes from -4 to 6")));
  }
  EXPECT_THAT(MessagesOfDoor("at_m: 500"), ElementsAre(HasSubstr("doors[0].at_m")));
}

TEST(Doors, AreNoHigherThanTheHall) {
  EXPECT_THAT(MessagesOfDoor("height_m: 3.5"), IsEmpty());
  EXPECT_THAT(MessagesOfDoor("height_m: 3.6"),
              ElementsAre(HasSubstr(
                  "doors[0].height_m: its opening of 3.6 m extends above the roof at 3.5 m")));
}

TEST(Props, StandBelowTheRoof) {
  EXPECT_THAT(MessagesOf("props: [{model: drum, at: [3, 1], above_m: 3}]\n"), IsEmpty());
  EXPECT_THAT(MessagesOf("props: [{model: drum, at: [3, 1], above_m: 20}]\n"),
              ElementsAre(HasSubstr("props[0].above_m: 20 m is above the roof at 3.5 m")));
}

/// Of somebody who walks along y = 2 past what stands there.
std::vector<std::string> MessagesPast(const std::string& things) {
  return MessagesOf(things + "people: [{name: anna, start: [0, 2], steps: [{go: [[4, 2]]}]}]\n");
}

TEST(Ways, LeadRoundModelsOfTheKit) {
  EXPECT_THAT(MessagesPast("props: [{model: drum, at: [2, 2.6]}]\n"), IsEmpty());
  EXPECT_THAT(MessagesPast("props: [{model: drum, at: [2, 2.4]}]\n"),
              ElementsAre(HasSubstr("it runs through props[0] (it needs 0.22 m around it)")));
  EXPECT_THAT(MessagesPast("props: [{model: drum, at: [2, 2], above_m: 2.5}]\n"), IsEmpty());
  EXPECT_THAT(MessagesPast("props: [{model: tree_round, at: [2, 2.4]}]\n"), IsEmpty())
      << "beneath its crown";
  EXPECT_THAT(MessagesPast("props: [{model: cone, at: [2, 3.5], to: [2, 1], every_m: 0.5}]\n"),
              ElementsAre(HasSubstr("it runs through props[0]")));
}

TEST(Ways, LeadRoundAMezzaninesColumnsAndStairAndUnderIt) {
  const auto from = [](double y) {
    return fmt::format("mezzanines: [{{from: [1, {:g}], to: [5, 4], height_m: 2}}]\n", y);
  };
  EXPECT_THAT(MessagesPast(from(2)), ElementsAre(HasSubstr("through a column of mezzanines[0]")));
  EXPECT_THAT(MessagesPast(from(0.8)), IsEmpty());
  EXPECT_THAT(
      MessagesOf(from(2) + "people: [{name: anna, start: [2, 1], steps: [{go: [[5, 1]]}]}]\n"),
      ElementsAre(HasSubstr("through the stair of mezzanines[0]")));
}

TEST(Ways, LeadRoundWhatStandsOutOfAMachine) {
  EXPECT_THAT(MessagesPast("fixtures: [{kind: mill, at: [2, -0.1]}]\n"), IsEmpty());
  EXPECT_THAT(MessagesPast("fixtures: [{kind: mill, at: [2, 0.1]}]\n"),
              ElementsAre(HasSubstr("it runs through fixtures[0]")))
      << "its bin";
}

/// A pallet truck before somebody who goes to that x.
std::string PushedTo(double x, double y) {
  return fmt::format(
      "people:\n"
      "  - {{name: anna, start: [0, {1}], steps: [{{go: [[{0}, {1}]], play: walk_push}}]}}\n"
      "vehicles:\n"
      "  - {{name: jack, model: pallet_jack, start: [0, {1}], pushed_by: anna}}\n",
      x, y);
}

/// How far ahead of who pushes it it reaches.
double Reach() {
  const Footprint jack = FootprintOf("pallet_jack");
  return AheadOfPusher("pallet_jack") + jack.front_m + jack.radius_m;
}

TEST(Pushed, StopBeforeTheWall) {
  EXPECT_THAT(MessagesOf(PushedTo(6 - Reach() - 0.01, 2)), IsEmpty());
  EXPECT_THAT(MessagesOf(PushedTo(6 - Reach() + 0.01, 2)),
              ElementsAre(AllOf(HasSubstr("s.yaml:9:5: vehicles[0].pushed_by: at [5.7"),
                                HasSubstr("it runs into a wall or leaves the hall"),
                                HasSubstr("in steps[0] of anna, which is behind it"))));
}

TEST(Pushed, StopBeforeRacksAndDoNotBeginInThem) {
  const std::string rack = "racks: [{from: [3, 2], bays: 1, bay_m: 1.1, depth_m: 1.1}]\n";
  EXPECT_THAT(MessagesOf(rack + PushedTo(3 - Reach() - 0.01, 2)), IsEmpty());
  EXPECT_THAT(MessagesOf(rack + PushedTo(3 - Reach() + 0.06, 2)),
              ElementsAre(HasSubstr("it runs through racks[0] (it needs 0.25 m around it)")));
  EXPECT_THAT(MessagesOf("stacks: [{at: [2, 2]}]\n" + PushedTo(0.1, 2)),
              ElementsAre(AllOf(HasSubstr("it runs through stacks[0]"),
                                HasSubstr("at the start of anna"))));
}

TEST(Towed, AreToldOfWhatTheirTractorsStepsDo) {
  const auto train = [](const std::string& steps) {
    return "vehicles:\n"
           "  - {name: tractor, model: tow_tractor, start: [0, 2], steps: [" +
           steps +
           "]}\n"
           "  - {name: cart, model: tow_trailer, start: [-1.78, 2], towed_by: tractor, behind_m: "
           "1.78}\n";
  };
  EXPECT_THAT(MessagesOf(train("{go: [[4, 2]]}")), IsEmpty());
  EXPECT_THAT(MessagesOf(train("{go: [[4, 2]], wait_s: 2}")),
              ElementsAre(HasSubstr("vehicles[0].steps[0]: expected one of go")));
  EXPECT_THAT(MessagesOf("stacks: [{at: [3, 2]}]\n" + train("{go: [[4, 2]]}")),
              ElementsAre(HasSubstr("vehicles[0].steps[0]: at"), HasSubstr("vehicles[1]: at")));
}

/// Scenes beside a recorded motion, whose text nobody reads here.
class Recorded : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_recorded_{}", ::getpid());
    fs::create_directories(folder_);
    std::ofstream(folder_ / "walk.bvh") << "HIERARCHY\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string File() const { return (folder_ / "s.yaml").string(); }
  std::vector<std::string> Messages(const std::string& rest) const {
    return MessagesOf("people:\n  - {name: rita, start: [1.5, 0], bvh: walk.bvh}\n" + rest, File());
  }

  fs::path folder_;
};

TEST_F(Recorded, PushAndCarryNothing) {
  EXPECT_THAT(Messages(""), IsEmpty());
  EXPECT_THAT(
      Messages("vehicles: [{name: jack, model: pallet_jack, start: [1.5, 0], pushed_by: rita}]\n"),
      ElementsAre(HasSubstr("vehicles[0].pushed_by: 'rita' moves with the motion of `bvh`")));
  const auto holding = [](const std::string& keys) {
    return "  - {name: anna, start: [1.5, 2]}\nmechanisms: [{name: cart, " + keys +
           ", parts: [{size_m: [1, 1, 1]}]}]\n";
  };
  EXPECT_THAT(Messages(holding("pushed_by: anna")), IsEmpty());
  EXPECT_THAT(Messages(holding("pushed_by: rita")),
              ElementsAre(HasSubstr("mechanisms[0].pushed_by: 'rita' has its own motion or body "
                                    "(`bvh`, `mesh`), which cannot hold anything")));
  EXPECT_THAT(Messages(holding("front_by: rita, rear_by: anna")),
              ElementsAre(HasSubstr("mechanisms[0].front_by: 'rita'")));
}

TEST_F(Recorded, AreInNoCrowd) {
  EXPECT_THAT(Messages("crowd: {people: 3, in: [2, 1, 5, 3]}\n"),
              ElementsAre(HasSubstr("people[0]: a crowd must know where people walk")));
}

TEST_F(Recorded, AreWhereTheirMotionHasThem) {
  const auto going = [&](const Eigen::Vector2d& velocity_mps, const std::string& rest = "",
                         const std::string& keys = "") {
    const Scene scene = ParseScene(
        kRoom + "people:\n  - {name: rita, start: [1.5, 0], bvh: walk.bvh" + keys + "}\n" + rest,
        File());
    FloorWay way;
    for (int i = 0; i <= 20; ++i) {
      way.places.emplace_back(scene.people[0].route.plan.start + i * way.step_s * velocity_mps);
    }
    return CheckWays(scene, {{"rita", way}});
  };
  EXPECT_THAT(going({0, 1}), IsEmpty());
  // The rig and a person need 0.52 m.
  EXPECT_THAT(going({-0.97, 0}), IsEmpty());
  EXPECT_THAT(going({-1.1, 0}), ElementsAre(AllOf(HasSubstr("s.yaml:7:5: people[0]: at 0.9"),
                                                  HasSubstr("from the rig"))));
  EXPECT_THAT(going({-1.1, 0}, "", ", start_s: 60"), IsEmpty()) << "after the scene's end";
  EXPECT_THAT(going({0, 3}, "stacks: [{at: [1.5, 2.5]}]\n"),
              ElementsAre(AllOf(HasSubstr("people[0].bvh: at [1.50, "),
                                HasSubstr("it runs through stacks[0]"))));
  EXPECT_THAT(going({6, 0}), ElementsAre(HasSubstr("it runs into a wall or leaves the hall")));
}

TEST(FloorWay, StandsBeforeAndAfterAndGoesStraightInBetween) {
  const FloorWay way{0.5, {{0, 0}, {1, 0}, {1, 2}}};
  EXPECT_EQ(way.duration_s(), 1);
  EXPECT_EQ(way.At(-3), Eigen::Vector2d(0, 0));
  EXPECT_EQ(way.At(0.25), Eigen::Vector2d(0.5, 0));
  EXPECT_EQ(way.At(0.75), Eigen::Vector2d(1, 1));
  EXPECT_EQ(way.At(1), Eigen::Vector2d(1, 2));
  EXPECT_EQ(way.At(9), Eigen::Vector2d(1, 2));
  EXPECT_EQ((FloorWay{0.5, {{3, 4}}}).At(2), Eigen::Vector2d(3, 4));
}

std::string RoomOf(const std::string& hall, const std::string& lights) {
  return "about: It is large.\nframes: 100\nrig: {start: [0, 0], steps: []}\nhall: {" + hall +
         "}\nlights:\n" + lights;
}

std::vector<std::string> MessagesOfRoom(const std::string& hall, const std::string& lights) {
  try {
    ParseScene(RoomOf(hall, lights), "s.yaml");
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

TEST(Halls, HaveAFloorThatCanBeLit) {
  const std::string lights = "- {height_m: 3}\n";
  EXPECT_THAT(MessagesOfRoom("from: [-250, -250], to: [250, 250], height_m: 10", lights),
              IsEmpty());
  EXPECT_THAT(MessagesOfRoom("from: [-250, -250], to: [250, 251], height_m: 10", lights),
              ElementsAre(AllOf(HasSubstr("s.yaml:4:"), HasSubstr("hall: its floor of 500 x 501 m"),
                                HasSubstr("at most 250000 m²"))));
}

TEST(Lamps, OfAllGridsTogetherAreCounted) {
  const std::string hall = "from: [-50, -50], to: [50, 50], height_m: 10";
  const std::string full = "- {rows: 20, per_row: 100, height_m: 6}\n";
  EXPECT_THAT(MessagesOfRoom(hall, full), IsEmpty());
  EXPECT_THAT(MessagesOfRoom(hall, full + "- {rows: 1, per_row: 1, height_m: 6}\n" + full),
              ElementsAre(AllOf(HasSubstr("s.yaml:7:"), HasSubstr("lights[1]"),
                                HasSubstr("there are 2001 lamps"))));
}

}  // namespace
}  // namespace aisle::sim
