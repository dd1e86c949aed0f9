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
