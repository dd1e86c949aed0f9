#include "slam/stereo/match_stereo.h"

#include <gtest/gtest.h>

#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {
namespace {

const cv::Size kSize(752, 480);

ImageFeatures See(const std::function<double(double, double)>& grey, std::uint64_t noise_seed) {
  return ExtractFeatures(Render(kSize, grey, 3, noise_seed), {}, {});
}

struct Errors {
  int count = 0, gross = 0;
  double mean = 0, deviation = 0;
};

/// Matches a textured wall whose disparity is `disparity(v)` and compares.
Errors ErrorsOf(const std::function<double(double)>& disparity) {
  const Texture texture(3);
  const ImageFeatures left = See([&](double u, double v) { return texture(u, v); }, 1);
  const ImageFeatures right =
      See([&](double u, double v) { return texture(u + disparity(v), v); }, 2);
  const std::vector<Disparity> found = MatchStereo(left, right, {}, {});
  Errors errors;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].known()) continue;
    const double error = found[i].value - disparity(left.features.keypoints[i].pixel.y);
    ++errors.count;
    if (std::abs(error) > 1) {
      ++errors.gross;
      continue;
    }
    sum += error;
    squares += error * error;
  }
  errors.mean = sum / errors.count;
  errors.deviation = std::sqrt(squares / errors.count);
  return errors;
}

TEST(MatchStereo, FindsTheDisparityOfAWallToAFractionOfAPixel) {
  for (const double disparity : {2.3, 7.0, 7.25, 7.5, 21.8, 60.4}) {
    const Errors errors = ErrorsOf([&](double) { return disparity; });
    EXPECT_GT(errors.count, 600) << "disparity " << disparity;
    EXPECT_LE(errors.gross, errors.count / 200) << "disparity " << disparity;
    EXPECT_LT(std::abs(errors.mean), 0.02) << "disparity " << disparity;
    EXPECT_LT(errors.deviation, 0.08) << "disparity " << disparity;
  }
}

TEST(MatchStereo, FindsTheDisparityOfAFloor) {
  const Errors errors = ErrorsOf([](double v) { return 5 + 0.1 * v; });
  EXPECT_GT(errors.count, 500);
  EXPECT_LE(errors.gross, errors.count / 100);
  EXPECT_LT(std::abs(errors.mean), 0.02);
  EXPECT_LT(errors.deviation, 0.12);
}

TEST(MatchStereo, MatchesNothingBetweenDifferentWorlds) {
  const Texture one(3), other(400);
  const ImageFeatures left = See([&](double u, double v) { return one(u, v); }, 1);
  const ImageFeatures right = See([&](double u, double v) { return other(u, v); }, 2);
  const std::vector<Disparity> found = MatchStereo(left, right, {}, {});
  EXPECT_EQ(found.size(), left.features.keypoints.size());
  EXPECT_LT(std::count_if(found.begin(), found.end(),
                          [](const Disparity& disparity) { return disparity.known(); }),
            60);
}

/// One feature in either image of a wall, each at a level, the right one `rows_off` below the left
/// one's row, with one descriptor: whether they match.
class OnePair : public testing::Test {
 protected:
  bool Matches(int left_level, int right_level, double rows_off = 0) const {
    const cv::Point2f pixel(400, 240);
    const cv::Point2f there(pixel.x - kShift, pixel.y + static_cast<float>(rows_off));
    ImageFeatures one = left, other = right;
    one.features = {{{pixel, left_level, 0, 50}}, {Descriptor{1, 2, 3, 4}}};
    other.features = {{{there, right_level, 0, 50}}, {Descriptor{1, 2, 3, 4}}};
    const std::vector<Disparity> found = MatchStereo(one, other, {}, {});
    EXPECT_EQ(found.size(), 1u);
    return found.front().known();
  }

  static constexpr float kShift = 20;
  const Texture texture{3};
  const ImageFeatures left = See([&](double u, double v) { return texture(u, v); }, 1);
  const ImageFeatures right = See([&](double u, double v) { return texture(u + kShift, v); }, 2);
};

TEST_F(OnePair, MatchesWhereTheirLevelsAreAtMostOneApart) {
  for (int left_level = 0; left_level < 8; ++left_level) {
    for (int right_level = 0; right_level < 8; ++right_level) {
      EXPECT_EQ(Matches(left_level, right_level), std::abs(left_level - right_level) <= 1)
          << left_level << " and " << right_level;
    }
  }
}

TEST_F(OnePair, MatchesWithinABandOfRowsThatGrowsWithTheLevel) {
  const double band = StereoOptions().row_band_px;
  for (int level = 0; level < 8; ++level) {
    const double reach = band * std::pow(1.2, level);
    for (const double side : {-1.0, 1.0}) {
      EXPECT_TRUE(Matches(level, level, side * (reach - 0.5))) << level;
      EXPECT_FALSE(Matches(level, level, side * (reach + 2.5))) << level;
    }
  }
}

TEST(MatchStereo, TakesImagesThatSeeNothing) {
  const Texture texture(3);
  const ImageFeatures some = See([&](double u, double v) { return texture(u, v); }, 1);
  const ImageFeatures none = ExtractFeatures(cv::Mat1b(kSize, std::uint8_t{0}), {}, {});
  EXPECT_TRUE(MatchStereo(none, some, {}, {}).empty());
  for (const Disparity& disparity : MatchStereo(some, none, {}, {})) {
    EXPECT_FALSE(disparity.known());
  }
}

TEST(MatchStereo, NothingIsNearerThanTheNearestAskedFor) {
  StereoOptions options;
  options.nearest_m = 2;
  const StereoCamera camera;
  const double largest = camera.fx * camera.baseline_m / options.nearest_m;
  const Texture texture(3);
  const ImageFeatures left = See([&](double u, double v) { return texture(u, v); }, 1);
  const ImageFeatures right = See([&](double u, double v) { return texture(u + 45, v); }, 2);
  for (const Disparity& disparity : MatchStereo(left, right, camera, options)) {
    EXPECT_LE(disparity.value, largest + 6);
  }
}

}  // namespace
}  // namespace aisle::slam
