#include "harness/picture/realism.h"

#include <array>
#include <cmath>
#include <limits>

#include "harness/picture/contrast.h"
#include "harness/picture/corners.h"
#include "harness/picture/spectrum.h"
#include "harness/picture/temporal_noise.h"
#include "harness/picture/tones.h"
#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr std::array kStatistics = {
    PictureStatistic{"gradient_median", "gradient", "median magnitude of Sobel's gradient over 8",
                     2},
    PictureStatistic{"local_contrast", "local contrast",
                     "median over 16 x 16 blocks of deviation over mean", 3},
    PictureStatistic{"plain_deviation", "deviation, plain blocks",
                     "deviation that a tenth of the unclipped 8 x 8 blocks stay below", 2},
    PictureStatistic{"corners_per_megapixel", "FAST-20 per megapixel",
                     "FAST corners at threshold 20, maxima only, per million pixels", 0},
    PictureStatistic{"cells_with_corner", "cells with a corner, %",
                     "percentage of whole 32 x 32 cells with such a corner", 1},
    PictureStatistic{"spectrum_slope_low", "spectrum slope, low",
                     "slope of log power over log frequency from 0.02 to 0.2 cycles a pixel", 2},
    PictureStatistic{"spectrum_slope_high", "spectrum slope, high",
                     "the same from 0.2 to 0.5 cycles a pixel", 2},
    PictureStatistic{"laplacian_variance", "variance of Laplacian",
                     "variance of the Laplacian's 5-point stencil", 0},
    PictureStatistic{"black_percent", "black, %", "percentage of pixels at grey 5 or below", 2},
    PictureStatistic{"white_percent", "white, %", "percentage of pixels at grey 250 or above", 2},
    PictureStatistic{"grey_p5", "5th percentile", "grey that 5 % of the pixels stay at or below",
                     0},
    PictureStatistic{"grey_median", "median grey", "grey that half the pixels stay at or below", 0},
    PictureStatistic{"temporal_noise", "temporal noise at 100",
                     "deviation between consecutive pictures over sqrt(2), plain pixels of grey "
                     "90 to 110, camera at rest",
                     2},
};

}  // namespace

std::span<const PictureStatistic> PictureStatistics() { return kStatistics; }

std::vector<double> DescribePicture(const cv::Mat1b& image, const cv::Mat1b& next) {
  const CornerDensity corners = CountCorners(image);
  const std::vector<double> spectrum = PowerSpectrum(image);
  std::optional<double> noise;
  if (next.size() == image.size()) noise = TemporalNoise(image, next);
  return {MedianGradient(image),
          LocalContrast(image),
          PlainDeviation(image),
          corners.per_megapixel,
          100 * corners.cells_share,
          SpectrumSlope(spectrum, 0.02, 0.2),
          SpectrumSlope(spectrum, 0.2, 0.5),
          LaplacianVariance(image),
          100 * BlackShare(image),
          100 * WhiteShare(image),
          GreyQuantile(image, 0.05),
          GreyQuantile(image, 0.5),
          noise.value_or(std::numeric_limits<double>::quiet_NaN())};
}

std::vector<double> MedianOfEach(const std::vector<std::vector<double>>& pictures) {
  std::vector<double> medians;
  for (std::size_t i = 0; i < kStatistics.size(); ++i) {
    std::vector<double> values;
    for (const std::vector<double>& picture : pictures) {
      if (!std::isnan(picture[i])) values.push_back(picture[i]);
    }
    medians.push_back(values.empty() ? std::numeric_limits<double>::quiet_NaN()
                                     : Quantile(values, 0.5));
  }
  return medians;
}

}  // namespace aisle
