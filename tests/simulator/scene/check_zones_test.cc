#include "simulator/scene/check_zones.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// What is wrong with a vehicle's way through a zone; its outline reaches 0.7 m ahead, 0.3 m behind
/// and to the sides.
std::vector<std::string> MessagesOf(const std::string& steps, const std::string& zone) {
  try {
    ParseScene("about: A zone.\nrig: {start: [0, 0], steps: [" + steps +
                   "]}\nhall: {from: [-3, -6], to: [12, 9]}\nlights: [{height_m: 5}]\n" +
                   "drive: {zones: [{name: gate, " + zone + "}]}\n",
               "s.yaml");
  } catch (const SceneError& error) {
    return error.messages();
  }
  return {};
}

TEST(CheckZones, AStepThatIsFasterThanItsZoneIsNamedAndWhere) {
  const std::string slow = "from: [3, -1], to: [5, 1], speed_mps: 0.3";
  EXPECT_THAT(
      MessagesOf("{go: [[8, 0]], speed_mps: 0.8}", slow),
      ElementsAre(testing::AllOf(
          HasSubstr("s.yaml:2:"), HasSubstr("rig.steps[0]"), HasSubstr("from [2."),
          HasSubstr(" to [5.3"),
          HasSubstr("drive.zones[0] (gate), where 0.3 m/s is the limit, but it goes 0.8 m/s"))));
  EXPECT_THAT(MessagesOf("{go: [[8, 0]], speed_mps: 0.3}", slow), IsEmpty());
  const std::string as_advised =
      "{go: [[2.29, 0]], speed_mps: 0.8}, {go: [[5.31, 0]], speed_mps: 0.3}, "
      "{go: [[8, 0]], speed_mps: 0.8}";
  EXPECT_THAT(MessagesOf(as_advised, slow), IsEmpty());
  const std::string late =
      "{go: [[3, 0]], speed_mps: 0.8}, {go: [[5.3, 0]], speed_mps: 0.3}, "
      "{go: [[8, 0]], speed_mps: 0.8}";
  EXPECT_THAT(MessagesOf(late, slow), ElementsAre(HasSubstr("rig.steps[0]"))) << "its nose";
}

TEST(CheckZones, AZoneThatIsNotForVehiclesIsLeftAlone) {
  const std::string go = "{go: [[6, 0]], speed_mps: 0.8}";
  EXPECT_THAT(MessagesOf(go, "from: [3, 0.25], to: [5, 1]"),
              ElementsAre(HasSubstr("which is closed to vehicles")));
  EXPECT_THAT(MessagesOf(go, "from: [5, 1], to: [3, 0.35]"), IsEmpty()) << "beside its way";
  EXPECT_THAT(MessagesOf(go, "from: [6.8, -1], to: [7, 1]"), IsEmpty()) << "beyond its nose";
  EXPECT_THAT(MessagesOf(go + ", {turn_to_deg: 90}", "from: [5.5, 0.65], to: [6.5, 1]"),
              ElementsAre(HasSubstr("rig.steps[1]")))
      << "its nose as it turns";
  EXPECT_THAT(MessagesOf(go, "from: [3.1, -0.05], to: [3.12, -0.03]"),
              ElementsAre(HasSubstr("which is closed to vehicles")))
      << "smaller than the vehicle";
}

}  // namespace
}  // namespace aisle::sim
