#include "slam/stereo/parabola_alignment.h"

#include <gtest/gtest.h>

#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {
namespace {

const StereoOptions kPublished{.patch_radius_px = 5};

/// A wall `shift_px` further left in the right camera, without noise, and `brighter` there.
std::optional<RowAlignment> Align(double shift_px, double start_off_px, double brighter = 0) {
  const Texture texture(3);
  const auto see = [&](double shift, double add) {
    return Render(
        {200, 100}, [&](double u, double v) { return texture(u + shift, v) + add; }, 0, 1);
  };
  return AlignByParabola(see(0, 0), {120, 50}, see(shift_px, brighter),
                         120 - shift_px + start_off_px, kPublished);
}

TEST(ParabolaAlignment, IsExactOnWholeColumnsHoweverBright) {
  for (const double brighter : {0.0, 12.0}) {
    const auto aligned = Align(20, 2, brighter);
    ASSERT_TRUE(aligned);
    EXPECT_NEAR(aligned->column, 100, 0.1);
    EXPECT_NEAR(aligned->mismatch, 0, 1);
  }
}

TEST(ParabolaAlignment, TellsPartsOfAColumn) {
  for (const double part : {0.2, 0.4, 0.6, 0.8}) {
    const auto aligned = Align(20 + part, 1);
    ASSERT_TRUE(aligned);
    EXPECT_NEAR(aligned->column, 100 - part, 0.3) << part;
  }
}

TEST(ParabolaAlignment, RefusesTheEndOfItsSearchAndTheEdgeOfTheImage) {
  EXPECT_FALSE(Align(20, 5));
  EXPECT_FALSE(Align(20, 8));
  EXPECT_FALSE(Align(112, 0));
  EXPECT_TRUE(Align(20, 4));
}

TEST(ParabolaAlignment, RefusesWhatHasNoTexture) {
  const cv::Mat1b grey(100, 200, std::uint8_t{90});
  EXPECT_FALSE(AlignByParabola(grey, {120, 50}, grey, 100, kPublished));
}

}  // namespace
}  // namespace aisle::slam
