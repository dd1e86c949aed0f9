#include "simulator/shade/reference/light_error.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace aisle::sim {
namespace {

constexpr float kBlack = 1e-3f;  // of white

cv::Mat1f Blurred(const cv::Mat& image) {
  cv::Mat1f blurred;
  cv::GaussianBlur(image, blurred, {11, 11}, 1.5);
  return blurred;
}

double MeanSsim(const cv::Mat1f& ours, const cv::Mat1f& reference) {
  constexpr float kC1 = 0.01f * 0.01f, kC2 = 0.03f * 0.03f;
  cv::Mat1f a, b;
  cv::min(ours, 1.0, a);
  cv::min(reference, 1.0, b);
  const cv::Mat1f mean_a = Blurred(a), mean_b = Blurred(b);
  const cv::Mat1f aa = Blurred(a.mul(a)), bb = Blurred(b.mul(b)), ab = Blurred(a.mul(b));
  double sum = 0;
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols; ++x) {
      const float ma = mean_a(y, x), mb = mean_b(y, x);
      const float variance_a = aa(y, x) - ma * ma, variance_b = bb(y, x) - mb * mb;
      const float covariance = ab(y, x) - ma * mb;
      sum += (2 * ma * mb + kC1) * (2 * covariance + kC2) /
             ((ma * ma + mb * mb + kC1) * (variance_a + variance_b + kC2));
    }
  }
  return sum / static_cast<double>(a.total());
}

}  // namespace

LightError CompareLight(const cv::Mat1f& ours, const cv::Mat1f& reference) {
  std::vector<float> relative;
  for (int y = 0; y < ours.rows; ++y) {
    for (int x = 0; x < ours.cols; ++x) {
      if (reference(y, x) < kBlack) continue;
      relative.push_back(std::abs(ours(y, x) / reference(y, x) - 1));
    }
  }
  LightError error;
  if (!relative.empty()) {
    const auto middle = relative.begin() + static_cast<std::ptrdiff_t>(relative.size() / 2);
    std::ranges::nth_element(relative, middle);
    error.median_relative = *middle;
  }
  error.ssim = MeanSsim(ours, reference);
  error.mean_ratio = cv::mean(ours)[0] / std::max(cv::mean(reference)[0], 1e-12);
  return error;
}

LightChange CompareChange(const cv::Mat1f& ours, const std::array<cv::Mat1f, 2>& halves,
                          const cv::Mat1b& where) {
  LightChange change;
  double a = 0, b = 0, aa = 0, bb = 0, ab = 0, noise = 0, between = 0;
  for (int y = 0; y < ours.rows; ++y) {
    for (int x = 0; x < ours.cols; ++x) {
      if (!where(y, x)) continue;
      const double mine = ours(y, x);
      const double theirs = (halves[0](y, x) + halves[1](y, x)) / 2.0;
      const double error = (halves[0](y, x) - halves[1](y, x)) / 2.0;
      a += mine;
      b += theirs;
      aa += mine * mine;
      bb += theirs * theirs;
      ab += mine * theirs;
      noise += error * error;
      between += (mine - theirs) * (mine - theirs);
      ++change.pixels;
    }
  }
  const double n = std::max(change.pixels, 1);
  change.rms_ours = std::sqrt(aa / n);
  change.rms_reference = std::sqrt(bb / n);
  change.rms_noise = std::sqrt(noise / n);
  change.rms_between = std::sqrt(between / n);
  const double spread = (aa - a * a / n) * (bb - b * b / n);
  change.correlation = spread > 0 ? (ab - a * b / n) / std::sqrt(spread) : 0;
  return change;
}

}  // namespace aisle::sim
