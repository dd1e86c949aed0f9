#include "harness/io/features_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

class FeaturesCsvTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  std::map<std::int64_t, FrameFeatures> Read(const std::string& text) const {
    WriteFileAtomically(file_, text);
    return ReadFeatures(file_);
  }
  std::string Complaint(const std::string& text) const {
    try {
      Read(text);
    } catch (const InputError& wrong) {
      return wrong.what();
    }
    return "";
  }
  const std::filesystem::path file_ =
      std::filesystem::temp_directory_path() / fmt::format("aisle_features_{}.csv", ::getpid());
};

TEST_F(FeaturesCsvTest, RowsGoToTheirFrames) {
  const auto features = Read("frame,u,v,used\n0,1.5,2,1\n# a remark\n2, 7 , 8 ,0\r\n0,3,4\n");
  ASSERT_EQ(features.size(), 2u);
  EXPECT_EQ(features.at(0).points.at(0), cv::Point2f(1.5F, 2));
  EXPECT_EQ(features.at(0).used, (std::vector<bool>{true, true}));  // where nothing is said
  EXPECT_EQ(features.at(2).used, (std::vector<bool>{false}));
}

TEST_F(FeaturesCsvTest, WhatIsNoKeypointIsNamedByItsLine) {
  for (const char* line : {"x,1,2,1", "0,1", "0,nan,2,1", "0,1,2,1,5", "-1,1,2,1", "0,1e9,2,1",
                           "0.5,1,2,1", "0,1,2,7", "0;1;2"}) {
    EXPECT_THAT(Complaint(std::string("0,1,2,1\n") + line + "\n"), testing::HasSubstr(":2: "))
        << line;
  }
}

}  // namespace
}  // namespace aisle
