// Movers over time: hand-made sequences with known answers, and laws on random ones.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "harness/score/continuity.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

constexpr std::int64_t kFrameNs = 50'000'000;
constexpr int kWalker = 7, kCreeper = 3;

/// A large walker, or a creeper, who is covered or not.
ObjectOutcome Seen(int instance, bool covered) {
  ObjectOutcome object;
  object.instance = instance;
  object.object_class = "person";
  object.share = 0.02;
  object.speed_mps = instance == kCreeper ? 0.1 : 1.2;
  object.rejected = covered ? 0.5 : 0.49;
  return object;
}

/// Frames of 20 a second before a standing rig, in which nobody is asked for.
std::vector<FrameFacts> EmptyFrames(std::size_t count) {
  std::vector<FrameFacts> frames(count);
  for (std::size_t i = 0; i < count; ++i) {
    frames[i].stamp_ns = static_cast<std::int64_t>(i) * kFrameNs;
    frames[i].mask = MaskFacts{};
  }
  return frames;
}

/// One letter a frame: c covered, - asked for but not covered, a blank not asked for.
void Put(int instance, const std::string& told, std::vector<FrameFacts>* frames) {
  for (std::size_t i = 0; i < told.size(); ++i) {
    if (told[i] == ' ') continue;
    (*frames)[i].mask->objects.push_back(Seen(instance, told[i] == 'c'));
  }
}

std::vector<FrameFacts> Frames(const std::string& told, int instance = kWalker) {
  std::vector<FrameFacts> frames = EmptyFrames(told.size());
  Put(instance, told, &frames);
  return frames;
}

std::string Times(std::size_t count, char letter) { return std::string(count, letter); }

/// The rig turns by `rate_dps` into every frame from `from` on, `to` not included.
void Turn(std::size_t from, std::size_t to, double rate_dps, std::vector<FrameFacts>* frames) {
  double heading_rad = 0;
  for (std::size_t i = 0; i < frames->size(); ++i) {
    if (i >= from && i < to) heading_rad += rate_dps * M_PI / 180 * kFrameNs * 1e-9;
    (*frames)[i].T_world_rig.linear() =
        Eigen::AngleAxisd(heading_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
}

bool Anybody(const ObjectOutcome&) { return true; }

MoverSpell OnlySpell(const std::vector<FrameFacts>& frames) {
  const std::vector<MoverSpell> spells = FollowMovers(frames, Anybody);
  EXPECT_EQ(spells.size(), 1u);
  return spells.empty() ? MoverSpell{} : spells.front();
}

Scorecard Scores(const std::vector<FrameFacts>& frames) {
  Scorecard scores;
  AddContinuity(FollowKinds(frames), {}, &scores);
  return scores;
}

double Value(const Scorecard& scores, const std::string& name) { return *scores.at(name).value; }

TEST(ContinuityTest, AMoverFoundAtOnceHasNoDelayAndNoGap) {
  const MoverSpell spell = OnlySpell(Frames(Times(30, 'c')));
  EXPECT_EQ(spell.instance, kWalker);
  EXPECT_EQ(spell.object_class, "person");
  EXPECT_EQ(spell.frames, 30);
  EXPECT_DOUBLE_EQ(spell.length_s(), 29 * 0.05);
  EXPECT_DOUBLE_EQ(*spell.delay_s, 0);
  EXPECT_EQ(spell.gap_frames, 0);
  EXPECT_NEAR(spell.mean_speed_mps, 1.2, 1e-12);
  EXPECT_DOUBLE_EQ(spell.largest_share, 0.02);
}

TEST(ContinuityTest, TheDelayRunsToTheFirstCoveredFrameAndIsNoGap) {
  const MoverSpell spell = OnlySpell(Frames("   ------cc"));
  EXPECT_DOUBLE_EQ(*spell.delay_s, 6 * 0.05);
  EXPECT_EQ(spell.gap_frames, 0);
}

TEST(ContinuityTest, TheDelayFollowsTheStampsWhereFramesAreDropped) {
  std::vector<FrameFacts> frames = Frames("--c");
  frames[2].stamp_ns = 10 * kFrameNs;
  EXPECT_DOUBLE_EQ(*OnlySpell(frames).delay_s, 0.5);
}

TEST(ContinuityTest, AMoverLostTwiceHasItsLongestGap) {
  EXPECT_EQ(OnlySpell(Frames("-----c---cc----c--")).gap_frames, 4);
  EXPECT_EQ(OnlySpell(Frames("c---c---c")).gap_frames, 3);
}

TEST(ContinuityTest, AGapMayLastToTheEnd) { EXPECT_EQ(OnlySpell(Frames("cc-----")).gap_frames, 5); }

TEST(ContinuityTest, ANeverFoundMoverHasNoDelayButCountsWithItsLengthAsTheLeast) {
  const std::vector<FrameFacts> frames = Frames(Times(41, '-'));
  EXPECT_FALSE(OnlySpell(frames).delay_s);
  const Scorecard scores = Scores(frames);
  EXPECT_EQ(Value(scores, "mover_large_found_within_1s"), 0);
  EXPECT_EQ(Value(scores, "mover_large_found"), 0);
  EXPECT_DOUBLE_EQ(Value(scores, "mover_large_delay_max_s"), 2);
  EXPECT_EQ(scores.count("mover_large_gap_max_frames"), 0u);
}

TEST(ContinuityTest, MoversAreToldApartByInstanceWhateverTheirOrder) {
  const std::string first = "--cc-c", second = "c---cc";
  std::vector<FrameFacts> frames = EmptyFrames(first.size());
  Put(4, first, &frames);
  Put(9, second, &frames);
  const auto spells = [&] { return FollowMovers(frames, Anybody); };
  for (const bool swapped : {false, true}) {
    if (swapped) std::ranges::reverse(frames[3].mask->objects);
    ASSERT_EQ(spells().size(), 2u);
    EXPECT_EQ(spells()[0].instance, 4);
    EXPECT_DOUBLE_EQ(*spells()[0].delay_s, 0.1);
    EXPECT_EQ(spells()[0].gap_frames, 1);
    EXPECT_EQ(spells()[1].instance, 9);
    EXPECT_DOUBLE_EQ(*spells()[1].delay_s, 0);
    EXPECT_EQ(spells()[1].gap_frames, 3);
  }
}

TEST(ContinuityTest, WhoStopsAndStartsAgainMustBeFoundAnew) {
  const std::vector<MoverSpell> spells = FollowMovers(Frames("-cc   ---c"), Anybody);
  ASSERT_EQ(spells.size(), 2u);
  EXPECT_DOUBLE_EQ(*spells[0].delay_s, 0.05);
  EXPECT_DOUBLE_EQ(*spells[1].delay_s, 0.15);
  EXPECT_EQ(spells[1].first_ns, 6 * kFrameNs);
}

TEST(ContinuityTest, APauseOfTwoFramesEndsNoSpellAndNoGap) {
  const MoverSpell spell = OnlySpell(Frames("c--  --c"));
  EXPECT_EQ(spell.frames, 6);
  EXPECT_EQ(spell.gap_frames, 4);
  const std::vector<MoverSpell> two =
      FollowMovers(Frames("c--  --c"), Anybody, {.max_pause_frames = 1});
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0].gap_frames, 2);
}

TEST(ContinuityTest, AFrameWithoutLabelsAsksForNothing) {
  std::vector<FrameFacts> frames = Frames("c-c-c");
  frames[1].mask.reset();
  EXPECT_EQ(OnlySpell(frames).gap_frames, 1);
  for (FrameFacts& frame : frames) frame.mask.reset();
  EXPECT_TRUE(FollowMovers(frames, Anybody).empty());
  EXPECT_TRUE(FollowMovers({}, Anybody).empty());
  EXPECT_TRUE(Scores(frames).empty());
}

TEST(ContinuityTest, OfAGapOnlyFramesInWhichTheRigTurnsCountAsTurning) {
  std::vector<FrameFacts> frames = Frames("cc-----cc---c");
  Turn(4, 9, 30, &frames);
  const MoverSpell spell = OnlySpell(frames);
  EXPECT_EQ(spell.gap_frames, 5);
  EXPECT_EQ(spell.turning_frames, 5);
  EXPECT_EQ(spell.gap_turning_frames, 3);
  const Scorecard scores = Scores(frames);
  EXPECT_EQ(Value(scores, "mover_large_gap_max_frames"), 5);
  EXPECT_EQ(Value(scores, "mover_large_gap_turning_max_frames"), 3);
  EXPECT_EQ(scores.at("mover_large_gap_max_frames").unit, "frames");
}

TEST(ContinuityTest, ARigThatSwaysOrStandsDoesNotTurn) {
  std::vector<FrameFacts> frames = Frames("cc-----cc");
  Turn(0, 9, 9.5, &frames);
  EXPECT_EQ(OnlySpell(frames).turning_frames, 0);
  EXPECT_EQ(Scores(frames).count("mover_large_gap_turning_max_frames"), 0u);
}

TEST(ContinuityTest, TurningBeforeTheMoverWasFoundIsNoGap) {
  std::vector<FrameFacts> frames = Frames("-----cc");
  Turn(0, 5, 30, &frames);
  EXPECT_EQ(OnlySpell(frames).turning_frames, 0);
}

TEST(ContinuityTest, ASpellShorterThanASecondProvesNothingOfDelaysEitherWay) {
  for (const char letter : {'-', 'c'}) {
    const Scorecard scores = Scores(Frames(Times(20, letter)));
    EXPECT_EQ(scores.count("mover_large_found_within_1s"), 0u);
    EXPECT_EQ(scores.count("mover_large_delay_max_s"), 0u);
  }
  EXPECT_EQ(Scores(Frames(Times(21, '-'))).count("mover_large_found_within_1s"), 1u);
  EXPECT_EQ(Value(Scores(Frames("c---c")), "mover_large_gap_max_frames"), 3);
}

TEST(ContinuityTest, ASecondIsWithinASecond) {
  const auto found_after = [](std::size_t frames) {
    return Value(Scores(Frames(Times(frames, '-') + Times(9, 'c'))), "mover_large_found_within_1s");
  };
  EXPECT_EQ(found_after(20), 1);
  EXPECT_EQ(found_after(21), 0);
}

TEST(ContinuityTest, LargeAndSlowMoversAreScoredApart) {
  std::vector<FrameFacts> frames = EmptyFrames(60);
  Put(kWalker, Times(60, 'c'), &frames);
  Put(kCreeper, Times(30, '-') + Times(10, 'c') + Times(7, '-') + Times(13, 'c'), &frames);
  const Scorecard scores = Scores(frames);
  EXPECT_EQ(Value(scores, "mover_large_found_within_1s"), 1);
  EXPECT_EQ(Value(scores, "mover_large_delay_max_s"), 0);
  EXPECT_EQ(Value(scores, "mover_large_gap_max_frames"), 0);
  EXPECT_EQ(Value(scores, "mover_slow_found_within_1s"), 0);
  EXPECT_EQ(Value(scores, "mover_slow_found"), 1);
  EXPECT_DOUBLE_EQ(Value(scores, "mover_slow_delay_median_s"), 1.5);
  EXPECT_EQ(Value(scores, "mover_slow_gap_max_frames"), 7);
  EXPECT_EQ(scores.at("mover_slow_delay_median_s").n, 1u);
}

TEST(ContinuityTest, TheClockStartsWhenAMoverGrowsLarge) {
  std::vector<FrameFacts> frames = Frames(Times(40, '-') + Times(20, 'c'));
  for (std::size_t i = 0; i < 30; ++i) frames[i].mask->objects[0].share = 0.009;
  EXPECT_DOUBLE_EQ(Value(Scores(frames), "mover_large_delay_max_s"), 0.5);
}

TEST(ContinuityTest, WhoSlowsDownIsAskedForAsASlowMoverFromThenOn) {
  std::vector<FrameFacts> frames = Frames(Times(30, 'c') + Times(15, '-') + Times(15, 'c'));
  for (std::size_t i = 30; i < 60; ++i) frames[i].mask->objects[0].speed_mps = 0.1;
  const Scorecard scores = Scores(frames);
  EXPECT_DOUBLE_EQ(Value(scores, "mover_large_delay_max_s"), 0);
  EXPECT_DOUBLE_EQ(Value(scores, "mover_slow_delay_max_s"), 0.75);
}

TEST(ContinuityTest, ARunsScorecardHoldsThem) {
  RunResult run;
  run.facts = Frames(Times(10, '-') + Times(30, 'c') + "----c");
  const Scorecard scores = ScoreMasks(run);
  EXPECT_DOUBLE_EQ(Value(scores, "mover_large_delay_max_s"), 0.5);
  EXPECT_EQ(Value(scores, "mover_large_gap_max_frames"), 4);
  EXPECT_EQ(scores.count("mover_slow_found"), 0u);
}

std::string RandomTale() {
  std::string tale;
  const int count = *rc::gen::inRange(1, 60);
  for (int i = 0; i < count; ++i) tale += "c- "[*rc::gen::inRange(0, 3)];
  return tale;
}

TEST(ContinuityLaws, EveryFrameAskedForBelongsToOneSpellAndFillsItsParts) {
  EXPECT_TRUE(rc::check([] {
    const std::string tale = RandomTale();
    std::vector<FrameFacts> frames = Frames(tale);
    Turn(tale.size() / 3, tale.size(), 30, &frames);
    int asked = 0;
    for (const MoverSpell& spell : FollowMovers(frames, Anybody)) {
      asked += spell.frames;
      RC_ASSERT(spell.gap_frames <= spell.frames);
      RC_ASSERT(spell.gap_turning_frames <= std::min(spell.gap_frames, spell.turning_frames));
      RC_ASSERT(!spell.delay_s || *spell.delay_s <= spell.length_s());
      RC_ASSERT(spell.delay_s || spell.gap_frames + spell.turning_frames == 0);
    }
    RC_ASSERT(asked == std::ranges::count_if(tale, [](char letter) { return letter != ' '; }));
  }));
}

TEST(ContinuityLaws, CoveringMoreNeverMakesTheDelayLonger) {
  EXPECT_TRUE(rc::check([] {
    std::string tale = RandomTale();
    const std::vector<MoverSpell> before = FollowMovers(Frames(tale), Anybody);
    char& one = tale[static_cast<std::size_t>(*rc::gen::inRange(0, static_cast<int>(tale.size())))];
    if (one == '-') one = 'c';
    const std::vector<MoverSpell> after = FollowMovers(Frames(tale), Anybody);
    RC_ASSERT(before.size() == after.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
      RC_ASSERT(after[i].delay_s.value_or(1e9) <= before[i].delay_s.value_or(1e9));
    }
  }));
}

}  // namespace
}  // namespace aisle
