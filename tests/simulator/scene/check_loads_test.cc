#include "simulator/scene/check_loads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string kRoom =
    "about: Loads are held.\nframes: 100\nrig: {start: [-3, 0], steps: [{go: [[-2, 0]]}]}\n"
    "hall: {from: [-5, -8], to: [20, 8]}\nlights: [{height_m: 5}]\n";
const std::string kDrive =
    "drive: {kind: differential, footprint_m: [[-0.3, -0.3], [0.3, -0.3], [0.3, 0.3], "
    "[-0.3, 0.3]]}\n";

std::vector<std::string> MessagesOf(const std::string& text) {
  try {
    ParseScene(kRoom + text, "s.yaml");
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

/// Two people with a long box between them; `rear` and `front` are keys of theirs.
std::string Carried(const std::string& rear, const std::string& front) {
  return "people:\n"
         "  - {name: anton, model: worker_anton, start: [3, 1], steps: [{go: [[9, 1]], speed_mps: "
         "0.8, play: walk_carry}]" +
         rear +
         "}\n"
         "  - {name: bea, model: worker_bea, start: [6.2, 1], heading_deg: 180, steps: [{go: "
         "[[12.2, 1]], speed_mps: 0.8, play: walk_carry, reverse: true}]" +
         front +
         "}\n"
         "mechanisms: [{name: crate, front_by: bea, rear_by: anton, parts: [{}]}]\n";
}

TEST(Loads, OfTwoPeopleOfWhomOneMayWaitAreNamed) {
  const std::string yields = ", yields: true";
  for (const std::string& text :
       {Carried(yields, ""), Carried("", yields), Carried(yields, yields)}) {
    EXPECT_THAT(MessagesOf(text + kDrive),
                ElementsAre(HasSubstr("mechanisms[0]: 'bea' and 'anton' carry it")));
    EXPECT_THAT(MessagesOf(text), IsEmpty()) << "nobody yields to a rig on its route";
  }
  EXPECT_THAT(MessagesOf(Carried("", "") + kDrive), IsEmpty());
}

/// Two trucks, and a pallet that each has for a while.
std::string Taken(const std::string& first, const std::string& second, const std::string& by) {
  return "vehicles:\n"
         "  - {name: one, model: forklift, start: [5, -3], heading_deg: 90, steps: [{wait_s: 9}]" +
         first +
         "}\n"
         "  - {name: other, model: forklift, start: [12, -3], heading_deg: 90, steps: [{wait_s: "
         "9}]" +
         second +
         "}\n"
         "mechanisms: [{name: load, at: [5, 1], parts: [{shape: pallet}], taken: [{by: one, at_s: "
         "1, until_s: 2}, {by: " +
         by + ", at_s: 3}]}]\n";
}

TEST(Loads, ThatTwoTrucksTakeOfWhichOneMayWaitAreNamed) {
  const std::string yields = ", yields: true";
  for (const std::string& text : {Taken(yields, "", "other"), Taken("", yields, "other")}) {
    EXPECT_THAT(MessagesOf(text + kDrive),
                ElementsAre(HasSubstr("mechanisms[0]: 'one' and 'other' carry it")));
  }
  EXPECT_THAT(MessagesOf(Taken("", "", "other") + kDrive), IsEmpty());
  EXPECT_THAT(MessagesOf(Taken(yields, "", "one") + kDrive), IsEmpty())
      << "twice by the same: it waits with it";
}

}  // namespace
}  // namespace aisle::sim
