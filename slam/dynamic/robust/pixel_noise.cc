#include "slam/dynamic/robust/pixel_noise.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <vector>

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/window_sums.h"

namespace aisle::slam::dynamic {
namespace {

/// Greys are taken together by so many, and trusted from so many pixels on.
constexpr int kGreys = 16, kBins = 256 / kGreys, kLeastPixels = 500;

/// How often each magnitude of a + d - b - c was met.
using Magnitudes = std::array<int, 2 * 255 + 1>;

std::array<Magnitudes, kBins> CountDiagonals(const cv::Mat1b& image) {
  std::array<Magnitudes, kBins> counts{};
  for (int y = 0; y + 1 < image.rows; y += 2) {
    const unsigned char *upper = image[y], *lower = image[y + 1];
    for (int x = 0; x + 1 < image.cols; x += 2) {
      const int a = upper[x], b = upper[x + 1], c = lower[x], d = lower[x + 1];
      const auto bin = static_cast<std::size_t>((a + b + c + d) / 4 / kGreys);
      ++counts[bin][static_cast<std::size_t>(std::abs(a + d - b - c))];
    }
  }
  return counts;
}

/// The lower quartile of magnitudes that were rounded to whole numbers.
double LowerQuartile(const Magnitudes& counts, int pixels) {
  double left = 0.25 * pixels;
  std::size_t magnitude = 0;
  while (left > counts[magnitude]) left -= counts[magnitude++];
  const double within = left / counts[magnitude];
  return magnitude == 0 ? within / 2 : static_cast<double>(magnitude) - 0.5 + within;
}

std::optional<double> VarianceOf(const Magnitudes& counts) {
  constexpr double kQuartileOfNormal = 0.318639;  // of the magnitude, in deviations
  const int pixels = std::accumulate(counts.begin(), counts.end(), 0);
  if (pixels < kLeastPixels) return std::nullopt;
  const double deviation = LowerQuartile(counts, pixels) / 4 / kQuartileOfNormal;
  return deviation * deviation;
}

}  // namespace

GreyVariance MeasurePixelNoise(const cv::Mat1b& image) {
  struct Known {
    int grey;
    double variance;
  };
  std::vector<Known> known;
  const std::array<Magnitudes, kBins> counts = CountDiagonals(image);
  for (int bin = 0; bin < kBins; ++bin) {
    const auto variance = VarianceOf(counts[static_cast<std::size_t>(bin)]);
    if (variance) known.push_back({bin * kGreys + kGreys / 2, *variance});
  }
  GreyVariance noise{};
  if (known.empty()) return noise;
  std::size_t next = 0;
  for (int grey = 0; grey < 256; ++grey) {
    while (next < known.size() && known[next].grey <= grey) ++next;
    const Known &low = known[next == 0 ? 0 : next - 1],
                &high = known[std::min(next, known.size() - 1)];
    const double share =
        high.grey > low.grey ? static_cast<double>(grey - low.grey) / (high.grey - low.grey) : 0;
    noise[static_cast<std::size_t>(grey)] =
        static_cast<float>(std::lerp(low.variance, high.variance, share));
  }
  return noise;
}

cv::Mat1b WithoutNoise(const cv::Mat1b& image, const GreyVariance& noise) {
  if (std::all_of(noise.begin(), noise.end(), [](float variance) { return variance <= 0; })) {
    return image;
  }
  constexpr int kReach = 2, kArea = (2 * kReach + 1) * (2 * kReach + 1);
  const cv::Mat1b padded = Reflected(image, kReach);
  cv::Mat1w grey;  // 25 of them fit
  padded.convertTo(grey, CV_16U);
  cv::Mat1i square(padded.size());
  for (int y = 0; y < padded.rows; ++y) {
    for (int x = 0; x < padded.cols; ++x) square(y, x) = padded(y, x) * padded(y, x);
  }
  cv::Mat1b quiet(image.size());
  ParallelFor(0, image.rows, [&](int y) {
    const auto columns = static_cast<std::size_t>(image.cols);
    std::vector<unsigned short> grey_scratch(static_cast<std::size_t>(grey.cols)), greys(columns);
    std::vector<int> square_scratch(grey_scratch.size()), squares(columns);
    SumWindows<unsigned short>(grey, y, kReach, grey_scratch.data(), greys.data());
    SumWindows<int>(square, y, kReach, square_scratch.data(), squares.data());
    const unsigned char* seen = image[y];
    unsigned char* left = quiet[y];
    const unsigned short* sums = greys.data();
    const int* square_sums = squares.data();
    const float* of_grey = noise.data();
#pragma GCC ivdep
    for (std::size_t x = 0; x < columns; ++x) {
      const float mean = static_cast<float>(sums[x]) / kArea;
      const float variance = static_cast<float>(square_sums[x]) / kArea - mean * mean;
      const float of_noise = of_grey[static_cast<int>(mean)];
      const float kept = std::max(variance - of_noise, 0.0F) / std::max(variance, 1e-3F);
      const float grey_left = mean + kept * (static_cast<float>(seen[x]) - mean);
      left[x] = static_cast<unsigned char>(static_cast<int>(grey_left + 0.5F));
    }
  });
  return quiet;
}

}  // namespace aisle::slam::dynamic
