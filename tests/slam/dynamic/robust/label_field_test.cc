#include "slam/dynamic/robust/label_field.h"

#include <gtest/gtest.h>

#include "slam/dynamic/common/counter_random.h"
#include "slam/dynamic/robust/moving_regions.h"
#include "tests/slam/dynamic/robust/usual_tolerance.h"

namespace aisle::slam::dynamic {
namespace {

/// A far wall with a near square in the middle, 80x80 pixels, no floor.
struct Square {
  cv::Mat1f disparity = cv::Mat1f(80, 80, 3.0F);
  cv::Mat1b image = cv::Mat1b(80, 80, 100);
  cv::Mat1b floor = cv::Mat1b(80, 80, static_cast<unsigned char>(0));
  cv::Rect area{24, 20, 28, 36};
  Square() { disparity(area).setTo(12.0F); }
  Links links(const FieldOptions& options = {}) const {
    return LinkPixels(disparity, image, floor, test::kUsualTolerance, options);
  }
};

TEST(LinkPixels, SurfacesHoldTogetherAndStepsEdgesAndTheFloorPart) {
  Square square;
  square.image.colRange(60, 80).setTo(200);
  square.floor.rowRange(70, 80).setTo(255);
  const Links links = square.links();
  const auto full = static_cast<float>(FieldOptions{}.coupling);
  EXPECT_FLOAT_EQ(links.right(30, 30), full);
  EXPECT_LT(links.right(30, 51), 0.01F * full);  // from the square to the wall
  EXPECT_LT(links.down(55, 30), 0.01F * full);
  EXPECT_LT(links.right(5, 59), 0.2F * full);  // from grey to white
  EXPECT_GT(links.right(5, 59), 0.1F * full);
  EXPECT_EQ(links.down(69, 5), 0);  // from the wall to the floor
}

TEST(SolveField, WithoutLinksIsTheEvidence) {
  cv::Mat1f evidence(80, 80, -0.5F);
  evidence(4, 4) = 3;
  FieldOptions options;
  options.coupling = 0;
  const cv::Mat1f field = SolveField(evidence, Square().links(options));
  EXPECT_EQ(cv::norm(field, evidence, cv::NORM_INF), 0);
}

TEST(SolveField, SparseEvidenceFillsItsSurfaceAndStopsAtTheStep) {
  const Square square;
  cv::Mat1f evidence(80, 80, -0.25F);
  for (int y = 0; y < 80; y += 2) {
    for (int x = 0; x < 80; x += 2) {
      evidence(y, x) = square.area.contains({x, y}) ? 4.0F : -4.0F;
    }
  }
  const cv::Mat1f log_odds = SolveField(evidence, square.links());
  int wrong = 0;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 80; ++x) wrong += (log_odds(y, x) > 0) != square.area.contains({x, y});
  }
  EXPECT_LT(wrong, 80 * 80 / 50);
}

TEST(SolveField, IsThatOfSweepsPixelByPixel) {
  const cv::Size size(13, 19);  // neither a whole number of bands
  CounterRandom random(1, 1);
  const auto draw = [&](float low, float high) {
    cv::Mat1f image(size);
    for (float& value : image) {
      value = low + (high - low) * static_cast<float>(random.Below(1000)) / 1000;
    }
    return image;
  };
  const cv::Mat1f evidence = draw(-2, 2);
  Links links{draw(0, 1), draw(0, 1)};
  links.right.col(size.width - 1) = 0;
  links.down.row(size.height - 1) = 0;
  const auto belief = [](float l) { return 2 * l / (2 + std::abs(l)); };
  cv::Mat1f field = evidence.clone();
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (int n = 0; n < static_cast<int>(field.total()); ++n) {
      const int k = sweep % 2 == 0 ? n : static_cast<int>(field.total()) - 1 - n;
      const int x = k % size.width, y = k / size.width;
      float sum = evidence(y, x);
      if (x > 0) sum += links.right(y, x - 1) * belief(field(y, x - 1));
      if (y > 0) sum += links.down(y - 1, x) * belief(field(y - 1, x));
      if (x + 1 < size.width) sum += links.right(y, x) * belief(field(y, x + 1));
      if (y + 1 < size.height) sum += links.down(y, x) * belief(field(y + 1, x));
      field(y, x) = sum;
    }
  }
  EXPECT_EQ(cv::norm(SolveField(evidence, links), field, cv::NORM_INF), 0);
}

TEST(SolveField, ALoneWrongPixelIsOutvoted) {
  cv::Mat1f evidence(80, 80, -1.0F);
  evidence(10, 10) = 1.5F;
  EXPECT_LT(SolveField(evidence, Square().links())(10, 10), 0);
}

TEST(GrowMoving, PlainClothJoinsTheSeamThatMovesAndWhatIsSeenStandingDoesNot) {
  const Square square;
  cv::Mat1f evidence(80, 80, -0.2F);
  evidence(square.area & cv::Rect(0, 30, 80, 3)).setTo(4.0F);   // a seam
  evidence(square.area & cv::Rect(0, 46, 80, 3)).setTo(-5.0F);  // a belt that stands still
  const cv::Mat1b moving =
      GrowMoving(evidence, evidence, square.links(), square.floor, cv::Mat1f(80, 80, 20.0F), {});
  EXPECT_EQ(cv::countNonZero(moving(cv::Rect(24, 20, 28, 26))), 28 * 26);
  EXPECT_EQ(cv::countNonZero(moving), 28 * 26);  // neither the belt, nor behind it, nor the wall
}

TEST(GrowMoving, ReachesNoFartherThanAllowed) {
  const Square square;
  cv::Mat1f evidence(80, 80, -0.2F);
  evidence.col(30).setTo(4.0F);
  const cv::Mat1b moving =
      GrowMoving(evidence, evidence, square.links(), square.floor, cv::Mat1f(80, 80, 3.0F), {});
  EXPECT_EQ(cv::countNonZero(moving.row(40)), 7);
}

TEST(GrowMoving, ReachesAsFarAsAllowedAcrossTheWholeImage) {
  const cv::Size size(376, 8);
  const cv::Mat1b image(size, 100), floor(size, static_cast<unsigned char>(0));
  const Links links = LinkPixels(cv::Mat1f(size, 150.0F), image, floor, test::kUsualTolerance, {});
  cv::Mat1f evidence(size, -0.2F);
  evidence.col(0).setTo(4.0F);
  const auto grown = [&](float farthest) {
    return cv::countNonZero(
        GrowMoving(evidence, evidence, links, floor, cv::Mat1f(size, farthest), {}).row(4));
  };
  EXPECT_EQ(grown(200), 201);
  EXPECT_EQ(grown(1000), 376);
}

/// One step of FindRegions on a plain plate of 120x90 pixels.
struct Plate {
  cv::Mat1b moving = cv::Mat1b(90, 120, static_cast<unsigned char>(0));
  cv::Mat1f log_odds = cv::Mat1f(90, 120, -2.0F);
  Links links{cv::Mat1f(90, 120, 1.0F), cv::Mat1f(90, 120, 1.0F)};

  Plate& With(const cv::Rect& area, float evidence) {
    moving(area).setTo(255);
    log_odds(area).setTo(evidence);
    return *this;
  }
  PixelRegions Find(const PixelRegions& previous) const {
    return FindRegions(moving, log_odds, links, previous, {}, {});
  }
};

TEST(FindRegions, ARegionIsBornOfSurePixelsAndLivesOnWithFewer) {
  const RegionOptions options;
  const cv::Rect area(20, 10, 20, 40);
  Plate doubtful;
  doubtful.With(area, 1).With({22, 12, 10, 10}, 5);  // 100 sure pixels: too few for a birth
  EXPECT_TRUE(doubtful.Find({}).regions.empty());
  const PixelRegions born = Plate().With(area, 5).Find({});
  ASSERT_EQ(born.regions.size(), 1U);
  EXPECT_EQ(born.regions[0].box, area);
  EXPECT_EQ(born.regions[0].pixels, area.area());
  const PixelRegions kept = doubtful.Find(born);
  ASSERT_EQ(kept.regions.size(), 1U);
  EXPECT_EQ(kept.regions[0].id, born.regions[0].id);
  EXPECT_TRUE(Plate().With(area, 1).Find(born).regions.empty());
}

TEST(FindRegions, WhatSaysNothingDoesNotOutvoteTheSeamOfOneThatIsKnown) {
  const cv::Rect coat(10, 5, 100, 80), seam(58, 5, 4, 80);
  Plate plain;
  plain.With(coat, 0).With(seam, 6);  // 0.24 in the mean of all its pixels
  EXPECT_TRUE(plain.Find({}).regions.empty());
  const PixelRegions known = Plate().With(coat, 5).Find({});
  const PixelRegions kept = plain.Find(known);
  ASSERT_EQ(kept.regions.size(), 1U);
  EXPECT_EQ(kept.regions[0].id, known.regions[0].id);
  EXPECT_EQ(kept.regions[0].box, coat);
  // Against it speaks what says that it stands.
  Plate standing;
  standing.With(coat, -1).With(seam, 6);
  EXPECT_TRUE(standing.Find(known).regions.empty());
}

TEST(FindRegions, IdsFollowTheirRegionsAndAreNotReused) {
  const PixelRegions first = Plate().With({20, 10, 20, 40}, 5).Find({});
  const PixelRegions second =
      Plate().With({24, 10, 20, 40}, 5).With({80, 30, 16, 16}, 6).Find(first);
  ASSERT_EQ(second.regions.size(), 2U);
  EXPECT_EQ(second.regions[0].id, first.regions[0].id);
  EXPECT_NE(second.regions[1].id, first.regions[0].id);
  const PixelRegions third = Plate().With({2, 60, 20, 20}, 6).Find(second);
  ASSERT_EQ(third.regions.size(), 1U);
  EXPECT_EQ(third.regions[0].id, 2);
}

TEST(FindRegions, TwoWhoMeetStayTwoAndOneWhoPartsKeepsHisNameOnce) {
  Plate meeting;
  meeting.With({20, 10, 40, 40}, 5).links.right.col(39).setTo(0.1F);  // a step between them
  const PixelRegions two = meeting.Find({});
  ASSERT_EQ(two.regions.size(), 2U);
  const PixelRegions one = Plate().With({20, 10, 40, 40}, 5).Find(two);
  ASSERT_EQ(one.regions.size(), 1U);
  const PixelRegions parted = meeting.Find(one);
  ASSERT_EQ(parted.regions.size(), 2U);
  EXPECT_NE(parted.regions[0].id, parted.regions[1].id);
}

TEST(FindRegions, SmallOnesAreNoise) {
  EXPECT_TRUE(Plate().With({20, 10, 14, 14}, 6).Find({}).regions.empty());
  EXPECT_FALSE(Plate().With({20, 10, 15, 14}, 6).Find({}).regions.empty());
}

}  // namespace
}  // namespace aisle::slam::dynamic
