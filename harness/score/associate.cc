#include "harness/score/associate.h"

#include <functional>
#include <map>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <tuple>

namespace aisle {
namespace {

constexpr std::int64_t kEvoBoundNs = 10'000'000;
constexpr std::int64_t kTumBoundNs = 20'000'000;

/// Of any two stamps: how far apart they are need not fit into a signed number.
std::uint64_t Distance(std::int64_t a, std::int64_t b) {
  const auto [earlier, later] = std::minmax(a, b);
  return static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier);
}

std::size_t FirstNotBefore(const Trajectory& trajectory, std::int64_t stamp_ns) {
  const auto at = std::lower_bound(
      trajectory.begin(), trajectory.end(), stamp_ns,
      [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  return static_cast<std::size_t>(at - trajectory.begin());
}

/// evo compares times as doubles in seconds. Near 1.4e9 s their grid is 0.24 µs, so a tie in the
/// file's decimals often is none there; to pair as evo does, its rounding is part of the rule.
double SecondsInDouble(std::int64_t stamp_ns) {
  return static_cast<double>(static_cast<long double>(stamp_ns) / 1e9L);
}

/// Index of the pose nearest in time, the first on a tie. The trajectory is not empty.
std::size_t NearestIndex(const Trajectory& trajectory, std::int64_t stamp_ns) {
  const double stamp_s = SecondsInDouble(stamp_ns);
  const auto distance = [&](std::size_t i) {
    return std::abs(SecondsInDouble(trajectory[i].stamp_ns) - stamp_s);
  };
  const std::size_t after = FirstNotBefore(trajectory, stamp_ns);
  if (after == 0) return 0;
  if (after < trajectory.size() && distance(after) < distance(after - 1)) return after;
  return FirstNotBefore(trajectory, trajectory[after - 1].stamp_ns);
}

std::vector<PosePair> AssociateLikeEvo(const Trajectory& truth, const Trajectory& estimate,
                                       std::int64_t bound_ns) {
  const bool walk_truth = truth.size() < estimate.size();
  const Trajectory& walked = walk_truth ? truth : estimate;
  const Trajectory& searched = walk_truth ? estimate : truth;
  std::vector<PosePair> pairs;
  if (searched.empty() || bound_ns < 0) return pairs;
  for (std::size_t i = 0; i < walked.size(); ++i) {
    const std::size_t nearest = NearestIndex(searched, walked[i].stamp_ns);
    if (Distance(searched[nearest].stamp_ns, walked[i].stamp_ns) >
        static_cast<std::uint64_t>(bound_ns)) {
      continue;
    }
    pairs.push_back(walk_truth ? PosePair{i, nearest} : PosePair{nearest, i});
  }
  return pairs;
}

/// Pairs that were taken, by their truth.
class TakenPairs {
 public:
  /// Whether the pair is before one of them in truth and behind it in the estimate, or the other
  /// way round.
  bool AreCrossedBy(std::size_t truth, std::size_t estimate) const {
    const auto next = estimate_of_.lower_bound(truth);
    if (next != estimate_of_.end() && next->second < estimate) return true;
    return next != estimate_of_.begin() && std::prev(next)->second > estimate;
  }
  void Take(std::size_t truth, std::size_t estimate) { estimate_of_.emplace(truth, estimate); }

 private:
  std::map<std::size_t, std::size_t> estimate_of_;
};

/// Whether a pair may cross one that was taken.
enum class Crossing { kAllowed, kRefused };

/// The poses of truth that nobody has taken (union-find with path halving, one of each direction).
class FreePoses {
 public:
  explicit FreePoses(std::size_t count) : after_(count + 1), before_(count + 1) {
    std::iota(after_.begin(), after_.end(), std::size_t{0});
    std::iota(before_.begin(), before_.end(), std::size_t{0});
  }
  /// The first from `at` on; their count where there is none.
  std::size_t FirstFrom(std::size_t at) { return Root(after_, at); }
  /// One past the last before `end`; 0 where there is none.
  std::size_t EndBefore(std::size_t end) { return Root(before_, end); }
  bool Has(std::size_t at) { return FirstFrom(at) == at; }
  void Take(std::size_t at) {
    after_[at] = at + 1;
    before_[at + 1] = at;
  }

 private:
  static std::size_t Root(std::vector<std::size_t>& next, std::size_t at) {
    while (next[at] != at) at = next[at] = next[next[at]];
    return at;
  }
  std::vector<std::size_t> after_, before_;
};

/// The poses of truth that one of the estimate has not been compared with lie before `left` and
/// from `right` on.
struct Outward {
  std::size_t left = 0, right = 0;
};

/// Closest pairs first, each pose at most once. `bound_ns` is inclusive. One candidate of each pose
/// is at hand, its nearest: all within a wide bound would be as many as there are pairs.
std::vector<PosePair> AssociateGreedily(const Trajectory& truth, const Trajectory& estimate,
                                        std::int64_t bound_ns, Crossing crossing) {
  std::vector<PosePair> pairs;
  if (bound_ns < 0) return pairs;
  const auto bound = static_cast<std::uint64_t>(bound_ns);
  FreePoses free(truth.size());
  std::vector<Outward> unseen(estimate.size());
  using Candidate = std::tuple<std::uint64_t, std::size_t, std::size_t>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>> nearest;
  const auto offer_next = [&](std::size_t e) {
    Outward& outward = unseen[e];
    outward.left = free.EndBefore(outward.left);
    outward.right = free.FirstFrom(outward.right);
    const auto distance = [&](std::size_t t) {
      return Distance(truth[t].stamp_ns, estimate[e].stamp_ns);
    };
    const bool has_left = outward.left > 0 && distance(outward.left - 1) <= bound;
    const bool has_right = outward.right < truth.size() && distance(outward.right) <= bound;
    if (!has_left && !has_right) return;
    const bool goes_left =
        has_left && (!has_right || distance(outward.left - 1) <= distance(outward.right));
    const std::size_t t = goes_left ? --outward.left : outward.right++;
    nearest.emplace(distance(t), t, e);
  };
  for (std::size_t e = 0; e < estimate.size(); ++e) {
    unseen[e].left = unseen[e].right = FirstNotBefore(truth, estimate[e].stamp_ns);
    offer_next(e);
  }
  TakenPairs taken;
  while (!nearest.empty()) {
    const auto [distance, t, e] = nearest.top();
    nearest.pop();
    if (!free.Has(t) || (crossing == Crossing::kRefused && taken.AreCrossedBy(t, e))) {
      offer_next(e);
      continue;
    }
    free.Take(t);
    taken.Take(t, e);
    pairs.push_back({t, e});
  }
  std::sort(pairs.begin(), pairs.end(),
            [](const PosePair& a, const PosePair& b) { return a.truth < b.truth; });
  return pairs;
}

std::vector<PosePair> AssociateByIndex(const Trajectory& truth, const Trajectory& estimate) {
  if (truth.size() != estimate.size()) {
    throw std::invalid_argument(
        fmt::format("{} poses of truth but {} of the estimate: association by index needs equal "
                    "counts",
                    truth.size(), estimate.size()));
  }
  std::vector<PosePair> pairs(truth.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {i, i};
  return pairs;
}

}  // namespace

std::int64_t MedianIntervalNs(const Trajectory& trajectory) {
  if (trajectory.size() < 2) return 0;
  std::vector<std::int64_t> steps(trajectory.size() - 1);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    steps[i] = trajectory[i + 1].stamp_ns - trajectory[i].stamp_ns;
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

std::int64_t MaxDifferenceNs(const Trajectory& truth, const Trajectory& estimate,
                             const AssociationOptions& options) {
  if (options.max_difference_ns) return *options.max_difference_ns;
  switch (options.rule) {
    case AssociationRule::kEvo:
      return kEvoBoundNs;
    case AssociationRule::kTum:
      return kTumBoundNs;
    case AssociationRule::kIndex:
      return 0;
    case AssociationRule::kNearest:
      break;
  }
  const auto [shorter, longer] = std::minmax({MedianIntervalNs(truth), MedianIntervalNs(estimate)});
  // A trajectory of one pose has no interval; the other's then decides.
  const std::int64_t half_a_frame = (shorter > 0 ? shorter : longer) / 2;
  return std::max(half_a_frame, std::min(kEvoBoundNs, longer / 2));
}

std::vector<PosePair> Associate(const Trajectory& truth, const Trajectory& estimate,
                                const AssociationOptions& options) {
  const std::int64_t bound_ns = MaxDifferenceNs(truth, estimate, options);
  switch (options.rule) {
    case AssociationRule::kIndex:
      return AssociateByIndex(truth, estimate);
    case AssociationRule::kEvo:
      return AssociateLikeEvo(truth, estimate, bound_ns);
    case AssociationRule::kTum:
      // Strict, in whole nanoseconds.
      return AssociateGreedily(truth, estimate, bound_ns - 1, Crossing::kAllowed);
    case AssociationRule::kNearest:
      break;
  }
  return AssociateGreedily(truth, estimate, bound_ns, Crossing::kRefused);
}

std::string Describe(AssociationRule rule, std::int64_t max_difference_ns) {
  const double bound_ms = static_cast<double>(max_difference_ns) * 1e-6;
  switch (rule) {
    case AssociationRule::kIndex:
      return "by index (KITTI)";
    case AssociationRule::kEvo:
      return fmt::format("nearest of the longer (evo), |dt| <= {:g} ms", bound_ms);
    case AssociationRule::kTum:
      return fmt::format("nearest, one to one (TUM), |dt| < {:g} ms", bound_ms);
    case AssociationRule::kNearest:
      break;
  }
  return fmt::format("nearest, one to one, |dt| <= {:g} ms", bound_ms);
}

}  // namespace aisle
