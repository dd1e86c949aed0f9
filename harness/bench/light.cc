#include "harness/bench/light.h"

namespace aisle {

bool Keeps(const LightComparison& light, const LightBounds& bounds) {
  return light.median_relative_error <= bounds.median_relative_error && light.ssim >= bounds.ssim;
}

namespace {

/// What is shown white: the camera's white, or where an automatic exposure would be shorter, what
/// all but a twentieth of the picture stays below.
double WhiteOf(const cv::Mat1f& linear) {
  if (linear.empty()) return 1;
  std::vector<float> values(linear.begin(), linear.end());
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 19 / 20);
  std::ranges::nth_element(values, at);
  return std::max(1.0, static_cast<double>(*at));
}

}  // namespace

cv::Mat1b LightSheet(const LightComparison& light) {
  const double white = WhiteOf(light.reference);
  const auto grey = [&](const cv::Mat1f& linear) {
    cv::Mat1f encoded;
    cv::pow(cv::min(linear / white, 1.0), 1 / 2.2, encoded);
    return encoded;
  };
  cv::Mat1f difference;
  cv::divide(light.nightly - light.reference, cv::max(light.reference, 1e-3), difference);
  cv::Mat1f sheet;
  cv::vconcat(std::vector<cv::Mat>{grey(light.nightly), grey(light.reference),
                                   0.5 + difference * (0.5 / 0.2)},
              sheet);
  cv::Mat1b bytes;
  sheet.convertTo(bytes, CV_8U, 255);
  return bytes;
}

}  // namespace aisle
