#include "simulator/scene/bag_poses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "simulator/scene/essence.h"
#include "simulator/scene/load.h"

namespace aisle::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A bag of a vehicle that goes straight ahead at a speed.
BagPoseReader Ahead(double speed_mps) {
  return [speed_mps](const std::string&) {
    std::vector<TimedPose> poses;
    for (int k = 0; k <= 10; ++k) {
      TimedPose pose{100'000'000 * k, Eigen::Isometry3d::Identity()};
      pose.T_world_body.translation().x() = 0.1 * k * speed_mps;
      poses.push_back(pose);
    }
    return poses;
  };
}

class BagPosesTest : public testing::Test {
 protected:
  BagPosesTest()
      : folder_(std::filesystem::temp_directory_path() / fmt::format("aisle_bags_{}", ::getpid())),
        file_((folder_ / "scene.yaml").string()) {
    std::filesystem::create_directories(folder_);
    std::ofstream(file_) << "about: A bag.\nframes: 20\nrate_hz: 20\n"
                            "rig: {trajectory: drive.mcap:/odom, trajectory_of: vehicle}\n"
                            "hall: {from: [-5, -8], to: [20, 8]}\n"
                            "lights: [{rows: 2, per_row: 3}]\n";
  }
  ~BagPosesTest() override { std::filesystem::remove_all(folder_); }

  const std::filesystem::path folder_;
  const std::string file_;
};

TEST_F(BagPosesTest, EachReadingOfASceneHasAReaderOfItsOwn) {
  std::string asked;
  const Scene slow = LoadScene(file_, [&](const std::string& file_and_topic) {
    asked = file_and_topic;
    return Ahead(1)(file_and_topic);
  });
  EXPECT_EQ(asked, (folder_ / "drive.mcap:/odom").string());
  const Scene fast = LoadScene(file_, Ahead(2));
  EXPECT_EQ(slow.rig.poses.back().T_world_body.translation().x(), 1);
  EXPECT_EQ(fast.rig.poses.back().T_world_body.translation().x(), 2);
  EXPECT_NE(EssenceOf(file_, true, Ahead(1)), EssenceOf(file_, true, Ahead(2)));
  // One that was there before leaves nothing behind.
  EXPECT_THAT(CheckScene(file_), ElementsAre(HasSubstr("this program cannot read bags")));
}

TEST_F(BagPosesTest, ThoseOfABagThatCannotBeDrivenAreAMistakeOfTheScene) {
  const auto why_not = [&](const BagPoseReader& bags) {
    return fmt::format("{}", fmt::join(CheckScene(file_, bags), "\n"));
  };
  EXPECT_EQ(why_not(Ahead(1)), "");
  const auto broken = [](const std::string& bag) -> std::vector<TimedPose> {
    throw std::runtime_error(bag + ": ends too early");
  };
  EXPECT_THAT(why_not(broken), HasSubstr("drive.mcap:/odom: ends too early"));
  EXPECT_THAT(why_not([](const std::string&) { return std::vector<TimedPose>(); }),
              HasSubstr("no poses"));
  const auto twice = [](const std::string&) { return std::vector<TimedPose>(2); };
  EXPECT_THAT(why_not(twice), HasSubstr("timestamps do not increase"));
  const auto nowhere = [](const std::string&) {
    std::vector<TimedPose> poses(1);
    poses[0].T_world_body.translation().x() = std::numeric_limits<double>::quiet_NaN();
    return poses;
  };
  EXPECT_THAT(why_not(nowhere), HasSubstr("a pose is not finite"));
}

TEST(SplitBagTopic, TakesATopicBehindABagAlone) {
  using Split = std::pair<std::string, std::string>;
  EXPECT_EQ(SplitBagTopic("drive.mcap:/odom"), Split("drive.mcap", "/odom"));
  EXPECT_EQ(SplitBagTopic("drive.db3:/a/b"), Split("drive.db3", "/a/b"));
  EXPECT_EQ(SplitBagTopic("drive.txt"), Split("drive.txt", ""));
}

}  // namespace
}  // namespace aisle::sim
