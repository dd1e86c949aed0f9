// Which way each judged score is good, said a second time and by what the score means.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "harness/judge/compare.h"
#include "harness/judge/gate.h"
#include "harness/score/score_names.h"

namespace aisle {
namespace {

/// A night that nobody wants and one that everybody does.
struct Nights {
  const char* unit;
  double bad, good;
};
const std::map<std::string, Nights>& Table() {
  static const std::map<std::string, Nights> table = {
      // A pose in more frames, and nearer to the truth.
      {"coverage", {"1", 0.4, 0.9}},
      {"ate_rmse_m", {"m", 0.5, 0.02}},
      {"ate_live_rmse_m", {"m", 0.5, 0.02}},
      {"error_all_p95_m", {"m", 0.5, 0.02}},
      {"rpe_1s_trans_rmse_m", {"m", 0.1, 0.004}},
      {"rpe_1s_rot_rmse_deg", {"deg", 2, 0.1}},
      // What moves is not to be used; what stands is not to be thrown away.
      {"features_on_movers", {"1", 0.5, 0.05}},
      {"static_features_lost", {"1", 0.5, 0.05}},
      {"object_precision", {"1", 0.3, 0.9}},
      {"object_recall", {"1", 0.3, 0.9}},
      {"mask_iou", {"1", 0.3, 0.9}},
      {"mover_large_found_within_1s", {"1", 0.3, 0.9}},
      {"mover_large_gap_max_frames", {"frames", 40, 2}},
      // A vehicle arrives, touches nothing, keeps its way and knows where it is.
      {"goal_reached", {"1", 0, 1}},
      {"collisions", {"1", 3, 0}},
      {"cross_track_max_m", {"m", 0.4, 0.03}},
      {"docking_error_m", {"m", 0.2, 0.005}},
      {"docking_error_deg", {"deg", 5, 0.2}},
      {"min_clearance_static_m", {"m", 0.05, 0.5}},
      {"min_clearance_person_m", {"m", 0.05, 0.9}},
      {"lost_s", {"s", 8, 0}},
  };
  return table;
}

/// Nine drives that have this score alone, each a little different.
Results Night(const std::string& score, const std::string& unit, double value) {
  Results night;
  for (std::uint64_t seed = 1; seed <= 9; ++seed) {
    RunRecord run;
    run.spec = {
        .scene = "s", .scene_file = "", .twin = "live", .system = BuiltIn("oracle"), .seed = seed};
    const double apart = value * (1 - 0.003 * static_cast<double>(seed));
    run.scores[score] = {.value = apart, .unit = unit, .alignment = "", .n = 9, .absent = ""};
    night.runs.push_back(run);
  }
  return night;
}

Change ChangeBetween(const Results& before, const Results& after) {
  const std::vector<Comparison> comparisons = Compare(before, after);
  EXPECT_EQ(comparisons.size(), 1u);
  return comparisons.front().change;
}

TEST(DirectionTest, AScoreThatShiftsByMuchIsWorseOneWayAndBetterTheOther) {
  for (const auto& [score, nights] : Table()) {
    const Results bad = Night(score, nights.unit, nights.bad);
    const Results good = Night(score, nights.unit, nights.good);
    EXPECT_EQ(ChangeBetween(good, bad), Change::kWorse) << score;
    EXPECT_EQ(ChangeBetween(bad, good), Change::kBetter) << score;
    EXPECT_EQ(MoreIsBetter(score), nights.good > nights.bad) << score;
  }
}

TEST(DirectionTest, TheGateFailsTheOneNightAndLetsTheOtherPass) {
  const auto passes = [](const Results& before, const Results& after) {
    const std::vector<Verdict> verdicts = GateVerdicts(before, after);
    return std::all_of(verdicts.begin(), verdicts.end(),
                       [](const Verdict& verdict) { return verdict.passed; });
  };
  for (const auto& [score, nights] : Table()) {
    const Results bad = Night(score, nights.unit, nights.bad);
    const Results good = Night(score, nights.unit, nights.good);
    EXPECT_FALSE(passes(good, bad)) << score;
    EXPECT_TRUE(passes(bad, good)) << score;
  }
}

/// One seed in three that gets far worse is a mixed distribution; one that gets far better is not.
TEST(DirectionTest, SeedsBreakTowardsTheBadSideAlone) {
  for (const auto& [score, nights] : Table()) {
    const auto mixed = [&](double most, double some) {
      Results night = Night(score, nights.unit, most);
      for (RunRecord& run : night.runs) {
        if (run.spec.seed % 3 == 0) *run.scores[score].value = some;
      }
      return ChangeBetween(Night(score, nights.unit, most), night);
    };
    EXPECT_EQ(mixed(nights.good, nights.bad), Change::kUnstable) << score;
    EXPECT_FALSE(IsAlarm(mixed(nights.bad, nights.good))) << score;
  }
}

/// A baseline keeps what is compared: what is judged, and time and memory, which are watched.
TEST(DirectionTest, NoJudgedScoreIsLeftOutHere) {
  Results all;
  RunRecord& run = all.runs.emplace_back();
  run.spec.system = BuiltIn("oracle");
  std::vector<std::string> names;  // some of them stand for many, as mover_large_found_within_*
  for (const ScoreDescription& description : ScoreNames()) names.push_back(description.name);
  for (const auto& [score, nights] : Table()) {
    EXPECT_TRUE(IsScoreName(score)) << score;
    names.push_back(score);
  }
  for (const std::string& name : names) {
    run.scores[name] = {.value = 1, .unit = "1", .alignment = "", .n = 9, .absent = ""};
  }
  std::size_t judged = 0;
  for (const Comparison& c : Compare(all, all)) {
    if (c.change == Change::kWatched) continue;
    ++judged;
    EXPECT_TRUE(Table().contains(c.score)) << c.score << " is judged: which way is it good?";
  }
  EXPECT_EQ(judged, Table().size());
}

}  // namespace
}  // namespace aisle
