#include "harness/score/mask_scores.h"

#include <gtest/gtest.h>

namespace aisle {
namespace {

/// 30 pixels found of 40 that move, 20 invented; 3 objects of 4, one invented.
MaskFacts Facts() {
  MaskFacts facts;
  facts.true_positives = 30;
  facts.false_negatives = 10;
  facts.false_positives = 20;
  facts.objects_found = 3;
  facts.objects_missed = 1;
  facts.objects_invented = 1;
  facts.iou_sum = 2.4;
  facts.large_regions = 4;
  facts.large_regions_astray = 1;
  for (const bool found : {true, false}) {
    ObjectOutcome walker;
    walker.share = 0.02;
    walker.speed_mps = 1.2;
    walker.found = found;
    facts.objects.push_back(walker);
  }
  ObjectOutcome speck = facts.objects.front();
  speck.share = 0.001;
  facts.objects.push_back(speck);
  return facts;
}

TEST(DetectionTest, SharesAreTheirDefinitions) {
  const Detection pixels = PixelDetection(Facts());
  EXPECT_DOUBLE_EQ(*pixels.precision.value, 30.0 / 50);
  EXPECT_DOUBLE_EQ(*pixels.recall.value, 30.0 / 40);
  EXPECT_DOUBLE_EQ(*pixels.iou.value, 30.0 / 60);
  const Detection objects = ObjectDetection(Facts());
  EXPECT_DOUBLE_EQ(*objects.precision.value, 3.0 / 4);
  EXPECT_DOUBLE_EQ(*objects.recall.value, 3.0 / 4);
  EXPECT_DOUBLE_EQ(*objects.iou.value, 0.8);
  const Detection large = LargeDetection(Facts());
  EXPECT_DOUBLE_EQ(*large.precision.value, 3.0 / 4);
  EXPECT_DOUBLE_EQ(*large.recall.value, 1.0 / 2);
  EXPECT_EQ(CountLargeMovers(Facts()).asked, 2);
}

TEST(DetectionTest, WhereNothingWasThereThereIsNoShare) {
  for (const Detection& none : {PixelDetection({}), ObjectDetection({}), LargeDetection({})}) {
    for (const Score& score : {none.precision, none.recall, none.iou}) {
      EXPECT_FALSE(score.value);
      EXPECT_FALSE(score.absent.empty());
    }
  }
}

/// Where half of a wide region moves it is a part of a mover, neither found nor invented: precision
/// has no sample, which is not the same as no rejection.
TEST(DetectionTest, RejectedPartsAreNotNothing) {
  cv::Mat1b left(200, 300, static_cast<unsigned char>(128));
  FrameTruth truth;
  truth.dynamic = cv::Mat1b(200, 300, static_cast<unsigned char>(0));
  truth.instance = cv::Mat1w(200, 300, static_cast<unsigned short>(0));
  truth.dynamic(cv::Rect(20, 20, 40, 120)) = 255;
  truth.instance(cv::Rect(20, 20, 40, 120)) = 3;
  DynamicRegions half;
  half.mask = cv::Mat1b(200, 300, static_cast<unsigned char>(0));
  half.mask(cv::Rect(20, 20, 40, 30)) = 255;
  const Score parts = ObjectDetection(CompareMasks(left, truth, half)).precision;
  const Score nothing = ObjectDetection(CompareMasks(left, truth, {})).precision;
  EXPECT_FALSE(parts.value);
  EXPECT_FALSE(nothing.value);
  EXPECT_EQ(nothing.absent, "nothing was rejected");
  EXPECT_EQ(parts.absent.find("nothing"), std::string::npos) << parts.absent;
  const DynamicRegions rectangle{.mask = {}, .regions = {{.box = {20, 20, 40, 30}}}};
  const Score box = ObjectDetection(CompareMasks(left, truth, rectangle)).precision;
  EXPECT_EQ(box.absent, parts.absent) << "a rectangle without a mask is a rejection, too";
  EXPECT_NE(Describe(MaskOptions{}).find("less than half"), std::string::npos) << "the rule";
}

/// What is blanked where nothing moves is a false rejection: its precision is 0 and not silence.
TEST(DetectionTest, LargeRegionsAreJudgedWhereNothingMoves) {
  FrameFacts frame;
  frame.mask.emplace();
  frame.mask->false_positives = 20'000;
  frame.mask->objects_invented = 2;
  frame.mask->large_regions = frame.mask->large_regions_astray = 2;
  Scorecard scores;
  AddMasks({frame}, &scores);
  ASSERT_TRUE(scores.contains("object_precision_large"));
  EXPECT_EQ(scores.at("object_precision_large").value, 0.0);
  EXPECT_EQ(scores.at("object_precision_large").n, 2u);
  frame.mask->large_regions = frame.mask->large_regions_astray = 0;
  Scorecard small;
  AddMasks({frame}, &small);
  EXPECT_FALSE(small.contains("object_precision_large"));
}

TEST(DetectionTest, ARunsScoresAreTheSameShares) {
  FrameFacts frame;
  frame.mask = Facts();
  Scorecard scores;
  AddMasks({frame}, &scores);
  EXPECT_EQ(scores.at("mask_iou").value, PixelDetection(Facts()).iou.value);
  EXPECT_EQ(scores.at("object_precision").value, ObjectDetection(Facts()).precision.value);
  EXPECT_EQ(scores.at("object_recall_large").value, LargeDetection(Facts()).recall.value);
}

}  // namespace
}  // namespace aisle
