#include "harness/score/coverage.h"

#include <limits>
#include <set>

#include "harness/common/seconds.h"

namespace aisle {
namespace {

constexpr double kLost = std::numeric_limits<double>::infinity();
constexpr double kNotJudged = std::numeric_limits<double>::quiet_NaN();

bool HasPose(double error) { return error != kLost; }

Score QuantileScore(const std::vector<double>& errors, double q, const std::string& alignment) {
  if (errors.empty()) return Absent("m", "no frame could be judged");
  const double value = Quantile(errors, q);
  if (!std::isfinite(value)) {
    return Absent("m", fmt::format("lost in more than {:g} % of the frames", 100 * (1 - q)));
  }
  return Present(value, "m", errors.size(), alignment);
}

/// Whether the estimate's stamps tell of frames: not where next to none is the truth's.
bool StampsTell(const Trajectory& truth, const Trajectory& estimate, const TrajectoryScore& score) {
  if (score.pairs.empty() || score.stamp_factor) return false;
  const bool few = score.pairs.size() * 2 < std::min(truth.size(), estimate.size());
  return score.alignment.leaves_errors || !few;
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
    if (HasPose(frames.error_m[i])) {
      const double gap_s = ToSeconds(frames.stamps_ns[i] - since_ns);
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

/// Whether the truth has clearly more poses a second than the estimate.
bool IsDenser(const Trajectory& truth, const Trajectory& estimate) {
  constexpr double kClearlyDenser = 1.5;
  return static_cast<double>(MedianIntervalNs(estimate)) >
         kClearlyDenser * static_cast<double>(MedianIntervalNs(truth));
}

/// In time, to the pose that is nearest. There is one.
std::int64_t DistanceNs(const Trajectory& trajectory, std::int64_t stamp_ns) {
  const auto after = std::lower_bound(
      trajectory.begin(), trajectory.end(), stamp_ns,
      [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  std::int64_t distance = std::numeric_limits<std::int64_t>::max();
  if (after != trajectory.end()) distance = after->stamp_ns - stamp_ns;
  if (after != trajectory.begin()) {
    distance = std::min(distance, stamp_ns - std::prev(after)->stamp_ns);
  }
  return distance;
}

FrameErrors OverRowsOfTruth(const Trajectory& truth, const Trajectory& estimate,
                            const TrajectoryScore& score) {
  const std::int64_t interval_ns = MedianIntervalNs(estimate);
  FrameErrors frames = ErrorsOverFrames(truth, score);
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (HasPose(frames.error_m[i])) continue;
    const bool is_near = DistanceNs(estimate, truth[i].stamp_ns) <= interval_ns * 3 / 4;
    if (is_near) frames.error_m[i] = kNotJudged;
  }
  return frames;
}

/// What the stamps of an estimate tell of its camera's frames.
struct Rhythm {
  std::int64_t interval_ns = 0;
  std::size_t fewest_lost = 1;  ///< frames in a row; fewer that are missing are not told
};

/// The frames of an estimate, in time, lost ones among them.
class FramesOfEstimate {
 public:
  explicit FramesOfEstimate(const Rhythm& rhythm) : rhythm_(rhythm) {}

  void AddPose(std::int64_t stamp_ns, double error_m) {
    frames_.stamps_ns.push_back(stamp_ns);
    frames_.error_m.push_back(error_m);
  }
  /// Another pose of the last frame.
  void AddToLast(double error_m) {
    frames_.error_m.back() = std::fmin(frames_.error_m.back(), error_m);
  }
  /// Between two poses.
  void AddHole(std::int64_t from_ns, std::int64_t to_ns) {
    const auto steps = Whole(from_ns, to_ns, 0.5);
    if (steps > 1) AddLost(from_ns, to_ns - from_ns, steps, steps - 1);
  }
  /// Before the first pose: of the interval, counted back from it.
  void AddBefore(std::int64_t begin_ns, std::int64_t first_ns) {
    const auto steps = Whole(begin_ns, first_ns, kOfTheNext);
    const auto back = rhythm_.interval_ns * static_cast<std::int64_t>(steps + 1);
    AddLost(first_ns - back, back, steps + 1, steps);
  }
  void AddAfter(std::int64_t last_ns, std::int64_t end_ns) {
    const auto steps = Whole(last_ns, end_ns, kOfTheNext);
    AddLost(last_ns, rhythm_.interval_ns * static_cast<std::int64_t>(steps), steps, steps);
  }

  const FrameErrors& frames() const { return frames_; }

 private:
  /// Of a step beyond an end there must be so much that the frame at its end was one.
  static constexpr double kOfTheNext = 0.25;

  /// Whole intervals in a time, rounded up from 1 - `up` of one on.
  std::size_t Whole(std::int64_t from_ns, std::int64_t to_ns, double up) const {
    // A stamp that is off by years makes no drive of years.
    constexpr double kMost = 1e5;
    const double steps =
        static_cast<double>(to_ns - from_ns) / static_cast<double>(rhythm_.interval_ns);
    return steps > 0 ? static_cast<std::size_t>(std::min(kMost, steps + up)) : 0;
  }
  /// `count` frames at the first steps of a time that is cut into `steps`.
  void AddLost(std::int64_t from_ns, std::int64_t time_ns, std::size_t steps, std::size_t count) {
    constexpr std::size_t kMostInAll = 10'000'000;
    if (count < rhythm_.fewest_lost || frames_.error_m.size() > kMostInAll) return;
    const double step_ns = static_cast<double>(time_ns) / static_cast<double>(steps);
    for (std::size_t k = 1; k <= count; ++k) {
      AddPose(from_ns + std::llround(static_cast<double>(k) * step_ns), kLost);
    }
  }

  const Rhythm rhythm_;
  FrameErrors frames_;
};

FrameErrors OverPosesOfEstimate(const Trajectory& truth, const Trajectory& estimate,
                                const TrajectoryScore& score, const Rhythm& rhythm) {
  std::vector<double> of_pose(estimate.size(), kNotJudged);
  for (const PoseError& error : score.errors) of_pose[error.pair.estimate] = error.translation_m;
  // An estimate at the rate of an inertial sensor has several poses a frame.
  constexpr std::int64_t kSeveral = 2;
  const bool several = MedianIntervalNs(estimate) * kSeveral <= rhythm.interval_ns;
  const auto frame_of = [&](std::size_t i) {
    const std::int64_t since_first = estimate[i].stamp_ns - estimate.front().stamp_ns;
    return (since_first + rhythm.interval_ns / 2) / rhythm.interval_ns;
  };
  FramesOfEstimate frames(rhythm);
  frames.AddBefore(truth.front().stamp_ns, estimate.front().stamp_ns);
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    if (i > 0) frames.AddHole(estimate[i - 1].stamp_ns, estimate[i].stamp_ns);
    if (several && i > 0 && frame_of(i) == frame_of(i - 1)) {
      frames.AddToLast(of_pose[i]);
    } else {
      frames.AddPose(estimate[i].stamp_ns, of_pose[i]);
    }
  }
  frames.AddAfter(estimate.back().stamp_ns, truth.back().stamp_ns);
  return frames.frames();
}

/// How many poses of the estimate have no truth.
std::size_t NotJudged(const TrajectoryScore& score, const Trajectory& estimate) {
  std::set<std::size_t> judged;
  for (const PosePair& pair : score.pairs) judged.insert(pair.estimate);
  return estimate.size() - judged.size();
}

std::string NoteOnPoses(const Trajectory& truth, const Trajectory& estimate,
                        const AssociationOptions& association, std::size_t not_judged) {
  const std::int64_t bound_ns = MaxDifferenceNs(truth, estimate, association);
  return fmt::format(
      "{} of {} poses have no truth of their own within {:g} ms and are not judged; "
      "--max-difference (max_difference_s in Python) sets that bound",
      not_judged, estimate.size(), static_cast<double>(bound_ns) * 1e-6);
}

/// Empty where the estimate begins and ends as the truth does.
std::string NoteOnEnds(const Trajectory& truth, const Trajectory& estimate,
                       const std::vector<double>& error_m) {
  const auto before = std::find_if(error_m.begin(), error_m.end(), HasPose) - error_m.begin();
  const auto after = std::find_if(error_m.rbegin(), error_m.rend(), HasPose) - error_m.rbegin();
  const auto seconds = [](std::int64_t from_ns, std::int64_t to_ns) {
    return fmt::format("{:.3g} s", ToSeconds(to_ns - from_ns));
  };
  std::vector<std::string> ends;
  if (before > 0) {
    ends.push_back("begins " + seconds(truth.front().stamp_ns, estimate.front().stamp_ns) +
                   " after the truth");
  }
  if (after > 0) {
    ends.push_back("ends " + seconds(estimate.back().stamp_ns, truth.back().stamp_ns) +
                   " before the truth");
  }
  if (ends.empty()) return {};
  return fmt::format(
      "the estimate {}: {} frames there count as lost; where the camera did not run then, cut the "
      "truth to its time",
      fmt::join(ends, " and "), before + after);
}

}  // namespace

FrameErrors ErrorsOverFrames(const Trajectory& truth, const TrajectoryScore& score) {
  FrameErrors frames;
  for (const StampedPose& pose : truth) frames.stamps_ns.push_back(pose.stamp_ns);
  frames.error_m.resize(truth.size(), kLost);
  for (const PosePair& pair : score.pairs) frames.error_m[pair.truth] = kNotJudged;
  for (const PoseError& error : score.errors) {
    frames.error_m[error.pair.truth] = error.translation_m;
  }
  return frames;
}

FrameErrors ErrorsOverFiles(const Trajectory& truth, const Trajectory& estimate,
                            const TrajectoryScore& score, const AssociationOptions& association,
                            std::int64_t interval_ns) {
  const bool by_index = association.rule == AssociationRule::kIndex;
  if (by_index || !StampsTell(truth, estimate, score)) return ErrorsOverFrames(truth, score);
  if (interval_ns > 0) {
    return OverPosesOfEstimate(truth, estimate, score,
                               {.interval_ns = interval_ns, .fewest_lost = 1});
  }
  if (!IsDenser(truth, estimate)) return OverRowsOfTruth(truth, estimate, score);
  return OverPosesOfEstimate(truth, estimate, score,
                             {.interval_ns = MedianIntervalNs(estimate), .fewest_lost = 3});
}

void AddCoverage(const FrameErrors& frames, const std::string& alignment, Scorecard* scores) {
  const std::size_t count = frames.error_m.size();
  const auto tracked = std::count_if(frames.error_m.begin(), frames.error_m.end(), HasPose);
  std::vector<double> judged;
  std::copy_if(frames.error_m.begin(), frames.error_m.end(), std::back_inserter(judged),
               [](double error) { return !std::isnan(error); });
  const Losses losses = LossesOf(frames);
  (*scores)["coverage"] =
      count > 0 ? Present(static_cast<double>(tracked) / static_cast<double>(count), "1", count)
                : Absent("1", "no frames");
  (*scores)["times_lost"] = Present(static_cast<double>(losses.times), "1", count);
  (*scores)["recovery_max_s"] = Recovery(losses);
  (*scores)["error_all_p50_m"] = QuantileScore(judged, 0.50, alignment);
  (*scores)["error_all_p95_m"] = QuantileScore(judged, 0.95, alignment);
}

void AddCoverageOfFiles(const Trajectory& truth, const Trajectory& estimate,
                        const ScoreOptions& options, double rate_hz, TrajectoryScore* score) {
  const std::int64_t interval_ns = rate_hz > 0 ? std::llround(1e9 / rate_hz) : 0;
  const FrameErrors frames =
      ErrorsOverFiles(truth, estimate, *score, options.association, interval_ns);
  AddCoverage(frames, Name(options.alignment.method), &score->scores);
  if (score->pairs.empty() || options.association.rule == AssociationRule::kIndex) return;
  const std::size_t not_judged = NotJudged(*score, estimate);
  // Between the rows of a truth that is slower there are poses that nobody means to judge.
  if (not_judged > 0 && !IsDenser(estimate, truth)) {
    score->notes.push_back(NoteOnPoses(truth, estimate, options.association, not_judged));
  }
  if (!StampsTell(truth, estimate, *score)) return;
  const std::string ends = NoteOnEnds(truth, estimate, frames.error_m);
  if (!ends.empty()) score->notes.push_back(ends);
}

}  // namespace aisle
