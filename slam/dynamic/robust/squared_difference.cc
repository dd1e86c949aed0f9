#include "slam/dynamic/robust/squared_difference.h"

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/window_sums.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kMeanReach = 5, kReach = 2;

/// A row of squares of what differs from the mean difference around, in units of its variance.
void SquareRow(const cv::Mat1s& padded, const cv::Mat1f& variance, int y, float* squares) {
  constexpr float kArea = (2 * kMeanReach + 1) * (2 * kMeanReach + 1);
  const int columns = variance.cols;
  // 121 differences of 255 at most: their sum fits.
  std::vector<short> scratch(static_cast<std::size_t>(padded.cols)),
      sums(static_cast<std::size_t>(columns));
  SumWindows<short>(padded, y, kMeanReach, scratch.data(), sums.data());
  const short* difference = padded[y + kMeanReach] + kMeanReach;
  const float* of = variance[y];
  for (int x = 0; x < columns; ++x) {
    const float off = static_cast<float>(difference[x]) -
                      static_cast<float>(sums[static_cast<std::size_t>(x)]) / kArea;
    squares[x] = off * off / of[x];
  }
}

}  // namespace

cv::Mat1f SquaredDifference(const cv::Mat1b& image, const cv::Mat1b& other,
                            const cv::Mat1f& variance) {
  cv::Mat1s difference;
  cv::subtract(image, other, difference, cv::noArray(), CV_16S);
  const cv::Mat1s padded = Reflected(difference, kMeanReach);
  cv::Mat1f squares(image.size());
  ParallelFor(0, image.rows, [&](int y) { SquareRow(padded, variance, y, squares[y]); });

  const cv::Mat1f around = Reflected(squares, kReach);
  cv::Mat1f mean(image.size());
  ParallelFor(0, image.rows, [&](int y) {
    constexpr float kArea = (2 * kReach + 1) * (2 * kReach + 1);
    std::vector<float> scratch(static_cast<std::size_t>(around.cols));
    SumWindows<float>(around, y, kReach, scratch.data(), mean[y]);
    for (int x = 0; x < mean.cols; ++x) mean(y, x) /= kArea;
  });
  return mean;
}

}  // namespace aisle::slam::dynamic
