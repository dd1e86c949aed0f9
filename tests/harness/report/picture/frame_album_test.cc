#include "harness/report/picture/frame_album.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

using testing::Contains;
using testing::IsEmpty;
using testing::SizeIs;

class FrameAlbumTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// A drive of 200 frames, most movers in frame 130; what it left, with these errors by frame.
  std::vector<std::string> Driven(FramesKept kept, const std::map<std::size_t, double>& error_m) {
    FrameAlbum album(kept);
    const cv::Mat1b left(48, 64, static_cast<unsigned char>(100));
    for (std::size_t i = 0; i < 200; ++i) {
      FrameFacts facts;
      facts.movers_share = i == 130 ? 0.5 : 0.1;
      album.See(i, 200, left, nullptr, {}, facts);
    }
    return album.Write(folder_, error_m);
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / fmt::format("aisle_album_{}", ::getpid());
};

TEST_F(FrameAlbumTest, TheWorstFrameAndThoseAroundItAreAmongTheTwoDozen) {
  const auto names = Driven(FramesKept::kWorst, {{70, 0.1}, {72, 0.9}, {74, 0.2}});
  EXPECT_THAT(names, Contains("frame_000072_worst_error.jpg"));
  EXPECT_THAT(names, Contains("frame_000070.jpg"));
  EXPECT_THAT(names, Contains("frame_000074.jpg"));
  EXPECT_THAT(names, Contains("frame_000130_most_movers.jpg"));
  EXPECT_LE(names.size(), 24u);
  for (const std::string& name : names) EXPECT_TRUE(std::filesystem::exists(folder_ / name));
}

TEST_F(FrameAlbumTest, KeepsWhatItWasAskedFor) {
  EXPECT_THAT(Driven(FramesKept::kAll, {}), SizeIs(100));
  EXPECT_THAT(Driven(FramesKept::kNone, {{72, 0.9}}), IsEmpty());
}

TEST_F(FrameAlbumTest, TheThreeWaysHaveNames) {
  for (const FramesKept kept : {FramesKept::kNone, FramesKept::kWorst, FramesKept::kAll}) {
    EXPECT_EQ(FramesKeptFromName(Name(kept)), kept);
  }
  EXPECT_THROW(FramesKeptFromName("some"), InputError);
}

}  // namespace
}  // namespace aisle
