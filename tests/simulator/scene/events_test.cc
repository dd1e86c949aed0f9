#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/scene/crowd.h"
#include "simulator/scene/load.h"
#include "simulator/scene/vary.h"

/// What a scene file says of mechanisms, beams and crowds, and what it is told where that is wrong.
namespace aisle::sim {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string kHall = R"(about: Things happen.
frames: 200
rig: {start: [0, 0], steps: [{go: [[3, 0]], speed_mps: 0.3}]}
hall: {from: [-5, -8], to: [20, 8], height_m: 6}
racks: [{from: [3, 3], bays: 4}, {from: [3, -3], bays: 4}]
lights: [{rows: 1, per_row: 2, height_m: 5}]
people:
  - {name: anton, start: [5, 1.5], level: mid, steps: [{go: [[5, -1.5]], speed_mps: 1.2}]}
)";

std::vector<std::string> MessagesOf(const std::string& text) {
  try {
    ParseScene(kHall + text, "s.yaml");
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

std::string Gate(const std::string& part) {
  return "mechanisms: [{name: gate, at: [6, 1], parts: [{size_m: [1, 1, 1], joint: {" + part +
         "}}]}]\n";
}

TEST(Mechanisms, AreToldWhatTheirJointsLack) {
  EXPECT_THAT(MessagesOf(Gate("kind: slider")),
              ElementsAre(HasSubstr("mechanisms[0].parts[0].joint: a hinge or slider needs moves; "
                                    "example: moves: [{at_s: 3, to_m: 2, over_s: 2}]")));
  EXPECT_THAT(MessagesOf(Gate("kind: spin")), ElementsAre(HasSubstr("a spin needs rate_hz")));
  EXPECT_THAT(MessagesOf(Gate("kind: belt")), ElementsAre(HasSubstr("a belt needs speed_mps")));
  EXPECT_THAT(MessagesOf(Gate("kind: chain")), ElementsAre(HasSubstr("a chain needs swing_m")));
  EXPECT_THAT(MessagesOf(Gate("kind: pendulum")),
              ElementsAre(HasSubstr("a pendulum needs swing_deg")));
  EXPECT_THAT(MessagesOf(Gate("kind: spin, rate_hz: 1, axis: [0, 0, 0]")),
              ElementsAre(HasSubstr("its axis must not be [0, 0, 0]")));
  EXPECT_THAT(MessagesOf(Gate("kind: hinge, moves: [{at_s: 1, over_s: 3, to_deg: 9}, {at_s: 2}]")),
              ElementsAre(HasSubstr("move 1 begins at 2 s, but the one before needs until 4 s")));
  EXPECT_THAT(MessagesOf(Gate("kind: spin, rate_hz: 1, from_s: 2, until_s: 2.1")),
              ElementsAre(HasSubstr("`until_s` must be at least `ramp_s` later than `from_s`")));
  EXPECT_THAT(MessagesOf(Gate("kind: spin, rate_hz: 1, turns: 2")),
              ElementsAre(HasSubstr("turns: unknown key")));
}

TEST(Mechanisms, HaveTheKeysOfTheirOwnJointAlone) {
  EXPECT_THAT(MessagesOf(Gate("kind: hinge, moves: [{at_s: 1, to_m: 1.57}]")),
              ElementsAre(AllOf(HasSubstr("s.yaml:9:106: "),
                                HasSubstr("mechanisms[0].parts[0].joint.moves[0].to_m: a hinge has "
                                          "no to_m, but moves, start_deg, to_deg"))));
  EXPECT_THAT(MessagesOf(Gate("kind: slider, start_deg: 3, moves: [{at_s: 1}, {at_s: 3, to_deg: "
                              "45}]")),
              ElementsAre(HasSubstr("joint.start_deg: a slider has no start_deg"),
                          HasSubstr("joint.moves[1].to_deg: a slider has no to_deg")));
  EXPECT_THAT(MessagesOf(Gate("kind: spin, speed_mps: 0.4")),
              ElementsAre(HasSubstr("joint.speed_mps: a spin has no speed_mps, but rate_hz")));
  EXPECT_THAT(MessagesOf(Gate("kind: belt, rate_hz: 0.4")),
              ElementsAre(HasSubstr("joint.rate_hz: a belt has no rate_hz, but speed_mps")));
  EXPECT_THAT(MessagesOf(Gate("kind: pendulum, swing_m: 0.4")),
              ElementsAre(HasSubstr("joint.swing_m: a pendulum has no swing_m, but swing_deg")));
  EXPECT_THAT(MessagesOf(Gate("kind: chain, axis: [1, 0, 0], swing_deg: 9")),
              ElementsAre(HasSubstr("joint.swing_deg: a chain has no swing_deg, but swing_m")));
  EXPECT_THAT(MessagesOf(Gate("kind: spin, rate_hz: 1, moves: [{at_s: 1, to_deg: 90}]")),
              ElementsAre(HasSubstr("joint.moves: a spin has no moves, but rate_hz")));
  EXPECT_THAT(
      MessagesOf(Gate("rate_hz: 1")),
      ElementsAre(HasSubstr("joint.rate_hz: a fixed joint has no rate_hz; give its `kind`")));
}

TEST(Mechanisms, HaveTheKeysOfTheirOwnShapeAlone) {
  const auto part = [](const std::string& keys) {
    return MessagesOf("mechanisms: [{name: gate, at: [6, 1], parts: [{" + keys + "}]}]\n");
  };
  EXPECT_THAT(part("size_m: [1, 1, 1]"), ElementsAre());
  EXPECT_THAT(part("shape: pallet, goods: drums, goods_m: 0.8"), ElementsAre());
  EXPECT_THAT(part("model: roll_cage, goods: drums"),
              ElementsAre(HasSubstr("mechanisms[0].parts[0].model: a box has no model, but size_m"),
                          HasSubstr("parts[0].goods: a box has no goods, but size_m")));
  EXPECT_THAT(part("shape: model, model: roll_cage, size_m: [1, 1, 1]"),
              ElementsAre(HasSubstr("parts[0].size_m: a model has no size_m, but model")));
  EXPECT_THAT(part("shape: cylinder, goods_m: 1"),
              ElementsAre(HasSubstr("parts[0].goods_m: a cylinder has no goods_m")));
}

TEST(Mechanisms, AreToldWhoIsNotThere) {
  const auto with = [](const std::string& keys) {
    return "mechanisms: [{name: cart, " + keys + ", parts: [{size_m: [1, 1, 1]}]}]\n";
  };
  EXPECT_THAT(MessagesOf(with("level: mid, pushed_by: bea")),
              ElementsAre(HasSubstr("pushed_by: no person named 'bea'")));
  EXPECT_THAT(
      MessagesOf(with("pushed_by: anton")),
      ElementsAre(HasSubstr("its level must be that of the person who brings it, or higher")));
  EXPECT_THAT(
      MessagesOf(with("at: [6, 1], reach_m: 0.3")),
      ElementsAre(HasSubstr("mechanisms[0].reach_m: it has no effect without `pushed_by`")));
  EXPECT_THAT(MessagesOf(with("level: mid, front_by: anton")),
              ElementsAre(HasSubstr("`front_by` and `rear_by` go together")));
  EXPECT_THAT(MessagesOf(with("at: [6, 1], taken: [{by: truck, at_s: 3}]")),
              ElementsAre(HasSubstr("taken[0].by: no vehicle named 'truck'")));
  EXPECT_THAT(MessagesOf(with("at: [60, 1]")),
              ElementsAre(HasSubstr("[60, 1] is outside the hall")));
  EXPECT_THAT(
      MessagesOf("mechanisms: [{name: a, at: [6, 1], parts: [{on: b, size_m: [1, 1, 1]}]}]\n"),
      ElementsAre(HasSubstr("parts[0].on: no earlier part is named 'b'")));
  EXPECT_THAT(MessagesOf("mechanisms: [{name: anton, at: [6, 1], parts: [{size_m: [1, 1, 1]}]}]\n"),
              ElementsAre(HasSubstr("another actor is already named 'anton'")));
}

TEST(Beams, AreToldWhatDoesNotGo) {
  EXPECT_THAT(MessagesOf("beams: [{name: b, at_m: [6, 1, 9]}]\n"),
              ElementsAre(HasSubstr("beams[0].at_m: 9 m is below the floor or above the roof")));
  const auto beam = [](const std::string& keys) {
    return MessagesOf("beams: [{name: b, at_m: [6, 1, 5], " + keys + "}]\n");
  };
  const std::string sun = "kind: sun, elevation_deg: 1, ";
  EXPECT_THAT(beam(sun + "size_m: [1, 1]"), ElementsAre());
  EXPECT_THAT(beam(sun + "rate_hz: 1"),
              ElementsAre(HasSubstr("beams[0].rate_hz: a sun has no rate_hz, but size_m")));
  EXPECT_THAT(beam(sun + "from_s: 3, width_deg: 20"),
              ElementsAre(HasSubstr("beams[0].from_s: a sun has no from_s"),
                          HasSubstr("beams[0].width_deg: a sun has no width_deg")));
  EXPECT_THAT(beam("moves: [{at_s: 3, azimuth_deg: 1, elevation_deg: 9}], in_roof: true"),
              ElementsAre(HasSubstr("beams[0].moves: a spot has no moves, but width_deg"),
                          HasSubstr("beams[0].in_roof: a spot has no in_roof")));
}

TEST(Beams, StopAfterTheyTurnAndStandAboveTheHorizon) {
  const auto beam = [](const std::string& keys) {
    return MessagesOf("beams: [{name: b, at_m: [6, 1, 5], " + keys + "}]\n");
  };
  EXPECT_THAT(beam("rate_hz: 0.5, from_s: 5, until_s: 2"),
              ElementsAre(HasSubstr("beams[0].until_s: must be at least 0.5 s after")));
  EXPECT_THAT(beam("rate_hz: 0.5, from_s: 5, until_s: 5.5"), ElementsAre());
  EXPECT_THAT(beam("rate_hz: 0.5, until_s: 2, elevation_deg: -40"), ElementsAre());
  EXPECT_THAT(beam("kind: sun, elevation_deg: -40"),
              ElementsAre(HasSubstr("beams[0].elevation_deg: the sun must be ")));
  EXPECT_THAT(beam("kind: sun"), ElementsAre(HasSubstr("beams[0].elevation_deg: the sun must be")));
}

TEST(Beams, HaveNamesOfTheirOwn) {
  EXPECT_THAT(MessagesOf("beams: [{name: b, at_m: [6, 1, 5]}, {name: b, at_m: [7, 1, 5]}]\n"),
              ElementsAre(HasSubstr("beams[1].name: another beam is already named 'b'")));
}

TEST(Crowd, IsThreeLinesAndAsBusyAsTheScene) {
  const std::string crowd = "crowd:\n  people: 12\n  in: [4, -2, 13, 2]\n";
  const Scene scene = ParseScene(kHall + crowd, "s.yaml");
  const auto people = [&](Dynamics level) {
    return Seeded(WithDynamics(scene, level), 1).people.size();
  };
  EXPECT_EQ(people(Dynamics::kNone), 0u);
  EXPECT_EQ(people(Dynamics::kLow), 4u);
  EXPECT_EQ(people(Dynamics::kMid), 9u) << "eight and anton";
  EXPECT_EQ(people(Dynamics::kHigh), 13u);
  EXPECT_EQ(Seeded(WithoutActors(scene), 1).people.size(), 0u);
}

TEST(Crowd, WalksInANamedAisle) {
  const Scene scene = ParseScene(kHall + "crowd: {people: 3, between_racks: [0, 1]}\n", "s.yaml");
  const CrowdArea area = CrowdAreaOf(scene);
  EXPECT_NEAR(area.from.y(), -3 + 0.55, 1e-9);
  EXPECT_NEAR(area.to.y(), 3 - 0.55, 1e-9);
  EXPECT_NEAR(area.from.x(), 3, 1e-9);
  EXPECT_NEAR(area.to.x(), 3 + 4 * 2.7, 1e-9);
}

/// Checks that of every usual seed nobody meets anybody.
std::vector<std::string> CrowdAround(const std::string& others) {
  try {
    ParseScene(
        "about: A crowd.\nframes: 160\nrig: {start: [-8.5, -4.5]}\n"
        "hall: {from: [-10, -6], to: [12, 6]}\nlights: [{rows: 1, per_row: 2}]\n"
        "crowd: {people: 6, in: [-4, -3, 10, 3]}\n" +
            others,
        "s.yaml");
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

TEST(Crowd, GoesRoundTheTrailersToo) {
  EXPECT_THAT(
      CrowdAround("vehicles:\n"
                  "  - {name: tractor, model: tow_tractor, start: [8, 0], heading_deg: 180,\n"
                  "     steps: [{go: [[-6, 0]], speed_mps: 1.0}]}\n"
                  "  - {name: t1, model: tow_trailer, start: [9.78, 0], heading_deg: 180,\n"
                  "     towed_by: tractor, behind_m: 1.78}\n"
                  "  - {name: t2, model: tow_trailer, start: [11.3, 0], heading_deg: 180,\n"
                  "     towed_by: tractor, behind_m: 3.3}\n"),
      ElementsAre());
}

const std::string kPushed =
    "vehicles:\n"
    "  - {name: jack, model: pallet_jack, start: [6.85, 0], heading_deg: 180, pushed_by: pusher}\n"
    "people:\n"
    "  - {name: pusher, start: [9, 0], heading_deg: 180,\n"
    "     steps: [{go: [[-5, 0]], speed_mps: 1.0, play: walk_push}]}\n";

TEST(Crowd, GoesRoundWhatIsPushed) { EXPECT_THAT(CrowdAround(kPushed), ElementsAre()); }

TEST(Pushed, AreWhereTheyArePushed) {
  // Within the scene's 8 s the pusher comes to x = 1.8: only the truck before him gets there.
  const std::string bystander = "  - {name: bystander, start: [0.3, 0.2]}\n";
  EXPECT_THAT(CrowdAround(kPushed + bystander),
              ElementsAre(AllOf(HasSubstr("vehicles[0]"), HasSubstr("from bystander"))));
}

TEST(Crowd, IsToldWhatDoesNotGo) {
  EXPECT_THAT(MessagesOf("crowd: {people: 60, in: [4, -1, 6, 1]}\n"),
              ElementsAre(HasSubstr("crowd: with seed 1 there is no room for 60 people")));
  EXPECT_THAT(MessagesOf("crowd: {people: 6, between_racks: [0, 7]}\n"),
              ElementsAre(HasSubstr("racks[7] does not exist; there are 2, counted from 0")));
  EXPECT_THAT(MessagesOf("crowd: {people: 6, between_racks: [1, 1]}\n"),
              ElementsAre(HasSubstr("an aisle lies between two different rows")));
  EXPECT_THAT(MessagesOf("crowd: {people: 6, between_racks: [0.9, 0.2]}\n"),
              ElementsAre(HasSubstr("crowd.between_racks: expected a list of 2 integers")));
  EXPECT_THAT(MessagesOf("crowd: {people: 6, in: [4, -1, 60, 1]}\n"),
              ElementsAre(HasSubstr("[60, 1] is outside the hall")));
  EXPECT_THAT(MessagesOf("crowd: {in: [4, -1, 6, 1]}\n"),
              ElementsAre(HasSubstr("crowd.people: missing key")));
}

}  // namespace
}  // namespace aisle::sim
