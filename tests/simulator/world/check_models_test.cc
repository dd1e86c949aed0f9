#include "simulator/world/check_models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/scene/load.h"
#include "simulator/world/actors.h"
#include "simulator/world/build.h"
#include "simulator/world/mechanism.h"
#include "tests/simulator/world/mechanism_scene.h"

namespace aisle::sim {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kAssets = std::string(AISLE_SOURCE_DIR) + "/assets";

std::vector<std::string> MessagesOf(const std::string& text) {
  static const AssetLibrary assets(kAssets);
  return CheckModels(ParseScene(kHall + text, "s.yaml"), assets);
}

std::vector<std::string> MessagesOfVehicle(const std::string& keys) {
  return MessagesOf("vehicles: [{name: a, start: [5, 2], " + keys + "}]\n");
}

TEST(CheckModels, KnowsWhatAPersonCanPlay) {
  const auto playing = [](const std::string& play, const std::string& keys = "") {
    return MessagesOf(
        "people:\n  - {name: anna, start: [5, 2], steps: [{wait_s: 1}, {wait_s: 4, play: " + play +
        "}]" + keys + "}\n");
  };
  for (const char* play : {"wave", "walk_carry", "kneel", "look_back"}) {
    EXPECT_THAT(playing(play), IsEmpty()) << play;
  }
  EXPECT_THAT(
      playing("breakdance"),
      ElementsAre(AllOf(HasSubstr("s.yaml:7:54: people[0].steps[1].play: 'breakdance' is "
                                  "nothing that 'worker_anton' can play; there are: kneel, "),
                        HasSubstr("look_around, look_back, "), HasSubstr("wave"))));
  EXPECT_THAT(playing("breakdance", ", vary: {look: true}"), testing::SizeIs(1));
}

TEST(CheckModels, KnowsWhoHasForks) {
  EXPECT_THAT(MessagesOfVehicle("load: cartons"), IsEmpty());
  EXPECT_THAT(MessagesOfVehicle("model: pallet_jack, load: cartons"), IsEmpty());
  EXPECT_THAT(
      MessagesOfVehicle("model: agv, load: cartons"),
      ElementsAre(HasSubstr("s.yaml:6:12: vehicles[0].load: the model 'agv' has no forks")));
  const auto taken_by = [](const std::string& model) {
    return MessagesOf("vehicles: [{name: a, start: [5, 2], model: " + model + "}]\n" +
                      "mechanisms: [{name: box, at: [6, 2], parts: [{size_m: [1, 1, 1]}], taken: "
                      "[{by: a, at_s: 3}]}]\n");
  };
  EXPECT_THAT(taken_by("reach_truck"), IsEmpty());
  EXPECT_THAT(
      taken_by("agv"),
      ElementsAre(HasSubstr("mechanisms[0].taken[0].by: the model 'agv' of 'a' has no forks")));
  EXPECT_THAT(taken_by("spaceship"), ElementsAre(HasSubstr("there is no model 'spaceship'")));
}

TEST(CheckModels, KnowsThePropsOfEachHallThatASeedMayDeal) {
  const AssetLibrary assets(kAssets);
  const Scene plain = ParseScene(kHall, "s.yaml");
  const Scene strange = ParseScene(kHall + "props: [{at: [6, 2], model: spaceship}]\n", "s.yaml");
  Scene dealing = plain;
  dealing.dealt = {plain, plain};
  EXPECT_THAT(CheckModels(dealing, assets), IsEmpty());
  dealing.dealt = {plain, strange, strange};
  EXPECT_THAT(CheckModels(dealing, assets),
              ElementsAre(HasSubstr("props.model: there is no model 'spaceship'")))
      << "once, though two halls have it";
}

/// A mast may go as far as the model lifts, of which its forks take a little at the start.
TEST(CheckModels, KnowsHowFarAMastGoes) {
  const AssetLibrary assets(kAssets);
  const auto lifting = [](const std::string& keys, double height_m) {
    return MessagesOfVehicle(
        fmt::format("{}, mast: [{{at_s: 0, height_m: {:.4f}}}]", keys, height_m));
  };
  for (const bool loaded : {false, true}) {
    for (const char* model : {"forklift", "reach_truck", "order_picker"}) {
      VehicleSpec vehicle;
      vehicle.load = loaded ? GoodsKind::kCartons : GoodsKind::kNothing;
      const double room_m = assets.Vehicle(model).lift_travel_m - ForksAtRest_m(vehicle);
      const std::string keys =
          fmt::format("model: {}, load: {}", model, loaded ? "cartons" : "nothing");
      EXPECT_GT(room_m, 2) << model;
      EXPECT_THAT(lifting(keys, room_m - 0.001), IsEmpty()) << model;
      EXPECT_THAT(lifting(keys, room_m + 0.001),
                  ElementsAre(HasSubstr(fmt::format("is higher than the model '{}' lifts: {:g} m "
                                                    "above the start",
                                                    model, room_m))));
    }
  }
  EXPECT_THAT(lifting("model: agv", 1),
              ElementsAre(HasSubstr("vehicles[0].mast: 1 m is higher than")));
  EXPECT_THAT(lifting("model: scrubber", 0.1),
              ElementsAre(HasSubstr("vehicles[0].mast: the model 'scrubber' has none")));
}

/// So many gates, each with a leaf that slides.
std::string Gates(std::size_t count, const std::string& keys = "") {
  std::string gates = "mechanisms:\n";
  for (std::size_t i = 0; i < count; ++i) {
    gates += fmt::format(
        "  - {{name: g{}, at: [6, 3], level: high, parts: [{{size_m: [0.1, 1, 1]{}, joint: {{kind: "
        "slider, "
        "moves: [{{at_s: 3, to_m: 1}}]}}}}]}}\n",
        i, keys);
  }
  return gates;
}

TEST(CheckModels, CountsMovers) {
  EXPECT_THAT(MessagesOf(Gates(kMostMovers)), IsEmpty());
  EXPECT_THAT(MessagesOf(Gates(130)),
              ElementsAre(HasSubstr(fmt::format("s.yaml:{}:5: movers: people, crowd, vehicles and "
                                                "mechanisms are 130, and a scene has at most 127",
                                                7 + kMostMovers))));
  const std::string crowd = "crowd: {people: 6, in: [2, -4, 10, 2]}\n";
  EXPECT_THAT(MessagesOf(Gates(kMostMovers - 6) + crowd), IsEmpty());
  EXPECT_THAT(MessagesOf(Gates(kMostMovers - 5) + crowd), ElementsAre(HasSubstr("are 128,")));
}

TEST(CountMovers, IsHowManyAreBuilt) {
  const std::string pane =
      "mechanisms: [{name: pane, at: [6, 1], parts: [{name: frame, size_m: [0.1, 2, 2]}, "
      "{on: frame, paint: glass, size_m: [0.1, 1, 1]}, ";
  for (const std::string& text : {
           kJoints,
           std::string("mechanisms: [{name: rests, at: [6, 1], parts: [{size_m: [1, 1, 1]}]}]\n"),
           pane + "{on: frame, paint: glow, size_m: [0.2, 0.2, 0.2]}]}]\n",
           pane + "{size_m: [1, 1, 1]}]}]\n",
           "people: [{name: anna, start: [5, 2]}]\n" + pane.substr(0, pane.find("at:")) +
               "pushed_by: anna, " + pane.substr(pane.find("parts")) + "{size_m: [1, 1, 1]}]}]\n",
       }) {
    const Scene scene = ParseScene(kHall + text, "s.yaml");
    const World world = BuildWorld(scene, kAssets, 1);
    EXPECT_EQ(CountMovers(scene.mechanisms[0]) + scene.people.size(), world.At(0).movers.size())
        << text;
  }
}

}  // namespace
}  // namespace aisle::sim
