#include "simulator/sensor/lens.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <numbers>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

constexpr double kPi = std::numbers::pi;

cv::Mat1f Point(const cv::Size& size, const cv::Point& at) {
  cv::Mat1f image(size, 0.0f);
  image(at) = 1;
  return image;
}

/// Variance of the light along x.
double VarianceOf(const cv::Mat1f& image) {
  double sum = 0, first = 0, second = 0;
  for (int x = 0; x < image.cols; ++x) {
    const double light = cv::sum(image.col(x))[0];
    sum += light;
    first += light * x;
    second += light * x * x;
  }
  return second / sum - first * first / (sum * sum);
}

cv::Mat1f RandomLight(int width, int height) {
  cv::Mat1f light(height, width);
  cv::RNG(7).fill(light, cv::RNG::UNIFORM, 0.0, 1.0);
  light(height / 3, width / 4) = 5000;  // a lamp
  return light;
}

TEST(SpreadByLens, KeepsTheLightOfAPoint) {
  const cv::Mat1f spread = SpreadByLens(Point({21, 21}, {10, 10}), {.blur_px = 0.6f});
  EXPECT_NEAR(cv::sum(spread)[0], 1, 1e-5);
  EXPECT_LT(spread(10, 10), 0.7f);
}

TEST(SpreadByLens, AWidePointHasItsDeviation) {
  const cv::Mat1f spread = SpreadByLens(Point({61, 61}, {30, 30}), {.blur_px = 2.5f});
  EXPECT_NEAR(std::sqrt(VarianceOf(spread)), 2.5, 0.02);
}

TEST(SpreadByLens, APointHasTheStatedDeviation) {
  for (const float blur_px : {0.1f, 0.25f, 0.38f, 0.45f, 0.6f, 0.7f, 0.9f, 1.2f, 3.0f}) {
    const cv::Mat1f spread = SpreadByLens(Point({61, 61}, {30, 30}), {.blur_px = blur_px});
    EXPECT_NEAR(std::sqrt(VarianceOf(spread)), blur_px, 2e-3 * double{blur_px});
    EXPECT_GE(*std::ranges::min_element(spread), 0) << blur_px;
  }
}

/// What an edge through the lens keeps of waves of so many cycles a pixel.
double TransferAt(float blur_px, double frequency) {
  cv::Mat1f edge(41, 101, 0.0f);
  edge.colRange(50, 101) = 1;
  const cv::Mat1f seen = SpreadByLens(edge, {.blur_px = blur_px});
  std::complex<double> transfer = 0;
  for (int x = 1; x < seen.cols; ++x) {
    transfer += double{seen(20, x) - seen(20, x - 1)} *
                std::exp(std::complex<double>(0, -2 * kPi * frequency * x));
  }
  return std::abs(transfer);
}

TEST(SpreadByLens, AnEdgeShowsTheStatedMtf) {
  for (const float blur_px : {0.7f, 0.9f, 1.5f}) {
    for (const double frequency : {0.05, 0.1, 0.2, 0.25}) {
      const double expected = std::exp(-2 * std::pow(kPi * double{blur_px} * frequency, 2));
      EXPECT_NEAR(TransferAt(blur_px, frequency), expected, 0.01) << blur_px << ' ' << frequency;
    }
  }
  for (const float blur_px : {0.2f, 0.38f, 0.45f}) {
    for (const double frequency : {0.05, 0.1, 0.25, 0.4, 0.5}) {
      const double expected =
          1 - std::pow(double{blur_px}, 2) * (1 - std::cos(2 * kPi * frequency));
      EXPECT_NEAR(TransferAt(blur_px, frequency), expected, 0.01) << blur_px << ' ' << frequency;
    }
  }
}

TEST(SpreadByLens, CurvatureOfTheFieldBlursTheCorners) {
  const LensOptions lens{.blur_px = 1, .field_blur_px = 1.5f};
  const cv::Size size(401, 301);
  const cv::Point middle(200, 150);
  for (const double share : {0.0, 0.5, 0.8}) {  // of the way to the corner
    const cv::Point at =
        middle + cv::Point(static_cast<int>(share * middle.x), static_cast<int>(share * middle.y));
    const double expected = 1 + 1.5 * 1.5 * std::pow(share, 4);
    EXPECT_NEAR(VarianceOf(SpreadByLens(Point(size, at), lens)), expected, 0.03 * expected)
        << share;
  }
}

TEST(AddGlare, NeitherMakesLightNorTakesAny) {
  for (const cv::Size& size : {cv::Size(752, 480), cv::Size(1226, 370), cv::Size(20, 9)}) {
    const cv::Mat1f light = RandomLight(size.width, size.height);
    const double before = cv::sum(light)[0];
    EXPECT_NEAR(cv::sum(AddGlare(light, 0.1f))[0], before, 1e-3 * before) << size;
  }
}

TEST(AddGlare, ABlackSpotInAWhiteFieldShowsTheGlareIndex) {
  cv::Mat1f field(480, 752, 1.0f);
  field(cv::Rect(360, 230, 20, 20)) = 0;
  const cv::Mat1f seen = AddGlare(field, 0.05f);
  EXPECT_NEAR(seen(240, 370), 0.05, 0.002);
  EXPECT_NEAR(seen(40, 40), 1, 0.002);
}

TEST(AddGlare, ALampVeilsItsSurroundingsMoreThanTheFarCorner) {
  const cv::Mat1f seen = AddGlare(Point({752, 480}, {100, 100}), 0.05f);
  EXPECT_NEAR(seen(100, 100), 0.95, 1e-4);
  EXPECT_GT(seen(100, 130), 4 * seen(400, 700));
  EXPECT_NEAR(seen(400, 700), 0.025 / (752 * 480), 0.001 / (752 * 480));
}

TEST(SpreadByLens, BitsDoNotDependOnThreads) {
  const cv::Mat1f light = RandomLight(752, 480);
  const LensOptions lens{.blur_px = 0.7f, .field_blur_px = 0.7f, .glare = 0.04f};
  cv::Mat1f one, two;
  Arena(1).Execute([&] { one = SpreadByLens(light, lens); });
  Arena(2).Execute([&] { two = SpreadByLens(light, lens); });
  EXPECT_EQ(cv::norm(one, two, cv::NORM_INF), 0);
}

TEST(SpreadByLens, WithNothingToSpreadItIsTheImage) {
  const cv::Mat1f light = RandomLight(60, 40);
  EXPECT_EQ(SpreadByLens(light, {.blur_px = 0}).data, light.data);
}

}  // namespace
}  // namespace aisle::sim
