#include "harness/plugs/cached_drive.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/file.h"
#include "tests/harness/loop/fake_drive_scene.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

/// Pictures that show where and when they were taken.
class Counting : public FakeDriveScene {
 public:
  explicit Counting(int* made) : made_(made) {}
  SequenceFrame Take(const Exposure& exposure) const override {
    ++*made_;
    SequenceFrame frame = FakeDriveScene::Take(exposure);
    const auto grey = static_cast<std::uint8_t>(exposure.T_world_rig.translation().x() * 50);
    frame.images.left.setTo(grey);
    frame.images.right.setTo(grey + 1);
    return frame;
  }

 private:
  int* made_;
};

class CachedDriveTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_cached_drive_{}", ::getpid());
  }
  void TearDown() override { RemoveFolder(folder_); }

  static Exposure At(std::int64_t id, double x) {
    Exposure exposure{.id = id, .stamp_ns = id * 50'000'000};
    exposure.T_world_rig.translation() << x, 0.1 / 3, 0.7;
    return exposure;
  }

  fs::path folder_;
  int made_ = 0;
};

TEST_F(CachedDriveTest, APictureFromTheSamePlaceIsTakenOnce) {
  const auto scene = WithKeptFrames(std::make_unique<Counting>(&made_), FrameStore(folder_));
  const auto again = WithKeptFrames(std::make_unique<Counting>(&made_), FrameStore(folder_));
  const SequenceFrame first = scene->Take(At(1'000'003, 1.0 / 3));
  const SequenceFrame second = again->Take(At(1'000'003, 1.0 / 3));
  EXPECT_EQ(made_, 1);
  EXPECT_EQ(cv::norm(first.images.left, second.images.left, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(first.images.right, second.images.right, cv::NORM_INF), 0);
  EXPECT_EQ(second.truth->T_world_rig.matrix(), first.truth->T_world_rig.matrix());
}

TEST_F(CachedDriveTest, OneFromElsewhereOrAnotherTimeIsTakenAnewAndKeptInItsStead) {
  const auto scene = WithKeptFrames(std::make_unique<Counting>(&made_), FrameStore(folder_));
  scene->Take(At(7, 1));
  EXPECT_EQ(scene->Take(At(7, 2)).images.left(0, 0), 100);
  EXPECT_EQ(made_, 2);
  Exposure later = At(7, 2);
  ++later.stamp_ns;
  scene->Take(later);
  EXPECT_EQ(made_, 3);
  scene->Take(later);
  EXPECT_EQ(made_, 3);
}

TEST_F(CachedDriveTest, WhatIsNoPictureIsTheScenesOwn) {
  const auto scene = WithKeptFrames(std::make_unique<Counting>(&made_), FrameStore(folder_));
  const FakeDriveScene own;
  EXPECT_EQ(scene->rate_hz(), own.rate_hz());
  EXPECT_EQ(scene->Stamp(3), own.Stamp(3));
  EXPECT_EQ(scene->course().planned_s, own.course().planned_s);
  EXPECT_EQ(scene->calibration().width, own.calibration().width);
}

}  // namespace
}  // namespace aisle
