#include "slam/dynamic/robust/dense_frame.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "slam/stereo/dense/disparity_image.h"
#include "slam/stereo/dense/semi_global.h"

namespace aisle::slam::dynamic {
namespace {

/// Grey of all scales, the same for the same seed.
cv::Mat1b Cloth(cv::Size size, std::uint64_t seed) {
  cv::RNG random(seed);
  cv::Mat1f cloth(size, 0.0F);
  for (const int cell : {2, 6, 18}) {
    cv::Mat1f noise(size.height / cell + 1, size.width / cell + 1);
    random.fill(noise, cv::RNG::UNIFORM, -1, 1);
    cv::Mat1f grown;
    cv::resize(noise, grown, size, 0, 0, cv::INTER_CUBIC);
    cloth += 30 * grown;
  }
  cv::Mat1b grey;
  cloth.convertTo(grey, CV_8U, 1, 128);
  return grey;
}

/// A wall at 12 pixels of disparity; in the rows of `near_rows` something at 260, all along.
std::pair<cv::Mat1b, cv::Mat1b> PairWithSomethingNear(const cv::Range& near_rows) {
  constexpr int kWall = 12, kNear = 260;
  const cv::Size size(752, 480);
  const cv::Mat1b wide = Cloth({size.width + kNear, size.height}, 1);
  std::pair<cv::Mat1b, cv::Mat1b> pair{wide.colRange(0, size.width).clone(),
                                       wide.colRange(kWall, kWall + size.width).clone()};
  wide.colRange(kNear, kNear + size.width)
      .rowRange(near_rows)
      .copyTo(pair.second.rowRange(near_rows));
  return pair;
}

TEST(HalfImage, PixelsAreTwoByTwoWhereTheSizeIsOddToo) {
  const cv::Mat1b image = Cloth({1241, 375}, 2);
  const cv::Mat1b half = HalfImage(image);
  ASSERT_EQ(half.size(), cv::Size(620, 187));
  for (const cv::Point at : {cv::Point(0, 0), cv::Point(310, 93), cv::Point(619, 186)}) {
    const double mean = cv::mean(image(cv::Rect(2 * at.x, 2 * at.y, 2, 2)))[0];
    EXPECT_NEAR(half(at), mean, 0.51) << at;
  }
}

TEST(MakeDenseFrame, SeesWhatIsNearerThanTheSearchReaches) {
  const auto [left, right] = PairWithSomethingNear({160, 400});
  const DenseFrame frame = MakeDenseFrame(HalfImage(left), HalfImage(right), {});
  int near = 0, wall = 0, chance = 0;
  for (int x = 150; x < 370; ++x) {
    near += std::abs(frame.disparity(140, x) - 130) < 1;
    wall += std::abs(frame.disparity(40, x) - 6) < 0.5F;
  }
  EXPECT_GT(near, 200);
  EXPECT_GT(wall, 200);
  // What the right camera does not see of it has no disparity; it goes on all the same.
  for (int x = 0; x < 120; ++x) chance += frame.disparity(140, x) >= 0;
  EXPECT_LT(chance, 6);
  EXPECT_NEAR(frame.unseen[140], 134, 6);
  EXPECT_NEAR(frame.unseen[40], 10, 6);
  EXPECT_NEAR(frame.filled(140, 60), 130, 1);
  EXPECT_NEAR(frame.filled(40, 60), 6, 0.5);
}

/// What the right camera shows at its left edge looks like what the left one does, as if it were
/// infinitely far; images of half the size cannot tell so close to the edge.
TEST(MakeDenseFrame, AChanceMatchOfNoDisparityAtAllIsNoneToo) {
  const auto [left, right] = PairWithSomethingNear({160, 400});
  const cv::Rect edge(0, 160, 24, 240);
  left(edge).copyTo(right(edge));
  const DenseFrame frame = MakeDenseFrame(HalfImage(left), HalfImage(right), {});
  ASSERT_GT(frame.unseen[140], 20);
  for (int x = 0; x < 2 * kMatchReach; ++x) EXPECT_LT(frame.disparity(140, x), 0) << x;
}

TEST(FillRows, TakesTheFartherSideOfAGapButGoesOnWhereOneCameraSees) {
  cv::Mat1f disparity(2, 8, kNoDisparity);
  for (int y = 0; y < 2; ++y) {
    disparity(y, 0) = 2;
    disparity(y, 5) = 90;
  }
  const cv::Mat1f filled = FillRows(disparity, {0, 5});
  EXPECT_EQ(filled(0, 3), 2);
  EXPECT_EQ(filled(1, 3), 90);
  EXPECT_EQ(filled(1, 0), 2);
  EXPECT_EQ(filled(1, 7), 90);
}

}  // namespace
}  // namespace aisle::slam::dynamic
