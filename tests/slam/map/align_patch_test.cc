#include "slam/map/align_patch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/slam/stereo/synthetic_view.h"

namespace aisle::slam {
namespace {

/// A patch of a picture given by a function, around its origin.
FeaturePatch PatchOf(const std::function<double(double, double)>& grey, double noise = 0,
                     std::uint64_t seed = 1) {
  constexpr int kReach = FeaturePatch::kReach, kSide = FeaturePatch::kSide;
  const cv::Mat1b image = Render(
      {kSide, kSide}, [&](double u, double v) { return grey(u - kReach, v - kReach); }, noise,
      seed);
  FeaturePatch patch;
  std::copy(image.begin(), image.end(), patch.grey.begin());
  return patch;
}

/// Where a point of the texture lies that is `off` from the origin then, in a picture of now that
/// shows the texture shifted by `shift`, `scale` times as large, with other light.
struct Case {
  Eigen::Vector2d off, shift;
  double scale = 1, gain = 1, brightness = 0, noise = 0;
};

std::optional<AlignedPoint> AlignIn(const Texture& texture, double at, const Case& c) {
  const auto then = [&](double u, double v) { return texture(at + u, at + v); };
  const auto now = [&](double u, double v) {
    const double x = c.off.x() + (u - c.shift.x()) / c.scale;
    const double y = c.off.y() + (v - c.shift.y()) / c.scale;
    return c.gain * (then(x, y) - 128) + 128 + c.brightness;
  };
  return AlignPatch(PatchOf(then, c.noise, 1), c.off, Eigen::Matrix2d::Identity() / c.scale,
                    PatchOf(now, c.noise, 2), {});
}

/// How many of a hundred textures are aligned, and their errors' rms.
std::pair<int, double> ErrorsOf(const Case& c) {
  int aligned = 0;
  double squares = 0;
  for (int i = 0; i < 100; ++i) {
    const auto found = AlignIn(Texture(11, 5), 37.3 * i, c);
    if (!found) continue;
    ++aligned;
    squares += (found->shift_px - c.shift).squaredNorm();
  }
  return {aligned, std::sqrt(squares / aligned)};
}

TEST(AlignPatch, FindsAShiftToAFewHundredthsOfAPixel) {
  for (const Eigen::Vector2d& shift :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(0.37, -0.61), Eigen::Vector2d(-1.2, 0.9)}) {
    const auto [aligned, error] = ErrorsOf({.off = {0, 0}, .shift = shift});
    EXPECT_GE(aligned, 80) << shift.transpose();
    EXPECT_LT(error, 0.05) << shift.transpose();
  }
}

TEST(AlignPatch, FollowsAPointBesideTheCornerThroughScaleAndLight) {
  const auto [aligned, error] = ErrorsOf(
      {.off = {0.4, -0.3}, .shift = {0.5, 0.2}, .scale = 1.15, .gain = 0.7, .brightness = 25});
  EXPECT_GE(aligned, 75);
  EXPECT_LT(error, 0.06);
}

TEST(AlignPatch, TellsItsDeviationUnderNoise) {
  // Uniform noise of this amplitude deviates by three grey levels, as the options assume.
  const Case c{.off = {0, 0}, .shift = {0.3, 0.4}, .noise = 3 * std::sqrt(3)};
  double surprise = 0;
  int aligned = 0;
  for (int i = 0; i < 100; ++i) {
    const auto found = AlignIn(Texture(11, 5), 37.3 * i, c);
    if (!found) continue;
    ++aligned;
    surprise += (found->shift_px - c.shift).squaredNorm() / (2 * std::pow(found->sigma_px, 2));
  }
  EXPECT_GE(aligned, 75);
  EXPECT_GT(surprise / aligned, 0.5);
  EXPECT_LT(surprise / aligned, 2);
}

TEST(AlignPatch, ClaimsNothingOfWhatFixesNoPoint) {
  const FeaturePatch flat = PatchOf([](double, double) { return 90.0; });
  const FeaturePatch edge = PatchOf([](double u, double) { return u < 0.3 ? 60.0 : 180.0; });
  const Eigen::Matrix2d same = Eigen::Matrix2d::Identity();
  EXPECT_FALSE(AlignPatch(flat, {0, 0}, same, flat, {}));
  EXPECT_FALSE(AlignPatch(edge, {0, 0}, same, edge, {}));
}

TEST(AlignPatch, ClaimsNothingOfSomethingElseOrTooFarAway) {
  int claimed = 0;
  for (int i = 0; i < 100; ++i) {
    const Texture texture(11, 5);
    const auto patch = [&](double at) {
      return PatchOf([&](double u, double v) { return texture(at + u, at + v); });
    };
    claimed +=
        AlignPatch(patch(37.3 * i), {0, 0}, Eigen::Matrix2d::Identity(), patch(37.3 * i + 5000), {})
            .has_value();
  }
  EXPECT_LE(claimed, 2);
  EXPECT_EQ(ErrorsOf({.off = {0, 0}, .shift = {3.5, 3.5}}).first, 0);
}

}  // namespace
}  // namespace aisle::slam
