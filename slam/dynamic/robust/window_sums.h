#pragma once

#include <opencv2/core.hpp>

namespace aisle::slam::dynamic {

/// The image with a border of `by` pixels in which it is reflected.
inline cv::Mat Reflected(const cv::Mat& image, int by) {
  cv::Mat padded;
  cv::copyMakeBorder(image, padded, by, by, by, by, cv::BORDER_REFLECT_101);
  return padded;
}

/// Sums over windows of 2 * reach + 1 pixels around one row of the image that was padded by
/// `reach`. `columns` is scratch of the padded width. Plain additions over rows, which vectorise;
/// sums that must not depend on rounding are whole numbers that fit.
template <class Number>
void SumWindows(const cv::Mat_<Number>& padded, int y, int reach, Number* columns, Number* sums) {
  const int window = 2 * reach + 1, width = padded.cols, inner = width - 2 * reach;
  for (int x = 0; x < width; ++x) columns[x] = padded(y, x);
  for (int k = 1; k < window; ++k) {
    const Number* row = padded[y + k];
    for (int x = 0; x < width; ++x) columns[x] = static_cast<Number>(columns[x] + row[x]);
  }
  for (int x = 0; x < inner; ++x) sums[x] = columns[x];
  for (int k = 1; k < window; ++k) {
    const Number* column = columns + k;
    for (int x = 0; x < inner; ++x) sums[x] = static_cast<Number>(sums[x] + column[x]);
  }
}

}  // namespace aisle::slam::dynamic
