#include "harness/bench/search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

SearchOptions TwoAxes() {
  SearchOptions options;
  options.axes = {{.path = "share", .low = 0, .high = 1},
                  {.path = "count", .low = 10, .high = 1000, .even_ratios = true, .integer = true}};
  options.trials = 60;
  options.explore = 20;
  return options;
}

/// A trial of 1000 pixels in one frame: 100 move, and so many of them are rejected.
Trial Found(int index, OptionSet options, int pixels, int at_rest = 0, double ms = 10) {
  Trial trial{.index = index, .options = std::move(options)};
  DetectorOutcome& o = trial.outcome;
  o.frames = 1;
  o.pixels = 1000;
  o.masks.true_positives = pixels;
  o.masks.false_negatives = 100 - pixels;
  o.masks.false_positives = at_rest;
  o.large = {.asked = 100, .counted = pixels};
  o.stage_ms["dynamic"] = ms;
  return trial;
}

TEST(NextOptionsTest, TheFirstTrialIsTheSystemAsItIs) {
  EXPECT_THAT(NextOptions(TwoAxes(), {}), IsEmpty());
}

TEST(NextOptionsTest, ValuesLieOnTheirAxesAndDependOnSeedAndPlaceAlone) {
  SearchOptions options = TwoAxes();
  std::vector<Trial> before = {Found(0, {}, 0)};
  std::set<std::string> different;
  double low = 1, high = 0;
  for (int k = 1; k < 50; ++k) {
    const OptionSet set = NextOptions(options, before);
    EXPECT_EQ(set, NextOptions(options, before));
    const double share = std::stod(set.at("share"));
    EXPECT_GE(share, 0);
    EXPECT_LE(share, 1);
    EXPECT_GE(std::stoi(set.at("count")), 10);
    EXPECT_LE(std::stoi(set.at("count")), 1000);
    EXPECT_EQ(set.at("count").find('.'), std::string::npos);
    different.insert(set.at("share") + " " + set.at("count"));
    if (k < options.explore) {
      low = std::min(low, share);
      high = std::max(high, share);
    }
    before.push_back(Found(k, set, k % 7));
  }
  EXPECT_GT(different.size(), 45u);
  EXPECT_LT(low, 0.25) << "the whole axis is explored";
  EXPECT_GT(high, 0.75);
  options.seed = 2;
  EXPECT_NE(NextOptions(options, before), NextOptions(TwoAxes(), before));
}

TEST(NextOptionsTest, AfterExploringItStaysNearTheBest) {
  SearchOptions options = TwoAxes();
  options.parents = 1;
  std::vector<Trial> before = {Found(0, {}, 0)};
  for (int k = 1; k < options.trials - 1; ++k) {
    before.push_back(Found(k, {{"share", "0.1"}, {"count", "20"}}, 10));
  }
  before[7] = Found(7, {{"share", "0.8"}, {"count", "500"}}, 90);
  Trial given_up = Found(8, {{"share", "0.1"}, {"count", "20"}}, 100);
  given_up.given_up = true;
  before[8] = given_up;  // better over half of the clips alone: no parent
  const OptionSet next = NextOptions(options, before);
  EXPECT_NEAR(std::stod(next.at("share")), 0.8, 0.35);
  EXPECT_GT(std::stoi(next.at("count")), 100);
}

TEST(NextOptionsTest, WhatIsNotAllowedIsDrawnAnew) {
  const std::vector<Trial> before = {Found(0, {}, 0)};
  const OptionSet first = NextOptions(TwoAxes(), before);
  const OptionSet other =
      NextOptions(TwoAxes(), before, [&](const OptionSet& set) { return set != first; });
  EXPECT_NE(other, first);
  EXPECT_EQ(other.size(), 2u);
}

TEST(TrialTest, TheScoreIsTheMeanOfObjectsF1AndPixelIou) {
  Trial trial = Found(0, {}, 60, 20);  // IoU 60 / 120
  trial.outcome.masks.objects_found = 3;
  trial.outcome.masks.objects_missed = 1;
  trial.outcome.masks.objects_invented = 1;  // F1 = 2 * 3 / (2 * 3 + 2)
  EXPECT_DOUBLE_EQ(trial.outcome.pixel_iou(), 0.5);
  EXPECT_DOUBLE_EQ(trial.outcome.object_f1(), 0.75);
  EXPECT_DOUBLE_EQ(trial.score(), 0.625);
  EXPECT_DOUBLE_EQ(trial.outcome.static_wrong(), 20.0 / 900);
  EXPECT_EQ(Trial().score(), 0);
}

TEST(FrontierTest, KeepsWhatNoOtherBeatsTheLeastLossFirst) {
  Trial half = Found(9, {}, 100);
  half.given_up = true;
  const std::vector<Trial> trials = {Found(0, {}, 50, 30),    Found(1, {}, 60, 30),     // beats 0
                                     Found(2, {}, 40, 10),    Found(3, {}, 60, 31, 5),  // quicker
                                     Found(4, {}, 60, 32, 9), half};
  std::vector<int> kept;
  for (const Trial& trial : Frontier(trials)) kept.push_back(trial.index);
  EXPECT_THAT(kept, ElementsAre(2, 1, 3));
}

TEST(WithTest, OptionsAreAddedAndReplaceTheSystemsOwn) {
  const SystemSpec paper{.name = "paper", .like = "paper", .options = {{"a", "1"}, {"b", "2"}}};
  EXPECT_EQ(With(paper, {{"b", "3"}, {"c", "4"}}).options,
            (OptionSet{{"a", "1"}, {"b", "3"}, {"c", "4"}}));
}

}  // namespace
}  // namespace aisle
