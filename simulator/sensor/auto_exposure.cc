#include "simulator/sensor/auto_exposure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace aisle::sim {
namespace {

/// Mean share of white, behind the tone curve, when radiance 1 gives `white`.
double MeanOf(const cv::Mat1f& light, double white, Tone tone) {
  double sum = 0;
  for (const float value : light) {
    const double share = std::min(1.0, white * double{value});
    sum += tone == Tone::kCompanded ? double{Compand(static_cast<float>(share))} : share;
  }
  return sum / static_cast<double>(light.total());
}

/// The largest of the products of time and gain that the control has, up to one, both in ms.
double StepBelow(double product, const AutoExposureOptions& options) {
  if (options.step_ev <= 0) return product;
  const double stops = std::log2(product / options.shortest_ms);
  return options.shortest_ms * std::exp2(options.step_ev * std::floor(stops / options.step_ev));
}

/// The radiance that `share` of the picture exceeds.
double BrightestBut(const cv::Mat1f& light, double share) {
  std::vector<float> values(light.begin(), light.end());
  const auto skipped = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size()));
  const auto at = values.begin() + std::min(skipped, std::ssize(values) - 1);
  std::nth_element(values.begin(), at, values.end(), std::greater<>());
  return *at;
}

}  // namespace

std::string AutoExposureOptions::Validate() const {
  if (!(target_grey > 0 && target_grey < 255)) {
    return fmt::format("target_grey is {}, must be between 0 and 255", target_grey);
  }
  if (!(white_share > 0 && white_share <= 1)) {
    return fmt::format("white_share is {}, must be above 0 and at most 1", white_share);
  }
  if (!(meter_from >= 0 && meter_from <= 0.9f)) {
    return fmt::format("meter_from is {}, must be from 0 to 0.9", meter_from);
  }
  if (!(shortest_ms > 0 && longest_ms >= shortest_ms)) {
    return fmt::format("shortest_ms is {} and longest_ms {}: 0 < shortest_ms ≤ longest_ms",
                       shortest_ms, longest_ms);
  }
  if (!(step_ev >= 0)) return fmt::format("step_ev is {}, must be ≥ 0", step_ev);
  if (!(highest_gain >= 1)) return fmt::format("highest_gain is {}, must be ≥ 1", highest_gain);
  return "";
}

ExposureSetting ChooseExposure(const cv::Mat1f& view, double white_per_ms, Tone tone,
                               const AutoExposureOptions& options) {
  constexpr int kBisections = 30;
  const int top = static_cast<int>(options.meter_from * static_cast<float>(view.rows));
  const cv::Mat1f light = view.rowRange(top, view.rows);
  const double whitest =
      1 / (white_per_ms * std::max(1e-12, BrightestBut(light, options.white_share)));
  const double highest =
      std::clamp(whitest, options.shortest_ms, options.longest_ms * double{options.highest_gain});
  double low = options.shortest_ms, high = highest;  // ms · gain
  for (int i = 0; i < kBisections; ++i) {
    const double middle = std::sqrt(low * high);
    (255 * MeanOf(light, middle * white_per_ms, tone) < options.target_grey ? low : high) = middle;
  }
  const double product = StepBelow(high, options);
  ExposureSetting setting{std::min(product, options.longest_ms), 1};
  if (product > options.longest_ms) {
    const double steps = std::ceil(16 * (product / options.longest_ms - 1) - 1e-9);
    setting.gain = std::min(static_cast<float>(1 + steps / 16), options.highest_gain);
    setting.time_ms = std::min(options.longest_ms, product / setting.gain);
  }
  return setting;
}

}  // namespace aisle::sim
