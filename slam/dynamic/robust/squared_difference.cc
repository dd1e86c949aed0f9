#include "slam/dynamic/robust/squared_difference.h"

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/window_sums.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kFarReach = 5, kReach = 2;
constexpr float Area(int reach) {
  const int side = 2 * reach + 1;
  return static_cast<float>(side * side);
}

/// A row of squares of what differs from the mean difference around, and that from the mean farther
/// around, each in units of its variance.
void SquareRow(const cv::Mat1s& padded, const DifferenceNoise& noise, int y, float* squares) {
  const auto columns = static_cast<std::size_t>(noise.fine.cols);
  // 121 differences of 255 at most: their sum fits.
  std::vector<short> scratch(static_cast<std::size_t>(padded.cols)), far_sums(columns),
      near_sums(scratch.size());
  SumWindows<short>(padded, y, kFarReach, scratch.data(), far_sums.data());
  constexpr int kBetween = kFarReach - kReach;
  SumWindows<short>(padded, y + kBetween, kReach, scratch.data(), near_sums.data());
  const short *difference = padded[y + kFarReach] + kFarReach,
              *near_sum = near_sums.data() + kBetween;
  const float *fine_variance = noise.fine[y], *coarse_variance = noise.coarse[y];
#pragma GCC ivdep
  for (std::size_t x = 0; x < columns; ++x) {
    const float around = static_cast<float>(near_sum[x]) / Area(kReach);
    const float fine = static_cast<float>(difference[x]) - around;
    const float coarse = around - static_cast<float>(far_sums[x]) / Area(kFarReach);
    squares[x] = fine * fine / fine_variance[x] + coarse * coarse / coarse_variance[x];
  }
}

}  // namespace

DifferenceNoise ExpectDifferences(const cv::Mat1b& image, const SurfaceOptions& options) {
  DifferenceNoise noise{DifferenceVariance(image, options), cv::Mat1f(image.size())};
  const auto share = static_cast<float>(options.shading_noise);
  ParallelFor(0, image.rows, [&](int y) {
    for (int x = 0; x < image.cols; ++x) {
      const float shading = share * static_cast<float>(image(y, x));
      noise.coarse(y, x) = noise.fine(y, x) + shading * shading;
    }
  });
  return noise;
}

cv::Mat1f SquaredDifference(const cv::Mat1b& image, const cv::Mat1b& other,
                            const DifferenceNoise& noise) {
  cv::Mat1s difference;
  cv::subtract(image, other, difference, cv::noArray(), CV_16S);
  const cv::Mat1s padded = Reflected(difference, kFarReach);
  cv::Mat1f squares(image.size());
  ParallelFor(0, image.rows, [&](int y) { SquareRow(padded, noise, y, squares[y]); });

  const cv::Mat1f around = Reflected(squares, kReach);
  cv::Mat1f mean(image.size());
  ParallelFor(0, image.rows, [&](int y) {
    std::vector<float> scratch(static_cast<std::size_t>(around.cols));
    SumWindows<float>(around, y, kReach, scratch.data(), mean[y]);
    for (int x = 0; x < mean.cols; ++x) mean(y, x) /= Area(kReach);
  });
  return mean;
}

}  // namespace aisle::slam::dynamic
