#include "harness/report/paper/spread.h"

#include <algorithm>

#include "harness/score/significance.h"

namespace aisle {
namespace {

/// Of fewer values the interval is their range, or close to it.
constexpr std::size_t kLeastForInterval = 5;

}  // namespace

bool HasInterval(std::size_t seeds) { return seeds >= kLeastForInterval; }

std::string SpreadText(const std::vector<double>& values,
                       const std::function<std::string(double)>& text) {
  const auto [least, most] = std::ranges::minmax(values);
  if (!HasInterval(values.size())) return text(least) + "–" + text(most);
  const Interval median = BootstrapMedian(values);
  return fmt::format("{} [{}–{}] {}", text(least), text(median.low), text(median.high), text(most));
}

std::string IntervalText(const std::vector<double>& values,
                         const std::function<std::string(double)>& text) {
  if (values.size() < 2) return "";
  if (!HasInterval(values.size())) {
    const auto [least, most] = std::ranges::minmax(values);
    return fmt::format("({} to {})", text(least), text(most));
  }
  const Interval median = BootstrapMedian(values);
  return fmt::format("[{}, {}]", text(median.low), text(median.high));
}

std::string SpreadRowName(std::size_t seeds, const std::string& scene) {
  const char* what = HasInterval(seeds) ? "least [95 % of the median] most" : "least–most";
  return fmt::format("{} seeds, {}: {}", seeds, what, scene);
}

}  // namespace aisle
