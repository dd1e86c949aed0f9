#include "simulator/sensor/shutter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

/// Image motion that needs no second instant, as a share of the spacing.
constexpr double kStill = 0.25;

/// Integral of max(0, 1 - |s|) from -1 to x.
double HatIntegral(double x) {
  x = std::clamp(x, -1.0, 1.0);
  return x < 0 ? 0.5 * (1 + x) * (1 + x) : 1 - 0.5 * (1 - x) * (1 - x);
}

/// Mean of the hat function around `center` (half width `spacing`) over [from, to].
double HatMean(double center, double spacing, double from, double to) {
  if (to <= from) return std::max(0.0, 1 - std::abs(from - center) / spacing);
  const double integral =
      HatIntegral((to - center) / spacing) - HatIntegral((from - center) / spacing);
  return integral * spacing / (to - from);
}

}  // namespace

std::string ShutterOptions::Validate() const {
  if (!(readout_ms >= 0)) return fmt::format("readout_ms is {}, must be ≥ 0", readout_ms);
  if (!(spacing_px > 0)) return fmt::format("spacing_px is {}, must be above 0", spacing_px);
  if (most_instants < 1 || most_instants % 2 == 0) {
    return fmt::format("most_instants is {}, must be odd and positive", most_instants);
  }
  return "";
}

cv::Range ShutterPlan::RowsOf(int instant) const {
  int first = weights.rows, last = 0;
  for (int y = 0; y < weights.rows; ++y) {
    if (weights(y, instant) == 0) continue;
    first = std::min(first, y);
    last = y + 1;
  }
  return {std::min(first, last), last};
}

double OpenTime(const ShutterOptions& options, double exposure_ms) {
  return 1e-3 * (options.readout_ms + (options.motion_blur ? exposure_ms : 0));
}

ShutterPlan PlanShutter(const ShutterOptions& options, double exposure_ms, int rows,
                        double motion_px) {
  const double open_s = OpenTime(options, exposure_ms);
  int half = 0;  // instants before and after the middle one
  if (motion_px > kStill * options.spacing_px && open_s > 0) {
    const double steps = std::ceil(std::min(motion_px / options.spacing_px, 1e6));
    half = std::clamp(static_cast<int>(std::ceil(steps / 2)), 1, (options.most_instants - 1) / 2);
  }
  ShutterPlan plan;
  plan.weights = cv::Mat1f(rows, 2 * half + 1, 1.0f);
  if (half == 0) {
    plan.offsets_s = {0};
    return plan;
  }
  const double spacing_s = open_s / (2 * half);
  for (int k = -half; k <= half; ++k) plan.offsets_s.push_back(k * spacing_s);
  const double exposure_s = options.motion_blur ? 1e-3 * exposure_ms : 0;
  for (int y = 0; y < rows; ++y) {
    const double middle_s = 1e-3 * options.readout_ms * ((y + 0.5) / rows - 0.5);
    for (std::size_t k = 0; k < plan.offsets_s.size(); ++k) {
      plan.weights(y, static_cast<int>(k)) = static_cast<float>(HatMean(
          plan.offsets_s[k], spacing_s, middle_s - exposure_s / 2, middle_s + exposure_s / 2));
    }
  }
  return plan;
}

void AddInstant(const ShutterPlan& plan, int instant, const cv::Mat1f& image, int first_row,
                cv::Mat1f* sum) {
  const cv::Range rows = plan.RowsOf(instant);
  ParallelFor(rows.start, rows.end, [&](int y) {
    const float weight = plan.weights(y, instant);
    const float* from = image[y - first_row];
    float* to = (*sum)[y];
    for (int x = 0; x < sum->cols; ++x) to[x] += weight * from[x];
  });
}

}  // namespace aisle::sim
