#include "harness/picture/temporal_noise.h"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "harness/score/statistics.h"

namespace aisle {
namespace {

constexpr float kPlainGradient = 1, kTextureGradient = 5;
constexpr float kDarkest = 90, kBrightest = 110;
constexpr double kAtRest = 4;
constexpr std::size_t kLeastPixels = 200;

cv::Mat1f Gradient(const cv::Mat1f& image) {
  cv::Mat1f across, down, magnitude;
  cv::Sobel(image, across, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(image, down, CV_32F, 0, 1, 3, 1.0 / 8);
  cv::magnitude(across, down, magnitude);
  return magnitude;
}

}  // namespace

std::optional<double> TemporalNoise(const cv::Mat1b& first, const cv::Mat1b& second) {
  cv::Mat1f a, b;
  first.convertTo(a, CV_32F);
  second.convertTo(b, CV_32F);
  const cv::Mat1f mean((a + b) / 2), difference(b - a);
  cv::Mat1f smooth;  // noise alone must not make a plain pixel look textured
  cv::GaussianBlur(mean, smooth, {0, 0}, 2);
  const cv::Mat1f gradient = Gradient(smooth);
  std::vector<double> plain, texture;
  for (int y = 0; y < mean.rows; ++y) {
    for (int x = 0; x < mean.cols; ++x) {
      if (gradient(y, x) > kTextureGradient) texture.push_back(std::abs(difference(y, x)));
      if (gradient(y, x) < kPlainGradient && smooth(y, x) >= kDarkest &&
          smooth(y, x) <= kBrightest) {
        plain.push_back(difference(y, x));
      }
    }
  }
  if (plain.size() < kLeastPixels) return std::nullopt;
  if (!texture.empty() && Quantile(texture, 0.5) > kAtRest) return std::nullopt;
  return Summarize(plain).std / std::sqrt(2.0);
}

}  // namespace aisle
