#include "harness/judge/judged.h"

#include <algorithm>
#include <cmath>

namespace aisle {
namespace {

/// Each one more costs all of them power: Holm divides what each family of tests may use up by the
/// number of its tests.
constexpr JudgedScore kJudged[] = {{"coverage", true, 0.01},
                                   {"ate_rmse_m", false},
                                   {"ate_live_rmse_m", false},
                                   {"error_all_p95_m", false},
                                   {"rpe_1s_trans_rmse_m", false},
                                   {"rpe_1s_rot_rmse_deg", false},
                                   {"features_on_movers", false},
                                   {"object_precision", true},
                                   {"object_recall", true},
                                   {"mask_iou", true},
                                   {"static_features_lost", false},
                                   {"mover_large_found_within_1s", true},
                                   {"mover_large_gap_max_frames", false, 1},
                                   // Of closed drives, which alone have them; whole numbers and
                                   // lengths that are near zero when all is well.
                                   {"goal_reached", true, 0.01},
                                   {"collisions", false, 0.05},
                                   {"cross_track_max_m", false, 0.002},
                                   {"docking_error_m", false, 0.001},
                                   {"docking_error_deg", false, 0.02},
                                   {"min_clearance_static_m", true, 0.01},
                                   {"min_clearance_person_m", true, 0.02},
                                   {"lost_s", false, 0.05}};

/// By how much a value must change at least to be far from another, in the score's unit.
double FarStep(const JudgedScore& judged, const std::string& unit) {
  constexpr double kFarShare = 0.2;
  if (judged.smallest_effect > 0) return 10 * judged.smallest_effect;
  return unit == "1" ? kFarShare : 0;
}

/// What `of` says of each seed of both: of its value before, and after.
template <class Of>
std::vector<double> OfEachPair(const ValuesBySeed& before, const ValuesBySeed& after,
                               const Of& of) {
  std::vector<double> values;
  for (const auto& [seed, value] : before) {
    const auto at = after.find(seed);
    if (at != after.end()) values.push_back(of(value, at->second));
  }
  return values;
}

}  // namespace

std::span<const JudgedScore> JudgedScores() { return kJudged; }

const JudgedScore* FindJudged(const std::string& score) {
  for (const JudgedScore& judged : kJudged) {
    if (score == judged.score) return &judged;
  }
  return nullptr;
}

double SmallestEffect(const JudgedScore& judged, double minimum_effect, double old_median) {
  return judged.smallest_effect > 0 ? judged.smallest_effect
                                    : minimum_effect * std::abs(old_median);
}

bool IsFarWorse(const JudgedScore& judged, const std::string& unit, double before, double after) {
  constexpr double kFarTimes = 3;
  const double step = FarStep(judged, unit);
  if (judged.more_is_better) return before - after > step;
  return after > kFarTimes * before && after - before > step;
}

double Badness(const JudgedScore& judged, const std::string& unit, double value) {
  constexpr double kTiny = 1e-12;
  const double least = std::max(kTiny, FarStep(judged, unit) / 10);
  if (!judged.more_is_better) return std::log(std::max(value, 0.0) + least);
  if (unit == "1") return std::log(std::max(1 - value, 0.0) + least);
  return -std::log(std::max(value, 0.0) + least);
}

std::vector<double> Worsenings(const JudgedScore& judged, const std::string& unit,
                               const ValuesBySeed& before, const ValuesBySeed& after) {
  return OfEachPair(before, after, [&](double old_value, double new_value) {
    return Badness(judged, unit, new_value) - Badness(judged, unit, old_value);
  });
}

std::vector<double> PairedDifferences(const ValuesBySeed& before, const ValuesBySeed& after) {
  return OfEachPair(before, after,
                    [](double old_value, double new_value) { return new_value - old_value; });
}

}  // namespace aisle
