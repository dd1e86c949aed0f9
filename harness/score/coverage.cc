#include "harness/score/coverage.h"

#include <limits>

namespace aisle {
namespace {

constexpr double kLost = std::numeric_limits<double>::infinity();

Score QuantileScore(const std::vector<double>& errors, double q, const std::string& alignment) {
  if (errors.empty()) return Absent("m", "no frames");
  const double value = Quantile(errors, q);
  if (!std::isfinite(value)) {
    return Absent("m", fmt::format("lost in more than {:g} % of the frames", 100 * (1 - q)));
  }
  return Present(value, "m", errors.size(), alignment);
}

/// What happened between the first pose and the last frame.
struct Losses {
  std::size_t times = 0;
  double longest_s = 0;  ///< from the first frame without a pose to the next with one
  bool at_end = false;
};

Losses LossesOf(const FrameErrors& frames) {
  Losses losses;
  bool tracked = false;
  std::int64_t since_ns = 0;
  for (std::size_t i = 0; i < frames.error_m.size(); ++i) {
    if (std::isfinite(frames.error_m[i])) {
      const double gap_s = static_cast<double>(frames.stamps_ns[i] - since_ns) * 1e-9;
      if (losses.at_end) losses.longest_s = std::max(losses.longest_s, gap_s);
      losses.at_end = false;
      tracked = true;
    } else if (tracked && !losses.at_end) {
      losses.at_end = true;
      since_ns = frames.stamps_ns[i];
      ++losses.times;
    }
  }
  return losses;
}

Score Recovery(const Losses& losses) {
  if (losses.at_end) return Absent("s", "did not recover before the end");
  if (losses.times == 0) return Absent("s", "never lost");
  return Present(losses.longest_s, "s", losses.times);
}

}  // namespace

std::int64_t FrameIntervalNs(const Trajectory& truth, const Trajectory& estimate) {
  constexpr double kClearlyDenser = 1.5;
  const std::int64_t of_truth = MedianIntervalNs(truth), of_estimate = MedianIntervalNs(estimate);
  const bool denser =
      static_cast<double>(of_estimate) > kClearlyDenser * static_cast<double>(of_truth);
  return denser ? of_estimate : 0;
}

FrameErrors ErrorsOverFrames(const Trajectory& truth, const TrajectoryScore& score,
                             std::int64_t interval_ns) {
  std::vector<double> of_pose(truth.size(), kLost);
  for (const PoseError& error : score.errors) of_pose[error.pair.truth] = error.translation_m;
  const auto step_of = [&](std::size_t i) {
    const std::int64_t since_first = truth[i].stamp_ns - truth.front().stamp_ns;
    return (since_first + interval_ns / 2) / interval_ns;
  };
  FrameErrors frames;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (interval_ns > 0 && i > 0 && step_of(i) == step_of(i - 1)) {
      frames.error_m.back() = std::min(frames.error_m.back(), of_pose[i]);
    } else {
      frames.stamps_ns.push_back(truth[i].stamp_ns);
      frames.error_m.push_back(of_pose[i]);
    }
  }
  return frames;
}

void AddCoverage(const FrameErrors& frames, const std::string& alignment, Scorecard* scores) {
  const std::size_t count = frames.error_m.size();
  const auto tracked = std::count_if(frames.error_m.begin(), frames.error_m.end(),
                                     [](double error) { return std::isfinite(error); });
  const Losses losses = LossesOf(frames);
  (*scores)["coverage"] =
      count > 0 ? Present(static_cast<double>(tracked) / static_cast<double>(count), "1", count)
                : Absent("1", "no frames");
  (*scores)["times_lost"] = Present(static_cast<double>(losses.times), "1", count);
  (*scores)["recovery_max_s"] = Recovery(losses);
  (*scores)["error_all_p50_m"] = QuantileScore(frames.error_m, 0.50, alignment);
  (*scores)["error_all_p95_m"] = QuantileScore(frames.error_m, 0.95, alignment);
}

}  // namespace aisle
