#include "harness/campaign/ros_domain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>

#include "harness/io/file.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

class RosDomainTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_ros_{}", ::getpid());
    for (const char* name : kNames) ::unsetenv(name);
  }
  void TearDown() override {
    for (const char* name : kNames) ::unsetenv(name);
    RemoveFolder(folder_);
  }

  static constexpr const char* kNames[] = {"ROS_DOMAIN_ID", "ROS_LOCALHOST_ONLY",
                                           "ROS_AUTOMATIC_DISCOVERY_RANGE"};
  fs::path folder_;
};

TEST_F(RosDomainTest, RunsAtTheSameTimeHaveTheirOwn) {
  const RosDomain first(folder_);
  EXPECT_EQ(first.number(), 1);
  EXPECT_THAT(first.Variables(), ElementsAre("ROS_DOMAIN_ID=1", "ROS_LOCALHOST_ONLY=1"));
  { EXPECT_EQ(RosDomain(folder_).number(), 2); }
  EXPECT_EQ(RosDomain(folder_).number(), 2) << "one that has ended leaves its number";
}

TEST_F(RosDomainTest, WhatTheUserHasChosenStays) {
  const RosDomain domain(folder_);
  ::setenv("ROS_DOMAIN_ID", "42", 1);
  EXPECT_THAT(domain.Variables(), ElementsAre("ROS_LOCALHOST_ONLY=1"));
  ::setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "SUBNET", 1);
  EXPECT_THAT(domain.Variables(), IsEmpty());
}

TEST_F(RosDomainTest, WithoutAPlaceForLocksThereIsOneAllTheSame) {
  WriteFileAtomically(folder_, "a file in the way");
  const RosDomain domain(folder_);
  EXPECT_GE(domain.number(), 1);
  EXPECT_LE(domain.number(), 101);
}

}  // namespace
}  // namespace aisle
