#include "simulator/scene/check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

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
                                      "4.2 m, its wall from -2 to 4")));
  }
  for (const std::string wall : {"north", "south"}) {
    EXPECT_THAT(MessagesOfDoor("width_m: 2, wall: " + wall + ", at_m: 3.2"), IsEmpty());
    EXPECT_THAT(MessagesOfDoor("width_m: 2, wall: " + wall + ", at_m: -3.2"),
                ElementsAre(HasSubstr("from x -4.2 to -2.2 m, its wall from -4 to 6")));
  }
  EXPECT_THAT(MessagesOfDoor("at_m: 500"), ElementsAre(HasSubstr("doors[0].at_m")));
}

TEST(Doors, AreNoHigherThanTheHall) {
  EXPECT_THAT(MessagesOfDoor("height_m: 3.5"), IsEmpty());
  EXPECT_THAT(MessagesOfDoor("height_m: 3.6"),
              ElementsAre(HasSubstr("doors[0].height_m: its opening of 3.6 m goes through the roof "
                                    "at 3.5 m")));
}

TEST(Props, StandBelowTheRoof) {
  EXPECT_THAT(MessagesOf("props: [{model: drum, at: [3, 1], above_m: 3}]\n"), IsEmpty());
  EXPECT_THAT(MessagesOf("props: [{model: drum, at: [3, 1], above_m: 20}]\n"),
              ElementsAre(HasSubstr("props[0].above_m: 20 m is above the roof at 3.5 m")));
}

}  // namespace
}  // namespace aisle::sim
