#include "harness/bag/bag_wheels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/bag/frame_messages.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr std::int64_t kStart = 1'600'000'000'000'000'000, kStepNs = 20'000'000;

struct Link {
  std::string parent, child;
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  double yaw = 0;
};

Eigen::Isometry3d PoseOf(const Link& link) {
  Eigen::Isometry3d pose(Eigen::Translation3d(link.offset_m));
  pose.rotate(Eigen::AngleAxisd(link.yaw, Eigen::Vector3d::UnitZ()));
  return pose;
}

/// A robot's bag: its wheels at 50 Hz, one picture, and the frames of its body.
struct RobotBag {
  std::string base = "base_link", image_frame = "left_optical";
  std::vector<Link> links = {{"base_footprint", "base_link", {0, 0, 0.2}, 0},
                             {"base_link", "mast", {0.3, 0.1, 1}, 0.5},
                             {"mast", "left_optical", {0.05, 0, 0.1}, -0.2},
                             {"base_link", "laser", {0.2, 0, 0.1}, 0}};
  double variance = 1e-4;                                            ///< of every part of the twist
  std::vector<std::pair<std::pair<int, int>, double>> entries = {};  ///< of one message's instead
  bool second_body = false;

  void Write(const fs::path& file) const {
    McapWriter writer(file);
    const auto odom = writer.AddChannel<ros::Odometry>("/odom");
    for (int k = 0; k < 10; ++k) {
      ros::Header header;
      header.stamp = ros::TimeOf(kStart + k * kStepNs);
      header.frame_id = "odom";
      OdometryReading reading;
      reading.T_odom_base.translation().x() = 0.02 * k;
      reading.twist_covariance.diagonal().setConstant(k == 0 ? 0 : variance);  // it has just begun
      for (const auto& [at, value] : entries) {
        if (k == 4) reading.twist_covariance(at.first, at.second) = value;
      }
      const std::string body = second_body && k == 5 ? "trailer" : base;
      writer.Write(odom, kStart + k * kStepNs, OdometryMessage(header, body, reading));
    }
    ros::Image picture = ImageMessage({}, cv::Mat1b(4, 4, static_cast<uchar>(9)));
    picture.header.frame_id = image_frame;
    writer.Write(writer.AddChannel<ros::Image>("/left/image_rect"), kStart, picture);
    if (!links.empty()) {
      ros::TFMessage frames;
      for (const Link& link : links) {
        ros::TransformStamped one;
        one.header.frame_id = link.parent;
        one.child_frame_id = link.child;
        one.transform = ros::TransformOf(PoseOf(link));
        frames.transforms.push_back(one);
      }
      writer.Write(writer.AddChannel<ros::TFMessage>("/tf_static"), kStart, frames);
    }
    writer.Finish();
  }
};

class BagWheelsTest : public testing::Test {
 protected:
  BagWheelsTest()
      : folder_(fs::temp_directory_path() / fmt::format("aisle_wheels_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~BagWheelsTest() override { fs::remove_all(folder_); }

  WheelTrack Read(const RobotBag& robot, const std::string& topic = "/odom") const {
    const fs::path file = folder_ / "drive.mcap";
    robot.Write(file);
    return ReadBagWheels(*OpenBag(file), topic, "/left/image_rect", "drive.mcap");
  }
  std::string WhyNot(const RobotBag& robot, const std::string& topic = "/odom") const {
    try {
      Read(robot, topic);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  const fs::path folder_;
};

TEST_F(BagWheelsTest, PosesComeWithTheCameraThatStandsOnTheBody) {
  const RobotBag robot;
  const WheelTrack track = Read(robot);
  ASSERT_EQ(track.poses.size(), 10u);
  EXPECT_EQ(track.poses[3].stamp_ns, kStart + 3 * kStepNs);
  EXPECT_NEAR(track.poses[3].T_world_rig.translation().x(), 0.06, 1e-12);
  EXPECT_TRUE(track.T_base_left.isApprox(PoseOf(robot.links[1]) * PoseOf(robot.links[2]), 1e-12));
}

/// Wheels may speak of another frame of the body than the one that the camera hangs on.
TEST_F(BagWheelsTest, FramesAreJoinedUpAndDown) {
  RobotBag robot;
  robot.base = "laser";
  EXPECT_TRUE(Read(robot).T_base_left.isApprox(
      PoseOf(robot.links[3]).inverse() * PoseOf(robot.links[1]) * PoseOf(robot.links[2]), 1e-12));
  robot.base = "/base_footprint";  // as ROS 1 wrote it
  EXPECT_TRUE(Read(robot).T_base_left.isApprox(
      PoseOf(robot.links[0]) * PoseOf(robot.links[1]) * PoseOf(robot.links[2]), 1e-12));
}

TEST_F(BagWheelsTest, CovarianceOfAMotionIsTheTwistsTimesItsTime) {
  const WheelTrack track = Read({});
  ASSERT_EQ(track.covariances.size(), 10u);
  EXPECT_TRUE(track.covariances[4].isApprox(
      1e-4 * 0.02 * 0.02 * Eigen::Matrix<double, 6, 6>::Identity(), 1e-6));
  RobotBag silent;
  silent.variance = 0;  // the usual way to say nothing
  EXPECT_TRUE(Read(silent).covariances.empty());
}

/// As sensor_msgs/Imu has it in writing, and as simulators write what they do not measure.
TEST_F(BagWheelsTest, WhatRosCallsUnknownIsUnknown) {
  RobotBag robot;
  robot.entries = {{{0, 0}, -1}};
  EXPECT_TRUE(Read(robot).covariances.empty()) << "not available";
  robot.entries = {{{2, 2}, 0}};
  EXPECT_TRUE(Read(robot).covariances.empty()) << "nothing can be weighed by a variance of zero";
  robot.entries = {{{2, 2}, 1e12}, {{0, 5}, 5e-5}, {{5, 0}, 5e-5}};
  const WheelTrack track = Read(robot);
  ASSERT_EQ(track.covariances.size(), 10u);
  EXPECT_NEAR(track.covariances[4](2, 2), 1e12 * 0.02 * 0.02, 1);
  EXPECT_NEAR(track.covariances[4](0, 5), 5e-5 * 0.02 * 0.02, 1e-12);
}

TEST_F(BagWheelsTest, CovariancesThatNoMotionHasAreNamed) {
  const auto why_not = [&](const decltype(RobotBag::entries)& entries) {
    RobotBag robot;
    robot.entries = entries;
    return WhyNot(robot);
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(why_not({{{0, 1}, nan}}),
              HasSubstr("drive.mcap: twist.covariance of the message of /odom at "
                        "1600000000.080000000 s: [1] is nan, not a finite number"));
  EXPECT_THAT(why_not({{{5, 5}, -1e-4}}), HasSubstr("[35] is -0.0001, but a variance is from 0"));
  EXPECT_THAT(why_not({{{1, 1}, 1e300}}), HasSubstr("[7] is 1e+300, but a variance is from 0"));
  EXPECT_THAT(why_not({{{0, 5}, 5e-5}}), HasSubstr("[30] is 0 and [5] is 5e-05"));
  EXPECT_THAT(why_not({{{0, 5}, 1}, {{5, 0}, 1}}), HasSubstr("[30] is 1, more than"));
  EXPECT_THAT(why_not({{{0, 1}, 9e-5},
                       {{1, 0}, 9e-5},
                       {{1, 2}, 9e-5},
                       {{2, 1}, 9e-5},
                       {{0, 2}, -9e-5},
                       {{2, 0}, -9e-5}}),
              HasSubstr("not positive semidefinite"));
}

TEST_F(BagWheelsTest, MistakesAreNamed) {
  EXPECT_THAT(
      WhyNot({}, "/odm"),
      HasSubstr("no nav_msgs/Odometry on /odm (did you mean /odom?); topics of that type: /odom"));
  RobotBag robot;
  robot.links.clear();
  EXPECT_THAT(WhyNot(robot), HasSubstr("as the bag has none: record /tf_static as well"));
  robot = {};
  robot.image_frame = "camera";
  EXPECT_THAT(WhyNot(robot), HasSubstr("from the wheels' frame 'base_link' to the left image's "
                                       "'camera'; it connects base_footprint, base_link, laser"));
  robot = {};
  robot.links[0] = {"left_optical", "base_link"};
  EXPECT_THAT(WhyNot(robot), HasSubstr("form a cycle"));
  robot = {};
  robot.second_body = true;
  EXPECT_THAT(WhyNot(robot), HasSubstr("is about two bodies, 'base_link' and 'trailer'"));
}

}  // namespace
}  // namespace aisle
