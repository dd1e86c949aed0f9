#include "harness/score/stamp_unit.h"

namespace aisle {
namespace {

/// Absent where a stamp would leave the range of whole nanoseconds.
std::optional<Trajectory> WithStampsTimes(double factor, const Trajectory& trajectory) {
  constexpr long double kMost = 9e18L;
  Trajectory scaled = trajectory;
  for (StampedPose& pose : scaled) {
    const long double stamp = static_cast<long double>(pose.stamp_ns) * factor;
    if (std::abs(stamp) > kMost) return std::nullopt;
    pose.stamp_ns = std::llround(stamp);
  }
  return scaled;
}

}  // namespace

std::optional<double> StampFactor(const Trajectory& truth, const Trajectory& estimate,
                                  const std::vector<PosePair>& pairs) {
  constexpr double kEnough = 0.5, kFits = 0.8;
  constexpr std::size_t kFewest = 3;  // so many may meet by chance
  const std::size_t shorter = std::min(truth.size(), estimate.size());
  const auto is_share = [&](std::size_t count, double share) {
    return static_cast<double>(count) >= share * static_cast<double>(shorter);
  };
  if (shorter < kFewest || is_share(pairs.size(), kEnough)) return std::nullopt;
  for (const double factor : {1e-3, 1e-6, 1e-9, 1e3, 1e6, 1e9}) {
    const auto scaled = WithStampsTimes(factor, estimate);
    if (scaled && is_share(Associate(truth, *scaled).size(), kFits)) return factor;
  }
  return std::nullopt;
}

std::string NoteOnStamps(double factor) {
  const double off = std::max(factor, 1 / factor);
  return fmt::format(
      "with the estimate's stamps times {:g} they are those of the truth: is one of the files in "
      "{}?",
      factor,
      off < 1e4   ? "milliseconds"
      : off < 1e7 ? "microseconds"
                  : "nanoseconds");
}

}  // namespace aisle
