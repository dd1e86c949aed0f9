#include "harness/campaign/guest_output.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class GuestOutputTest : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(from_ / "masks"); }
  void TearDown() override { fs::remove_all(folder_); }
  std::vector<std::string> Take() const { return TakeLeftovers(from_, {"1600", "1650"}, to_); }
  static StereoFrame Frame(std::int64_t id) { return {id, 50 * id, cv::Mat1b(4, 6), {}}; }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_guest_{}", ::getpid());
  const fs::path from_ = folder_ / "from", to_ = folder_ / "to";
};

TEST_F(GuestOutputTest, KeypointsAndMasksComeBackFrameByFrame) {
  WriteFileAtomically(from_ / "features.csv", "1,2,3,1\n1,4,5,0\n");
  cv::Mat1b mask(4, 6, static_cast<unsigned char>(0));
  mask(2, 3) = 9;
  WriteImage(from_ / "masks" / "1650.png", mask);  // by its stamp
  EXPECT_THAT(Take(), IsEmpty());
  const Leftovers left(to_);
  EXPECT_TRUE(left.any());
  const FrameEstimate seen = left(Frame(1));
  EXPECT_THAT(seen.keypoints, SizeIs(2));
  EXPECT_EQ(seen.counts.at("inliers"), 1);
  EXPECT_EQ(seen.regions.mask(2, 3), 255);
  EXPECT_TRUE(left(Frame(0)).regions.mask.empty());
}

TEST_F(GuestOutputTest, NothingLeftIsNothingToTell) {
  fs::remove_all(from_ / "masks");
  EXPECT_THAT(Take(), IsEmpty());
  EXPECT_FALSE(Leftovers(to_).any());
}

TEST_F(GuestOutputTest, WhatLeadsElsewhereIsNotFollowed) {
  WriteFileAtomically(folder_ / "secret.csv", "1,2,3,1\n");
  fs::create_symlink("../secret.csv", from_ / "features.csv");
  fs::remove_all(from_ / "masks");
  fs::create_symlink("/etc", from_ / "masks");
  WriteFileAtomically(folder_ / "secret.png", "no image");
  const std::vector<std::string> troubles = Take();
  ASSERT_THAT(troubles, SizeIs(1));  // /etc holds no mask of these names
  EXPECT_THAT(troubles[0], HasSubstr("link out of its folder"));
  EXPECT_FALSE(fs::exists(to_ / "features.csv"));
}

TEST_F(GuestOutputTest, NonsenseIsNamed) {
  WriteFileAtomically(from_ / "features.csv", "hello\n");
  EXPECT_THAT(Take(), IsEmpty());
  EXPECT_THROW(Leftovers{to_}, InputError);
  fs::remove(to_ / "features.csv");
  WriteFileAtomically(from_ / "masks" / "000000.png", "no image");
  fs::remove(from_ / "features.csv");
  EXPECT_THAT(Take(), IsEmpty());
  EXPECT_THROW(Leftovers{to_}(Frame(0)), InputError);
}

}  // namespace
}  // namespace aisle
