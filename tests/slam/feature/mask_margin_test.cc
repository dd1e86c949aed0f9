#include "slam/feature/mask_margin.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace aisle::slam {
namespace {

/// A few rectangles and single pixels, some of them at the image's edge.
cv::Mat1b RandomMask(cv::RNG& random) {
  cv::Mat1b mask(random.uniform(5, 60), random.uniform(5, 60), std::uint8_t{0});
  for (int k = random.uniform(1, 6); k > 0; --k) {
    const cv::Rect block(random.uniform(0, mask.cols), random.uniform(0, mask.rows),
                         random.uniform(1, 5), random.uniform(1, 5));
    mask(block & cv::Rect({0, 0}, mask.size())) = 255;
  }
  return mask;
}

TEST(MaskMargin, SaysWhatTheDistanceOfEveryPixelSays) {
  cv::RNG random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const cv::Mat1b mask = RandomMask(random);
    cv::Mat1f distance;
    cv::distanceTransform(mask == 0, distance, cv::DIST_L2, cv::DIST_MASK_3);
    const MaskMargin margin(mask);
    const double radius = random.uniform(0.0, 15.0);
    const Disc disc = ChamferDisc(radius);
    for (int y = 0; y < mask.rows; ++y) {
      for (int x = 0; x < mask.cols; ++x) {
        ASSERT_EQ(margin.Reaches({x, y}, disc), distance(y, x) <= radius)
            << "trial " << trial << ", pixel " << x << " " << y << ", radius " << radius
            << ", distance " << distance(y, x);
      }
    }
  }
}

TEST(MaskMargin, ReachesNothingWhereNothingIsRejected) {
  const Disc disc = ChamferDisc(100);
  EXPECT_FALSE(MaskMargin(cv::Mat1b()).Reaches({3, 4}, disc));
  const MaskMargin none(cv::Mat1b(10, 10, std::uint8_t{0}));
  EXPECT_TRUE(none.rejects_nothing());
  EXPECT_FALSE(none.Reaches({3, 4}, disc));
}

TEST(MaskMargin, ADiscOfNoRadiusIsItsCentre) {
  EXPECT_EQ(ChamferDisc(0), Disc{0});
  cv::Mat1b mask(3, 3, std::uint8_t{0});
  mask(1, 1) = 255;
  EXPECT_TRUE(MaskMargin(mask).Reaches({1, 1}, {0}));
  EXPECT_FALSE(MaskMargin(mask).Reaches({1, 0}, {0}));
}

TEST(MaskedArea, ItsMarginIsOfTheLevelsOwnPixels) {
  cv::Mat1b mask(40, 40, std::uint8_t{0});
  mask(20, 20) = 255;
  const FeatureOptions options{.levels = 3, .scale = 2, .mask_margin_px = 3};
  const MaskedArea masked(mask, options);
  for (int level = 0; level < options.levels; ++level) {
    const int margin_px = 3 << level;  // a step along an axis is 0.955 pixels long
    EXPECT_TRUE(masked.Contains({20 + margin_px, 20}, level)) << level;
    EXPECT_FALSE(masked.Contains({21 + margin_px, 20}, level)) << level;
  }
  EXPECT_FALSE(masked.empty());
  EXPECT_TRUE(MaskedArea({}, options).empty());
}

}  // namespace
}  // namespace aisle::slam
