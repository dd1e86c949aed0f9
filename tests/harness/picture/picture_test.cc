#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "harness/picture/contrast.h"
#include "harness/picture/corners.h"
#include "harness/picture/realism.h"
#include "harness/picture/spectrum.h"
#include "harness/picture/temporal_noise.h"
#include "harness/picture/tones.h"

namespace aisle {
namespace {

cv::Mat1b Noise(double mean, double sigma, std::uint64_t seed = 1) {
  cv::Mat1f noise(480, 752);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, mean, sigma);
  cv::Mat1b grey;
  noise.convertTo(grey, CV_8U);
  return grey;
}

TEST(MedianGradient, OfARampIsItsSlope) {
  cv::Mat1b ramp(50, 60);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp(y, x) = static_cast<std::uint8_t>(3 * x + 1 * y);  // never above 226
    }
  }
  EXPECT_NEAR(MedianGradient(ramp), std::hypot(3, 1), 1e-5);
}

TEST(LocalContrast, OfACheckerboardIsTheDifferenceOverTheSum) {
  cv::Mat1b board(64, 64);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) board(y, x) = (x + y) % 2 ? 150 : 50;
  }
  EXPECT_NEAR(LocalContrast(board), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(LocalContrast(board(cv::Rect(0, 0, 15, 15)))));
}

/// The deviation of 64 normal values that a tenth stay below (Wilson and Hilferty).
double TenthOfDeviations(double sigma) {
  const double k = 63, cube = 1 - 2 / (9 * k) - 1.28155 * std::sqrt(2 / (9 * k));
  return sigma * std::sqrt(k * cube * cube * cube / 64);
}

TEST(PlainDeviation, OfNoiseIsItsDeviation) {
  for (const double sigma : {1.5, 4.0}) {
    const double rounded = std::sqrt(sigma * sigma + 1.0 / 12);
    EXPECT_NEAR(PlainDeviation(Noise(120, sigma)), TenthOfDeviations(rounded), 0.02 * sigma);
  }
}

TEST(PlainDeviation, LeavesOutWhatIsClipped) {
  cv::Mat1b image = Noise(120, 4);
  const double without = PlainDeviation(image);
  image.rowRange(0, 160) = 255;
  image.rowRange(160, 240) = 0;
  EXPECT_NEAR(PlainDeviation(image), without, 0.1);
  EXPECT_TRUE(std::isnan(PlainDeviation(cv::Mat1b(64, 64, std::uint8_t{255}))));
}

TEST(LaplacianVariance, OfWhiteNoiseIsTwentyTimesItsVariance) {
  EXPECT_NEAR(LaplacianVariance(Noise(120, 5)), 20 * (25 + 1.0 / 12), 10);
}

TEST(Tones, AreCounted) {
  cv::Mat1b image(10, 100, std::uint8_t{100});
  image.colRange(0, 4) = 5;
  image.colRange(4, 6) = 6;
  image.colRange(90, 100) = 250;
  EXPECT_DOUBLE_EQ(BlackShare(image), 0.04);
  EXPECT_DOUBLE_EQ(WhiteShare(image), 0.1);
  EXPECT_EQ(GreyQuantile(image, 0.04), 5);
  EXPECT_EQ(GreyQuantile(image, 0.05), 6);
  EXPECT_EQ(GreyQuantile(image, 0.5), 100);
  EXPECT_EQ(GreyQuantile(image, 1), 250);
}

TEST(CountCorners, CountsIsolatedDots) {
  cv::Mat1b image(480, 752, std::uint8_t{80});
  int dots = 0;
  for (int y = 48; y < 470; y += 64) {
    for (int x = 48; x < 736; x += 64, ++dots) image(y, x) = 120;
  }
  const CornerDensity density = CountCorners(image);
  EXPECT_DOUBLE_EQ(density.per_megapixel, 1e6 * dots / (480.0 * 752));
  EXPECT_DOUBLE_EQ(density.cells_share, dots / (23.0 * 15));
}

TEST(CountCorners, NothingBelowTheThreshold) {
  cv::Mat1b image(480, 752, std::uint8_t{80});
  image(100, 100) = 100;  // 20 above: not more than the threshold
  EXPECT_EQ(CountCorners(image).per_megapixel, 0);
}

/// A picture whose power falls with the given power of frequency, phases at random.
cv::Mat1b PowerLaw(double exponent) {
  constexpr int kSize = 512;
  cv::Mat2f transform(kSize, kSize);
  cv::RNG random(5);
  for (int v = 0; v < kSize; ++v) {
    for (int u = 0; u < kSize; ++u) {
      const double f =
          std::hypot(u <= kSize / 2 ? u : u - kSize, v <= kSize / 2 ? v : v - kSize) / kSize;
      const double amplitude = f > 0 ? std::pow(std::max(f, 0.01), exponent / 2) : 0;
      const double phase = random.uniform(0.0, 2 * std::numbers::pi);
      transform(v, u) = {static_cast<float>(amplitude * std::cos(phase)),
                         static_cast<float>(amplitude * std::sin(phase))};
    }
  }
  cv::Mat2f complex;
  cv::dft(transform, complex, cv::DFT_INVERSE);
  cv::Mat1f image;
  cv::extractChannel(complex, image, 0);
  cv::Scalar mean, deviation;
  cv::meanStdDev(image, mean, deviation);
  cv::Mat1b grey;
  image.convertTo(grey, CV_8U, 35 / deviation[0], 128 - mean[0] * 35 / deviation[0]);
  return grey;
}

TEST(SpectrumSlope, OfAPowerLawIsItsExponent) {
  for (const double exponent : {-1.0, -2.0, -3.0}) {
    const std::vector<double> spectrum = PowerSpectrum(PowerLaw(exponent));
    EXPECT_NEAR(SpectrumSlope(spectrum, 0.02, 0.2), exponent, 0.12) << exponent;
    EXPECT_NEAR(SpectrumSlope(spectrum, 0.2, 0.5), exponent, 0.12) << exponent;
  }
}

/// Under a Hann window a wave that fits the tile is in its own frequency and the two beside it; the
/// rest is what rounding to grey levels leaves.
TEST(PowerSpectrum, OfAWaveStaysInItsRing) {
  constexpr int kWaves = 40;
  cv::Mat1b image(256, 256);
  for (int x = 0; x < image.cols; ++x) {
    image.col(x).setTo(std::round(128 + 100 * std::cos(2 * std::numbers::pi * kWaves * x / 256)));
  }
  const std::vector<double> spectrum = PowerSpectrum(image);
  for (std::size_t ring = kWaves + 3; ring < spectrum.size(); ++ring) {
    EXPECT_LT(spectrum[ring], 1e-5 * spectrum[kWaves]) << ring;
  }
}

TEST(SpectrumSlope, OfASmallPictureIsNone) {
  EXPECT_TRUE(std::isnan(SpectrumSlope(PowerSpectrum(cv::Mat1b(255, 300, 'a')), 0.02, 0.2)));
}

TEST(TemporalNoise, OfTwoNoisyPicturesIsTheirNoise) {
  const auto noise = TemporalNoise(Noise(100, 1.5, 1), Noise(101, 1.5, 2));
  ASSERT_TRUE(noise);
  EXPECT_NEAR(*noise, std::sqrt(1.5 * 1.5 + 1.0 / 12), 0.02);
}

TEST(TemporalNoise, NeedsGreyAndACameraAtRest) {
  EXPECT_FALSE(TemporalNoise(Noise(160, 1, 1), Noise(160, 1, 2)));
  cv::Mat1b stripes = Noise(100, 1, 1);
  for (int x = 0; x < 300; x += 30) stripes.colRange(x, x + 15) += 60;
  cv::Mat1b moved = stripes.clone();
  stripes.colRange(0, 740).copyTo(moved.colRange(12, 752));
  EXPECT_TRUE(TemporalNoise(stripes, stripes));
  EXPECT_FALSE(TemporalNoise(stripes, moved));
}

TEST(DescribePicture, GivesAValueAStatistic) {
  const std::vector<double> values = DescribePicture(Noise(100, 2, 1), Noise(100, 2, 2));
  ASSERT_EQ(values.size(), PictureStatistics().size());
  EXPECT_THAT(values, testing::Each(testing::Truly([](double v) { return !std::isnan(v); })));
  EXPECT_STREQ(PictureStatistics().back().key, "temporal_noise");
  EXPECT_NEAR(values.back(), 2.02, 0.03);
  EXPECT_TRUE(std::isnan(DescribePicture(Noise(100, 2), {}).back()));
}

TEST(MedianOfEach, LeavesOutWhatIsNoNumber) {
  std::vector<std::vector<double>> pictures(
      3, std::vector<double>(PictureStatistics().size(), std::nan("")));
  pictures[0][0] = 1;
  pictures[2][0] = 3;
  const std::vector<double> medians = MedianOfEach(pictures);
  EXPECT_EQ(medians[0], 2);
  EXPECT_TRUE(std::isnan(medians[1]));
}

}  // namespace
}  // namespace aisle
