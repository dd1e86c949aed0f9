#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "slam/stereo/match_stereo.h"
#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {
namespace {

constexpr double kDisparity = 23.4;  // full-image pixels, of everything
constexpr double kNoise = 1;         // grey levels, deviation of a pixel

/// A wall as one camera sees it, `shift_px` further left. Each level is drawn at its own size, with
/// a texture and noise of its own: what is known of a pixel's noise holds for every level.
ImageFeatures Wall(double shift_px, std::uint64_t seed) {
  FeatureOptions options;
  options.features = 8000;
  ImageCorners corners{BuildPyramid(cv::Mat1b(480, 752, std::uint8_t{0}), options), {}};
  for (std::size_t l = 0; l < corners.pyramid.levels.size(); ++l) {
    const Texture texture(3 + 10 * l);
    const double shift = shift_px / corners.pyramid.steps[l].x;
    cv::Mat1b& level = corners.pyramid.levels[l];
    level = Render(
        level.size(), [&](double u, double v) { return texture(u + shift, v); },
        std::sqrt(3) * kNoise, seed + 100 * l);  // uniform
    corners.levels.push_back(DetectCorners(level, options));
  }
  return ChooseFeatures(std::move(corners), {}, options);
}

StereoOptions ByImageNoiseAlone() { return {.disparity_noise_px = 1e-3, .image_noise = kNoise}; }

struct Matched {
  double error, sigma;  // pixels of the level
};

/// What was found of each level, mistaken features aside.
std::vector<std::vector<Matched>> MatchedByLevel(const StereoOptions& options) {
  const ImageFeatures left = Wall(0, 1), right = Wall(kDisparity, 2);
  const std::vector<Disparity> found = MatchStereo(left, right, {}, options);
  std::vector<std::vector<Matched>> matched(left.pyramid.levels.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (!found[i].known()) continue;
    const auto level = static_cast<std::size_t>(left.features.keypoints[i].level);
    const double scale = left.pyramid.scales[level];
    const double error = (found[i].value - kDisparity) / scale;
    if (std::abs(error) < 1) matched[level].push_back({error, found[i].sigma / scale});
  }
  return matched;
}

/// Root mean square of error over stated deviation.
double Normalized(const std::vector<Matched>& matched) {
  double squares = 0;
  for (const Matched& m : matched) squares += m.error * m.error / (m.sigma * m.sigma);
  return std::sqrt(squares / static_cast<double>(matched.size()));
}

TEST(StereoDeviation, IsThatOfTheErrorsAtEveryLevel) {
  const auto levels = MatchedByLevel(ByImageNoiseAlone());
  ASSERT_EQ(levels.size(), 8u);
  for (std::size_t l = 0; l < levels.size(); ++l) {
    ASSERT_GT(levels[l].size(), 50u) << "level " << l;
    EXPECT_GT(Normalized(levels[l]), 0.75) << "level " << l;
    EXPECT_LT(Normalized(levels[l]), 1.3) << "level " << l;
  }
}

TEST(StereoDeviation, TellsWellTexturedPatchesFromPoorOnes) {
  auto levels = MatchedByLevel(ByImageNoiseAlone());
  for (std::size_t l = 0; l < 5; ++l) {  // those with enough of both
    std::vector<Matched>& level = levels[l];
    std::ranges::sort(level, {}, &Matched::sigma);
    const auto third = std::ssize(level) / 3;
    const std::vector<Matched> sure(level.begin(), level.begin() + third);
    const std::vector<Matched> unsure(level.end() - third, level.end());
    EXPECT_LT(1.5 * sure.back().sigma, unsure.back().sigma) << "level " << l;
    for (const std::vector<Matched>& part : {sure, unsure}) {
      EXPECT_GT(Normalized(part), 0.7) << "level " << l;
      EXPECT_LT(Normalized(part), 1.4) << "level " << l;
    }
  }
}

/// What no patch shows is a deviation of its own, in pixels of the feature's level.
TEST(StereoDeviation, IsJoinedByWhatNoPatchShows) {
  const ImageFeatures left = Wall(0, 1), right = Wall(kDisparity, 2);
  StereoOptions little = ByImageNoiseAlone(), much = little;
  little.disparity_noise_px = 0.3;
  much.disparity_noise_px = 0.5;
  const std::vector<Disparity> a = MatchStereo(left, right, {}, little);
  const std::vector<Disparity> b = MatchStereo(left, right, {}, much);
  int known = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].known(), b[i].known());
    if (!a[i].known()) continue;
    ++known;
    const auto level = static_cast<std::size_t>(left.features.keypoints[i].level);
    const double scale = left.pyramid.scales[level];
    EXPECT_NEAR(std::pow(b[i].sigma / scale, 2) - std::pow(a[i].sigma / scale, 2), 0.16, 1e-5);
  }
  EXPECT_GT(known, 1000);
}

}  // namespace
}  // namespace aisle::slam
