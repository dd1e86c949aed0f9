// Masks and objects, counted in pictures small enough to be counted by hand.
#include "harness/score/masks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "harness/score/mask_scores.h"

namespace aisle {
namespace {

constexpr int kWidth = 300, kHeight = 200;

cv::Mat1b Even(unsigned char level = 0) { return cv::Mat1b(kHeight, kWidth, level); }

DynamicRegions Mask(const std::vector<cv::Rect>& where) {
  DynamicRegions regions;
  regions.mask = Even();
  for (const cv::Rect& rect : where) regions.mask(rect) = 255;
  return regions;
}

/// A grey wall with points of light, each of them one corner to FAST, and what covers them.
struct PointsOfLight {
  cv::Mat1b left = Even(100);
  FrameTruth truth;
  DynamicRegions regions;
  int put = 0;

  PointsOfLight() {
    truth.dynamic = Even();
    regions.mask = Even();
  }
  void Put(int count, bool moves, bool rejected, int brighter = 120) {
    for (int i = 0; i < count; ++i, ++put) {
      const cv::Point at(20 + 20 * (put % 13), 20 + 20 * (put / 13));
      const cv::Rect around(at - cv::Point(4, 4), cv::Size(9, 9));
      left(at) = static_cast<unsigned char>(100 + brighter);
      if (moves) truth.dynamic(around) = 255;
      if (rejected) regions.mask(around) = 255;
    }
  }
};

TEST(MaskPictureTest, CornersLostAreThoseThatStandUnderTheMask) {
  PointsOfLight picture;
  picture.Put(8, /*moves=*/false, /*rejected=*/false);
  picture.Put(3, false, true);
  picture.Put(4, true, true);
  picture.Put(2, true, false);
  picture.Put(5, false, true, MaskOptions{}.corner_threshold - 1);  // too dim for a corner
  const MaskFacts facts = CompareMasks(picture.left, picture.truth, picture.regions);
  EXPECT_EQ(facts.static_corners, 8 + 3);
  EXPECT_EQ(facts.static_corners_lost, 3);
  EXPECT_EQ(facts.corners_rejected, 3 + 4);

  FrameFacts frame;
  frame.mask = facts;
  Scorecard scores;
  AddMasks({frame, frame}, &scores);
  EXPECT_DOUBLE_EQ(scores.at("static_features_lost").value.value(), 3.0 / 11);
  EXPECT_EQ(scores.at("static_features_lost").n, 22u);
}

TEST(MaskPictureTest, WithoutAMaskNoCornerIsLostAndUnderAFullOneEach) {
  PointsOfLight picture;
  picture.Put(8, false, false);
  picture.Put(2, true, false);
  const MaskFacts none = CompareMasks(picture.left, picture.truth, {});
  EXPECT_EQ(none.static_corners, 8);
  EXPECT_EQ(none.static_corners_lost, 0);
  EXPECT_EQ(none.corners_rejected, 0);
  const MaskFacts all = CompareMasks(picture.left, picture.truth, Mask({{0, 0, kWidth, kHeight}}));
  EXPECT_EQ(all.static_corners_lost, 8);
  EXPECT_EQ(all.corners_rejected, 10);
}

/// Of one height, so that overlaps are those of their widths.
cv::Rect2d Span(double from, double to) { return {from, 10, to - from, 50}; }

MaskFacts Match(const std::vector<cv::Rect2d>& truth, const std::vector<cv::Rect2d>& rejected) {
  std::vector<RejectedRegion> regions;
  for (const cv::Rect2d& box : rejected) regions.push_back({box, 100, 0});
  return MatchBoxes(truth, regions, {});
}

/// Who comes first in either list could take the other's partner.
TEST(MaskPictureTest, TheLargestOverlapIsPairedFirstInWhateverOrder) {
  const cv::Rect2d one = Span(0, 100), other = Span(40, 140);
  const cv::Rect2d on_one = Span(0, 95), on_both = Span(30, 130);
  ASSERT_GT(Iou(one, on_both), MaskOptions{}.match_iou);
  for (const auto& truth : {std::vector{one, other}, std::vector{other, one}}) {
    for (const auto& rejected : {std::vector{on_one, on_both}, std::vector{on_both, on_one}}) {
      const MaskFacts facts = Match(truth, rejected);
      EXPECT_EQ(facts.objects_found, 2);
      EXPECT_EQ(facts.objects_missed, 0);
      EXPECT_EQ(facts.objects_invented, 0);
      EXPECT_NEAR(facts.iou_sum, 95.0 / 100 + 90.0 / 110, 1e-12);
    }
  }
}

TEST(MaskPictureTest, OneRectangleIsOneObjects) {
  const MaskFacts facts = Match({Span(0, 100), Span(30, 130)}, {Span(0, 100)});
  EXPECT_EQ(facts.objects_found, 1);
  EXPECT_EQ(facts.objects_missed, 1);
  EXPECT_DOUBLE_EQ(facts.iou_sum, 1);
  EXPECT_EQ(Match({Span(0, 100)}, {Span(0, 100), Span(0, 90)}).objects_invented, 1);
}

TEST(MaskPictureTest, ABlobIsADetectionFromItsFewestPixelsOn) {
  const MaskOptions options;
  ASSERT_EQ(options.min_region_pixels, 50);
  const cv::Rect enough(100, 100, 10, 5), too_few(200, 50, 7, 7);
  const std::vector<cv::Rect2d> boxes = RejectedBoxes(Mask({enough, too_few}), options);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0], cv::Rect2d(enough));
}

TEST(MaskPictureTest, AGapPartsABlobFromItsWidthOn) {
  const MaskOptions options;
  const cv::Rect one(50, 50, 40, 60);
  for (const bool upright : {false, true}) {
    for (const int gap : {1, options.close_gap_px - 1, options.close_gap_px}) {
      const cv::Point by = upright ? cv::Point(0, 60 + gap) : cv::Point(40 + gap, 0);
      const std::vector<cv::Rect2d> boxes = RejectedBoxes(Mask({one, one + by}), options);
      if (gap < options.close_gap_px) {
        ASSERT_EQ(boxes.size(), 1u) << gap;
        EXPECT_EQ(boxes[0], cv::Rect2d(one | (one + by)));
      } else {
        EXPECT_EQ(boxes.size(), 2u) << gap;
      }
    }
  }
}

TEST(MaskPictureTest, AnObjectsDistanceIsFromTheRig) {
  FrameTruth truth;
  truth.T_world_rig.translation() << 10, -2, 1;
  truth.T_world_rig.linear() = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  truth.dynamic = Even();
  truth.instance = cv::Mat1w(kHeight, kWidth, static_cast<unsigned short>(0));
  truth.dynamic(cv::Rect(20, 20, 40, 100)) = 255;
  truth.instance(cv::Rect(20, 20, 40, 100)) = 7;
  ObjectTruth walker;
  walker.instance = 7;
  walker.center_m = truth.T_world_rig.translation() + Eigen::Vector3d(3, -4, 0);
  walker.velocity_mps << 0, 0.6, 0.8;
  truth.objects.push_back(walker);
  const std::vector<ObjectOutcome> objects = CompareMasks(Even(), truth, {}).objects;
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_DOUBLE_EQ(objects[0].distance_m, 5);
  EXPECT_DOUBLE_EQ(objects[0].speed_mps, 1);
  EXPECT_EQ(objects[0].pixels, 4000);
  EXPECT_DOUBLE_EQ(objects[0].share, 4000.0 / (kWidth * kHeight));
}

/// Objects on both sides of each bound that the scores' names give.
struct Bound {
  const char* score;
  double ObjectOutcome::*value;
  double from, to;  ///< `from` belongs to it, `to` does not
};
constexpr double kAny = 1e9;
constexpr Bound kBounds[] = {
    {"distance_below_3m", &ObjectOutcome::distance_m, 0, 3},
    {"distance_3_to_6m", &ObjectOutcome::distance_m, 3, 6},
    {"distance_above_6m", &ObjectOutcome::distance_m, 6, kAny},
    {"speed_below_0.3mps", &ObjectOutcome::speed_mps, 0, 0.3},
    {"speed_0.3_to_1.5mps", &ObjectOutcome::speed_mps, 0.3, 1.5},
    {"speed_above_1.5mps", &ObjectOutcome::speed_mps, 1.5, kAny},
};

Scorecard ScoresOf(const std::vector<ObjectOutcome>& objects) {
  FrameFacts frame;
  frame.mask.emplace();
  frame.mask->objects = objects;
  Scorecard scores;
  AddMasks({frame}, &scores);
  return scores;
}

TEST(ObjectKindsTest, AreSplitWhereTheirNamesSay) {
  for (const Bound& bound : kBounds) {
    int within = 0, found = 0;
    std::vector<ObjectOutcome> objects;
    for (const double value :
         {0.0, 0.1, 0.299, 0.3, 0.5, 0.79, 1.49, 1.5, 2.9, 3.0, 4.0, 5.99, 6.0, 8.0, 100.0}) {
      ObjectOutcome object;
      object.*bound.value = value;
      object.found = objects.size() % 3 != 0;
      objects.push_back(object);
      if (value < bound.from || value >= bound.to) continue;
      ++within;
      found += object.found ? 1 : 0;
    }
    const Score score = ScoresOf(objects).at(std::string("object_recall_") + bound.score);
    EXPECT_EQ(score.n, static_cast<std::size_t>(within)) << bound.score;
    EXPECT_DOUBLE_EQ(score.value.value(), static_cast<double>(found) / within) << bound.score;
  }
}

TEST(ObjectKindsTest, EachObjectIsOfOneSizeOneDistanceAndOneSpeed) {
  std::vector<ObjectOutcome> objects;
  for (int i = 0; i < 200; ++i) {
    ObjectOutcome object;
    object.pixels = 150 * i;
    object.distance_m = 0.05 * i;
    object.speed_mps = 0.0125 * i;
    objects.push_back(object);
  }
  std::map<std::string, std::size_t> sum;
  for (const auto& [name, score] : ScoresOf(objects)) {
    for (const char* split :
         {"object_recall_size_", "object_recall_distance_", "object_recall_speed_"}) {
      if (name.starts_with(split)) sum[split] += score.n;
    }
  }
  EXPECT_EQ(sum.size(), 3u);
  for (const auto& [split, n] : sum) EXPECT_EQ(n, objects.size()) << split;
}

}  // namespace
}  // namespace aisle
