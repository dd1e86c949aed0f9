// What a night of several cells tells of a system as a whole, and how seldom it tells it of
// nothing.
#include "harness/judge/pooled.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "harness/io/file.h"
#include "harness/judge/gate.h"

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kSystems[] = {"orbslam2", "plain", "paper", "robust", "oracle"};
constexpr const char* kErrors[] = {"ate_rmse_m", "ate_live_rmse_m", "error_all_p95_m",
                                   "rpe_1s_trans_rmse_m", "rpe_1s_rot_rmse_deg"};

/// What a seed's error was before and is after, each as a factor of its cell's level.
using DrawPair = std::function<std::pair<double, double>(std::mt19937_64&)>;

/// Two nights of the nightly suite's shape: five scenes, five systems, nine seeds.
std::pair<Results, Results> Nights(std::uint64_t seed_of_night, const DrawPair& draw) {
  std::mt19937_64 random(seed_of_night);
  Results before, after;
  for (int scene = 1; scene <= 5; ++scene) {
    for (const char* system : kSystems) {
      for (std::uint64_t seed = 1; seed <= 9; ++seed) {
        RunRecord was;
        was.spec = {.scene = fmt::format("paper/scene{}", scene),
                    .scene_file = "",
                    .twin = "live",
                    .system = BuiltIn(system),
                    .seed = seed};
        RunRecord is = was;
        for (const char* error : kErrors) {
          const auto [then, now] = draw(random);
          const double level = 0.004 * scene;
          was.scores[error] = {
              .value = level * then, .unit = "m", .alignment = "", .n = 9, .absent = ""};
          is.scores[error] = {
              .value = level * now, .unit = "m", .alignment = "", .n = 9, .absent = ""};
        }
        before.runs.push_back(std::move(was));
        after.runs.push_back(std::move(is));
      }
    }
  }
  return {std::move(before), std::move(after)};
}

/// Nothing changed but bits: each seed's error is what it was but for a factor of such a spread.
DrawPair Scatters(double sigma) {
  return [sigma](std::mt19937_64& random) {
    std::lognormal_distribution<double> of_seed(0, 0.3), again(0, sigma);
    const double before = of_seed(random);
    return std::pair(before, before * again(random));
  };
}

void Multiply(Results* night, const std::string& score, double factor,
              const std::function<bool(const RunSpec&)>& is_meant) {
  for (RunRecord& run : night->runs) {
    if (is_meant(run.spec) && run.scores.contains(score)) *run.scores[score].value *= factor;
  }
}

/// The comparison of a score of a system: over all its cells where no scene is named.
Comparison Of(const std::vector<Comparison>& comparisons, const std::string& system,
              const std::string& score, const std::string& scene = "") {
  for (const Comparison& c : comparisons) {
    if (c.system == system && c.score == score && c.scene == scene) return c;
  }
  throw std::logic_error("no " + score + " of " + system + " on " + scene);
}

bool IsNews(const Comparison& c) { return IsAlarm(c.change) || c.change == Change::kBetter; }

TEST(PooledTest, ASystemThatIsAThirdWorseEverywhereIsTold) {
  const auto is_plain = [](const RunSpec& spec) { return spec.system.name == "plain"; };
  for (const double sigma : {0.0, 0.001, 0.1}) {
    auto [before, after] = Nights(1, Scatters(sigma));
    Multiply(&after, "ate_rmse_m", 1.3, is_plain);
    const std::vector<Comparison> comparisons = Compare(before, after);
    const Comparison plain = Of(comparisons, "plain", "ate_rmse_m");
    EXPECT_EQ(plain.change, Change::kWorse) << sigma << plain.why;
    EXPECT_EQ(plain.cells, 5u);
    EXPECT_EQ(plain.old_n, 45u);
    EXPECT_NEAR(plain.factor.value(), 1.3, 0.05);
    for (const Comparison& c : comparisons) {
      if (c.cells == 0 || !IsNews(c)) continue;
      EXPECT_EQ(c.system + c.score, "plainate_rmse_m") << c.why;
    }
    EXPECT_EQ(Of(Compare(after, before), "plain", "ate_rmse_m").change, Change::kBetter);
  }
}

TEST(PooledTest, TheGateSaysBySystemHowMuchAndOfHowManySeeds) {
  auto [before, after] = Nights(1, Scatters(0));
  Multiply(&after, "ate_rmse_m", 1.3,
           [](const RunSpec& spec) { return spec.system.name == "plain"; });
  const std::vector<Verdict> verdicts = GateVerdicts(before, after);
  const Verdict first = *std::ranges::find(verdicts, false, &Verdict::passed);
  EXPECT_EQ(first.name, "all cells of plain: ate_rmse_m against the baseline");
  EXPECT_THAT(first.why, HasSubstr("worse: by 30 % (median of 5 cells); 45 of 45 seeds got worse"));
  EXPECT_EQ(first.scene, "");
  EXPECT_EQ(first.system, "plain");
}

TEST(PooledTest, OneCellThatIsTwiceAsBadIsToldAsThatCell) {
  for (const double sigma : {0.001, 0.1}) {
    auto [before, after] = Nights(2, Scatters(sigma));
    const auto is_cell = [](const RunSpec& spec) {
      return spec.system.name == "robust" && spec.scene == "paper/scene3";
    };
    Multiply(&after, "ate_rmse_m", 2, is_cell);
    for (const Comparison& c : Compare(before, after)) {
      const bool is_it = c.system == "robust" && c.scene == "paper/scene3" && c.score == kErrors[0];
      EXPECT_EQ(c.change == Change::kWorse, is_it) << c.scene << c.system << c.score << c.why;
    }
  }
}

/// Much in two cells of five is theirs; over the system it is not told.
TEST(PooledTest, WhatBefellFewerThanHalfOfTheCellsIsNotOfTheSystem) {
  auto [before, after] = Nights(3, Scatters(0.05));
  Multiply(&after, "ate_rmse_m", 5,
           [](const RunSpec& spec) { return spec.scene <= "paper/scene2"; });
  const std::vector<Comparison> comparisons = Compare(before, after);
  for (const char* system : kSystems) {
    const Comparison over_all = Of(comparisons, system, "ate_rmse_m");
    EXPECT_EQ(over_all.change, Change::kCannotTell) << over_all.why;
    EXPECT_THAT(over_all.why, HasSubstr("2 of 5 cells by more than the minimum effect"));
    EXPECT_EQ(Of(comparisons, system, "ate_rmse_m", "paper/scene1").change, Change::kWorse);
  }
}

/// Twenty scenes of one seed, of which no cell alone can ever tell anything.
TEST(PooledTest, ManyCellsOfOneSeedAreEnough) {
  Results before, after;
  for (int scene = 0; scene < 20; ++scene) {
    RunRecord run;
    run.spec = {.scene = fmt::format("s{}", scene),
                .scene_file = "",
                .twin = "live",
                .system = BuiltIn("plain"),
                .seed = 1};
    run.scores["mask_iou"] = {
        .value = 0.8 - 0.01 * scene, .unit = "1", .alignment = "", .n = 9, .absent = ""};
    run.scores["collisions"] = {.value = 0, .unit = "1", .alignment = "", .n = 9, .absent = ""};
    before.runs.push_back(run);
    *run.scores["mask_iou"].value *= 0.8;
    *run.scores["collisions"].value += 1;
    after.runs.push_back(run);
  }
  const std::vector<Comparison> comparisons = Compare(before, after);
  const Comparison masks = Of(comparisons, "plain", "mask_iou");
  EXPECT_EQ(masks.change, Change::kWorse) << masks.why;
  EXPECT_THAT(masks.why, HasSubstr("by 20 % (median of 20 cells); 20 of 20 seeds got worse"));
  const Comparison touches = Of(comparisons, "plain", "collisions");
  EXPECT_EQ(touches.change, Change::kWorse) << touches.why;
  EXPECT_FALSE(touches.factor) << "of nothing there is no share";
  EXPECT_THAT(touches.why, HasSubstr("by 1 (median of 20 cells)"));
  EXPECT_EQ(Of(Compare(before, before), "plain", "mask_iou").change, Change::kSame);
}

TEST(PooledTest, OneCellSpeaksForItself) {
  auto [before, after] = Nights(4, Scatters(0.1));
  for (Results* night : {&before, &after}) {
    std::erase_if(night->runs,
                  [](const RunRecord& run) { return run.spec.scene != "paper/scene1"; });
  }
  for (const Comparison& c : Compare(before, after)) EXPECT_EQ(c.cells, 0u);
}

/// Nights on which nothing changed but bits. Seeds may be drawn anew, or keep what they have by a
/// tenth or a third; or one in nine errs by twice as much, in either night or in this one alone,
/// where medians see next to nothing of it.
TEST(PooledTest, UnchangedNightsRaiseNoMoreFalseAlarmsThanAlphaSays) {
  const auto doubles_in = [](bool before_too) {
    return [before_too](std::mt19937_64& random) {
      std::uniform_real_distribution<double> uniform(0, 1);
      const auto [before, after] = Scatters(0.1)(random);
      const double then = uniform(random) < 1.0 / 9 ? 2 : 1;
      const double now = uniform(random) < 1.0 / 9 ? 2 : 1;
      return std::pair(before * (before_too ? then : 1), after * now);
    };
  };
  const DrawPair anew = [](std::mt19937_64& random) {
    std::lognormal_distribution<double> of_seed(0, 0.35);
    const double before = of_seed(random);
    return std::pair(before, of_seed(random));
  };
  const std::pair<const char*, DrawPair> kinds[] = {{"a tenth", Scatters(0.1)},
                                                    {"a third", Scatters(0.3)},
                                                    {"anew", anew},
                                                    {"doubled in either", doubles_in(true)},
                                                    {"doubled tonight", doubles_in(false)}};
  constexpr int kNights = 40;
  int alarms = 0;
  for (const auto& [name, draw] : kinds) {
    for (std::uint64_t night = 0; night < kNights; ++night) {
      const auto [before, after] = Nights(1000 + night, draw);
      for (const Comparison& c : Compare(before, after)) {
        if (!IsNews(c)) continue;
        ++alarms;
        fmt::print("{}, night {}: {} {} {}: {}\n", name, night, NameOfCell(c), c.score,
                   Name(c.change), c.why);
        break;
      }
    }
  }
  EXPECT_LE(alarms, static_cast<int>(std::size(kinds)) * kNights / 100);
}

/// The committed baseline, every score of which differs in its last bits tonight: of how many of
/// its 25 cells a growth of the absolute error is told, where the seeds grow alike.
TEST(PooledTest, OnTheNightlyBaselineWhatGrowsByHalfIsToldInEveryCell) {
  const std::string file = AISLE_SOURCE_DIR "/reports/baselines/nightly.json";
  const Results baseline = ResultsFromJson(ReadFile(file), file);
  Results night = baseline;
  std::mt19937_64 random(1);
  std::normal_distribution<double> bits(1, 1e-9);
  for (RunRecord& run : night.runs) {
    for (auto& [name, score] : run.scores) {
      if (score.value && name != "coverage") *score.value *= bits(random);
    }
  }
  for (const auto& [factor, least] : {std::pair(1.0, 0), std::pair(1.2, 0), std::pair(1.5, 25)}) {
    Results worse = night;
    Multiply(&worse, "ate_rmse_m", factor, [](const RunSpec&) { return true; });
    int cells = 0, systems = 0;
    for (const Comparison& c : Compare(baseline, worse)) {
      if (!IsNews(c)) continue;
      EXPECT_EQ(c.score, "ate_rmse_m") << NameOfCell(c) << c.why;
      (c.cells > 0 ? systems : cells) += 1;
    }
    EXPECT_GE(cells, least) << factor;
    EXPECT_EQ(systems, factor > 1 ? 5 : 0) << factor;
    EXPECT_TRUE(factor > 1 || cells == 0) << cells;
  }
}

}  // namespace
}  // namespace aisle
