#include "harness/report/picture/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace aisle {
namespace {

TEST(SamplesTest, TheFrameWithTheMostMoversIsAmongThem) {
  SamplePictures samples(2);
  const cv::Mat1b left(48, 64, static_cast<unsigned char>(100));
  for (std::size_t i = 0; i < 20; ++i) {
    FrameFacts facts;
    facts.movers_share = i == 13 ? 0.5 : 0.1;
    samples.See(i, 20, left, nullptr, {}, facts);
  }
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("aisle_samples_{}", ::getpid());
  EXPECT_THAT(
      samples.Write(folder),
      testing::ElementsAre("frame_000005.jpg", "frame_000013_most_movers.jpg", "frame_000015.jpg"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace aisle
