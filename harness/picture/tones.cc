#include "harness/picture/tones.h"

#include <array>
#include <cmath>

namespace aisle {
namespace {

double ShareOf(const cv::Mat1b& mask) {
  return static_cast<double>(cv::countNonZero(mask)) / static_cast<double>(mask.total());
}

}  // namespace

double BlackShare(const cv::Mat1b& image) { return ShareOf(cv::Mat1b(image <= kBlack)); }

double WhiteShare(const cv::Mat1b& image) { return ShareOf(cv::Mat1b(image >= kWhite)); }

double GreyQuantile(const cv::Mat1b& image, double q) {
  std::array<std::size_t, 256> count = {};
  for (const std::uint8_t grey : image) ++count[grey];
  const double wanted = q * static_cast<double>(image.total());
  std::size_t below = 0;
  for (std::size_t grey = 0; grey < count.size(); ++grey) {
    below += count[grey];
    if (static_cast<double>(below) >= wanted) return static_cast<double>(grey);
  }
  return 255;
}

}  // namespace aisle
