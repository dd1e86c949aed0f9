#include "slam/dynamic/robust/disparity_tolerance.h"

#include <gtest/gtest.h>

#include <limits>

namespace aisle::slam::dynamic {
namespace {

const ToleranceOptions kOptions{.sigmas = 3, .share = 0.05};

TEST(DisparityTolerance, WhatIsFarIsToldApartByNoiseWhatIsNearByItsShare) {
  const DisparityTolerance rule(kOptions, 0.1);
  EXPECT_FLOAT_EQ(rule.At(0), 0.3F);
  EXPECT_FLOAT_EQ(rule.At(40), 0.3F + 2);
}

TEST(DisparityTolerance, NoisierDisparitiesAreToldApartLater) {
  const DisparityTolerance sure(kOptions, 0.1), noisy(kOptions, 0.4);
  EXPECT_FALSE(sure.Same(4, 5));
  EXPECT_TRUE(noisy.Same(4, 5));
  EXPECT_TRUE(sure.IsOther(4, 5.5F));
  EXPECT_FALSE(noisy.IsOther(4, 5.5F));
}

TEST(DisparityTolerance, NothingIsTheSameAndAnother) {
  const DisparityTolerance rule(kOptions, 0.1);
  int neither = 0;
  for (float other = 0; other < 20; other += 0.1F) {
    EXPECT_FALSE(rule.Same(8, other) && rule.IsOther(8, other)) << other;
    neither += !rule.Same(8, other) && !rule.IsOther(8, other) ? 1 : 0;
    EXPECT_EQ(rule.IsNearer(8, other), rule.IsOther(8, other) && other > 8) << other;
  }
  EXPECT_GT(neither, 0);  // where nobody can tell
}

TEST(DisparityTolerance, WhatIsNotKnownIsLikeNothing) {
  const DisparityTolerance rule(kOptions, 0.1);
  const float unknown = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(rule.Same(8, unknown));
  EXPECT_FALSE(rule.Same(unknown, 8));
  EXPECT_FALSE(rule.IsNearer(8, unknown));
}

}  // namespace
}  // namespace aisle::slam::dynamic
