#include "simulator/sensor/lens.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

/// Share of the glare that stays about its place; the rest spreads evenly.
constexpr float kLocalGlare = 0.5f;
/// Pixels of the coarse picture on which the veil is made; far finer than it needs.
constexpr int kGlareFactor = 16;

/// Variance of the normal kernel that is read at the whole pixels up to `reach`.
double VarianceAtPixels(double sigma, int reach) {
  double sum = 1, second = 0;
  for (int i = 1; i <= reach; ++i) {
    const double weight = 2 * std::exp(-0.5 * i * i / (sigma * sigma));
    sum += weight;
    second += weight * i * i;
  }
  return second / sum;
}

/// The deviation of the normal kernel that has the wanted one once it is read at whole pixels:
/// these hold less of a narrow kernel than there is between them.
double KernelFor(double sigma_px, int reach) {
  constexpr int kSteps = 60;
  double low = 0.01, high = 2 * sigma_px + 1;
  for (int i = 0; i < kSteps; ++i) {
    const double middle = (low + high) / 2;
    (VarianceAtPixels(middle, reach) < sigma_px * sigma_px ? low : high) = middle;
  }
  return high;
}

cv::Mat1f Blurred(const cv::Mat1f& radiance, float sigma_px) {
  if (sigma_px <= 0) return radiance;
  cv::Mat1f spread;
  // Four deviations hold all of a normal kernel but 6e-5; sharp lenses need no more than 5 × 5.
  const int reach = std::max(2, static_cast<int>(std::ceil(4 * sigma_px)));
  const double sigma = KernelFor(double{sigma_px}, reach);
  cv::GaussianBlur(radiance, spread, cv::Size(2 * reach + 1, 2 * reach + 1), sigma, sigma,
                   cv::BORDER_REPLICATE);
  return spread;
}

/// `core` in the middle, `corner` in the corners. A mixture of two normal distributions has the
/// mixture of their variances, so the weight is the variance's law: the fourth power of the
/// distance.
cv::Mat1f MixTowardsCorners(const cv::Mat1f& core, const cv::Mat1f& corner) {
  cv::Mat1f mixed(core.size());
  const float x0 = 0.5f * static_cast<float>(core.cols - 1);
  const float y0 = 0.5f * static_cast<float>(core.rows - 1);
  const float scale = 1 / std::max(1e-6f, x0 * x0 + y0 * y0);
  ParallelFor(0, core.rows, [&](int y) {
    const float dy = static_cast<float>(y) - y0;
    const float *sharp = core[y], *soft = corner[y];
    float* out = mixed[y];
    for (int x = 0; x < core.cols; ++x) {
      const float dx = static_cast<float>(x) - x0;
      const float squared = (dx * dx + dy * dy) * scale;
      out[x] = sharp[x] + squared * squared * (soft[x] - sharp[x]);
    }
  });
  return mixed;
}

/// Mean in a fixed order.
float MeanOf(const cv::Mat1f& image) {
  double sum = 0;
  for (const float value : image) sum += double{value};
  return static_cast<float>(sum / static_cast<double>(image.total()));
}

}  // namespace

std::string LensOptions::Validate() const {
  const std::array blurs = {std::pair("blur_px", blur_px),
                            std::pair("field_blur_px", field_blur_px)};
  for (const auto& [name, value] : blurs) {
    if (!(value >= 0 && value <= 5)) {
      return fmt::format("{} is {}, must be in [0, 5]", name, value);
    }
  }
  if (!(glare >= 0 && glare <= 0.5f)) return fmt::format("glare is {}, must be in [0, 0.5]", glare);
  return "";
}

cv::Mat1f AddGlare(const cv::Mat1f& radiance, float share) {
  if (share <= 0) return radiance;
  const cv::Size coarse_size(std::max(1, radiance.cols / kGlareFactor),
                             std::max(1, radiance.rows / kGlareFactor));
  cv::Mat1f coarse, wide, veil;
  cv::resize(radiance, coarse, coarse_size, 0, 0, cv::INTER_AREA);
  const double sigma = coarse_size.width / 16.0;
  // Mirrored at the border, so that what would leave the picture comes back: the sum stays.
  cv::GaussianBlur(coarse, wide, {0, 0}, sigma, sigma, cv::BORDER_REFLECT);
  cv::resize(wide, veil, radiance.size(), 0, 0, cv::INTER_LINEAR);
  const float everywhere = (1 - kLocalGlare) * share * MeanOf(coarse);
  cv::Mat1f seen(radiance.size());
  ParallelFor(0, radiance.rows, [&](int y) {
    const float *light = radiance[y], *near = veil[y];
    float* out = seen[y];
    for (int x = 0; x < radiance.cols; ++x) {
      out[x] = (1 - share) * light[x] + (kLocalGlare * share) * near[x] + everywhere;
    }
  });
  return seen;
}

cv::Mat1f SpreadByLens(const cv::Mat1f& radiance, const LensOptions& lens) {
  cv::Mat1f image = Blurred(radiance, lens.blur_px);
  if (lens.field_blur_px > 0) {
    image =
        MixTowardsCorners(image, Blurred(radiance, std::hypot(lens.blur_px, lens.field_blur_px)));
  }
  return AddGlare(image, lens.glare);
}

}  // namespace aisle::sim
