#include "simulator/sensor/sensor.h"

#include <gmock/gmock.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace aisle::sim {
namespace {

struct Moments {
  double mean = 0, variance = 0;
};
Moments MomentsOf(const cv::Mat1b& image) {
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  return {mean[0], deviation[0] * deviation[0]};
}

const PixelResponse kPlain{cv::Mat1f(480, 752, 1.0f), {}};

TEST(Expose, WithoutNoiseGreyIsLinearInRadiance) {
  SensorOptions options{.exposure = 0.5f, .black_level = 0, .noise = false};
  for (const float radiance : {0.0f, 0.25f, 1.0f, 1.9f, 5.0f}) {
    const cv::Mat1b grey = Expose(cv::Mat1f(480, 752, radiance), kPlain, options, {});
    EXPECT_NEAR(grey(100, 100), std::min(255.0, 255 * 0.5 * radiance), 0.51);
  }
}

TEST(VignettingMap, IsTheNaturalLawScaledToItsCorner) {
  // Pixels at field angles from 0 to 50 degrees, out along a diagonal.
  constexpr int kWide = 51;
  std::vector<float> x(kWide), y(kWide);
  const auto angle = [](int pixel) { return pixel * CV_PI / 180; };
  for (int i = 0; i < kWide; ++i)
    x[i] = y[i] = static_cast<float>(std::tan(angle(i)) / std::sqrt(2));
  const double natural = std::pow(std::cos(angle(kWide - 1)), 4);
  const cv::Mat1f as_nature = VignettingMap(kWide, 1, x, y, static_cast<float>(1 - natural));
  const cv::Mat1f quarter = VignettingMap(kWide, 1, x, y, 0.25f);
  for (int i = 0; i < kWide; ++i) {
    const double kept = std::pow(std::cos(angle(i)), 4);
    EXPECT_NEAR(as_nature(0, i), kept, 1e-6) << i;
    EXPECT_NEAR(quarter(0, i), 1 - 0.25 * (1 - kept) / (1 - natural), 1e-6) << i;
  }
}

TEST(Expose, NoiseFollowsThePhotonTransferLaw) {
  // In electrons: variance = mean + read²; a grey level is full_well / 255 electrons.
  const SensorOptions options{.exposure = 1, .full_well_e = 10000, .read_noise_e = 20};
  const double e_per_grey = options.full_well_e / 255;
  for (const float radiance : {0.1f, 0.3f, 0.7f}) {
    const Moments moments =
        MomentsOf(Expose(cv::Mat1f(480, 752, radiance), kPlain, options, {5, 1, 0}));
    const double mean_e = radiance * options.full_well_e;
    const double expected = (mean_e + 400) / (e_per_grey * e_per_grey) + 1.0 / 12;
    EXPECT_NEAR(moments.mean, 255 * radiance + options.black_level, 0.05);
    EXPECT_NEAR(moments.variance, expected, 0.03 * expected);
  }
}

TEST(Expose, NoiseDependsOnTheKeyAndOnNothingElse) {
  const cv::Mat1f grey(480, 752, 0.4f);
  const auto picture = [&](const NoiseKey& key) { return Expose(grey, kPlain, {}, key); };
  const auto differing = [](const cv::Mat1b& a, const cv::Mat1b& b) {
    return cv::countNonZero(a != b);
  };
  const cv::Mat1b reference = picture({1, 2, 0});
  EXPECT_EQ(differing(reference, picture({1, 2, 0})), 0);
  for (const NoiseKey& other : {NoiseKey{2, 2, 0}, NoiseKey{1, 3, 0}, NoiseKey{1, 2, 1}}) {
    EXPECT_GT(differing(reference, picture(other)), 250000);
  }
}

TEST(Expose, NeighbouringPixelsAreUncorrelated) {
  cv::Mat1f image;
  Expose(cv::Mat1f(480, 752, 0.4f), kPlain, {}, {1, 0, 0}).convertTo(image, CV_32F);
  image -= cv::mean(image)[0];
  const double variance = image.dot(image);
  for (const cv::Point step : {cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1)}) {
    const cv::Rect a(0, 0, 752 - step.x, 480 - step.y), b(a + step);
    EXPECT_LT(std::abs(image(a).clone().dot(image(b).clone())) / variance, 0.01);
  }
}

TEST(Expose, ThePhotonTransferCurveGivesBackFullWellAndReadNoise) {
  // EMVA 1288's own evaluation: variance over mean is a line; its slope is grey levels an electron,
  // what it leaves in the dark is the read noise. Saturation ends it.
  const SensorOptions options{
      .exposure = 1, .full_well_e = 18400, .read_noise_e = 60, .black_level = 10};
  const auto moments_at = [&](float radiance) {
    return MomentsOf(Expose(cv::Mat1f(480, 752, radiance), kPlain, options, {3, 0, 0}));
  };
  const Moments dark = moments_at(0), low = moments_at(0.2f), high = moments_at(0.8f);
  EXPECT_NEAR(dark.mean, options.black_level, 0.05);
  const double slope = (high.variance - low.variance) / (high.mean - low.mean);
  EXPECT_NEAR(1 / slope, options.full_well_e / 255, 0.02 * options.full_well_e / 255);
  const double read_e = std::sqrt(dark.variance - 1.0 / 12) / slope;
  EXPECT_NEAR(read_e, options.read_noise_e, 0.03 * options.read_noise_e);
  const Moments middle = moments_at(0.5f);
  EXPECT_NEAR(middle.variance, low.variance + slope * (middle.mean - low.mean),
              0.02 * middle.variance);
  const cv::Mat1b saturated = Expose(cv::Mat1f(480, 752, 1.2f), kPlain, options, {3, 0, 0});
  EXPECT_EQ(cv::countNonZero(saturated != 255), 0);
}

TEST(Expose, TheToneCurveFollowsTheBlackLevel) {
  const SensorOptions options{
      .exposure = 1, .black_level = 2.5f, .tone = Tone::kCompanded, .noise = false};
  for (const float share : {0.0f, 0.03f, 0.2f, 0.6f, 0.9f}) {
    const cv::Mat1b grey = Expose(cv::Mat1f(480, 752, share), kPlain, options, {});
    EXPECT_NEAR(grey(9, 9), 255 * Compand(share + 2.5f / 255), 0.51) << share;
  }
}

TEST(Expose, BehindTheToneCurveNoiseIsStretchedByItsSlope) {
  const SensorOptions options{.exposure = 1,
                              .full_well_e = 18400,
                              .gain = 2,
                              .read_noise_e = 20,
                              .black_level = 0,
                              .tone = Tone::kCompanded};
  const float share = Expand(100.0f / 255);
  const Moments moments = MomentsOf(Expose(cv::Mat1f(480, 752, share), kPlain, options, {4, 0, 0}));
  const double electrons = double{share} * 9200;
  const double sigma = 255 * std::sqrt(electrons + 400) / 9200;  // the curve's slope there is 1
  EXPECT_NEAR(moments.mean, 100, 0.1);
  EXPECT_NEAR(moments.variance, sigma * sigma + 1.0 / 12, 0.03 * sigma * sigma);
}

TEST(MakeResponse, DeviatesAsStatedAndByCameraAndPixelAlone) {
  const cv::Mat1f fall_off(480, 752, 0.8f);
  const SensorOptions options{.prnu = 0.01f, .dsnu_e = 10};
  const PixelResponse left = MakeResponse(fall_off, options, 7, 0);
  cv::Scalar mean, deviation;
  cv::meanStdDev(left.gain, mean, deviation);
  EXPECT_NEAR(mean[0], 0.8, 1e-4);
  EXPECT_NEAR(deviation[0], 0.008, 1e-4);
  cv::meanStdDev(left.dark_e, mean, deviation);
  EXPECT_NEAR(mean[0], 0, 0.1);
  EXPECT_NEAR(deviation[0], 10, 0.1);
  const auto same = [](const cv::Mat1f& a, const cv::Mat1f& b) {
    return cv::norm(a, b, cv::NORM_INF) == 0;
  };
  EXPECT_TRUE(same(left.gain, MakeResponse(fall_off, options, 7, 0).gain));
  EXPECT_FALSE(same(left.gain, MakeResponse(fall_off, options, 7, 1).gain));
  EXPECT_FALSE(same(left.gain, MakeResponse(fall_off, options, 8, 0).gain));
}

TEST(MakeResponse, ThePatternStaysWhileTheNoiseChanges) {
  // Averaging frames leaves the fixed pattern, by the photon transfer law.
  SensorOptions options{.exposure = 1, .prnu = 0.03f, .dsnu_e = 0};
  const PixelResponse response = MakeResponse(cv::Mat1f(480, 752, 1.0f), options, 1, 0);
  cv::Mat1f sum(480, 752, 0.0f);
  constexpr int kFrames = 16;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    cv::accumulate(Expose(cv::Mat1f(480, 752, 0.5f), response, options, {1, frame, 0}), sum);
  }
  cv::Scalar mean, deviation;
  cv::meanStdDev(cv::Mat1f(sum / kFrames), mean, deviation);
  const double e_per_grey = options.full_well_e / 255;
  const double temporal = (5000 + 400) / (e_per_grey * e_per_grey) / kFrames;
  const double pattern = std::pow(0.03 * 0.5 * 255, 2);
  EXPECT_NEAR(deviation[0] * deviation[0], temporal + pattern, 0.03 * (temporal + pattern));
}

/// Electrons of the dark are added to those of the light, pixel by pixel.
TEST(MakeResponse, ThePatternOfTheDarkIsItsElectrons) {
  const SensorOptions options{
      .exposure = 1, .gain = 2, .black_level = 20, .prnu = 0, .dsnu_e = 150, .noise = false};
  const PixelResponse response = MakeResponse(cv::Mat1f(480, 752, 1.0f), options, 1, 0);
  const double e_per_grey = options.full_well_e / options.gain / 255;
  for (const float radiance : {0.0f, 0.3f}) {
    const cv::Mat1b grey = Expose(cv::Mat1f(480, 752, radiance), response, options, {});
    for (int y = 0; y < grey.rows; y += 7) {
      for (int x = 0; x < grey.cols; x += 5) {
        const double level = 255 * radiance + 20 + response.dark_e(y, x) / e_per_grey;
        ASSERT_NEAR(grey(y, x), std::max(level, 0.0), 0.51) << x << ", " << y;
      }
    }
  }
}

TEST(MakeResponse, SwitchedOffItIsTheLens) {
  const cv::Mat1f fall_off(480, 752, 0.8f);
  const PixelResponse response = MakeResponse(fall_off, {.fixed_pattern = false}, 7, 0);
  EXPECT_EQ(response.gain.data, fall_off.data);
  EXPECT_TRUE(response.dark_e.empty());
}

TEST(SensorOptions, ValidateNamesTheBrokenRule) {
  EXPECT_EQ(SensorOptions{}.Validate(), "");
  EXPECT_THAT(SensorOptions{.exposure = -1}.Validate(), testing::HasSubstr("exposure is -1"));
  EXPECT_THAT(SensorOptions{.vignetting = 2}.Validate(), testing::HasSubstr("vignetting is 2"));
}

}  // namespace
}  // namespace aisle::sim
