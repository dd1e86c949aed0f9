#include "slam/dynamic/robust/join_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/slam/dynamic/robust/usual_tolerance.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kWidth = 120, kHeight = 80;

/// A picture into which regions are put, each a rectangle at one disparity; the later ones in
/// front.
struct Picture {
  PixelRegions regions{cv::Mat1i(kHeight, kWidth, 0), {}};
  cv::Mat1f disparity = cv::Mat1f(kHeight, kWidth, 2.0F);

  void Put(int id, const cv::Rect& box, float at, double log_odds = 1) {
    regions.regions.push_back({id, box, box.area(), log_odds});
    regions.labels(box) = static_cast<int>(regions.regions.size());
    disparity(box) = at;
  }
  std::vector<PixelRegion> Joined() const {
    return JoinRegions(regions, disparity, test::kUsualTolerance, {});
  }
};

TEST(JoinRegions, NoneAreNone) { EXPECT_TRUE(Picture().Joined().empty()); }

TEST(JoinRegions, WhatLiesInTheBoxOfALargerOneAtItsDistanceIsPartOfIt) {
  Picture truck;
  truck.Put(7, {10, 20, 40, 30}, 8, 4);
  truck.Put(5, {30, 10, 20, 20}, 8.3F, 1);  // its cab, half above it, seen earlier
  const auto whole = truck.Joined();
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_EQ(whole[0].box, cv::Rect(10, 10, 40, 40));
  EXPECT_EQ(whole[0].id, 5);
  EXPECT_EQ(whole[0].pixels, 1200 + 400);
  EXPECT_NEAR(whole[0].log_odds, (4.0 * 1200 + 1.0 * 400) / 1600, 1e-12);
}

TEST(JoinRegions, WhoStandsBeforeItIsNot) {
  Picture picture;
  picture.Put(1, {10, 20, 60, 40}, 8);
  picture.Put(2, {30, 25, 10, 30}, 12);
  EXPECT_EQ(picture.Joined().size(), 2U);
}

TEST(JoinRegions, NeighboursWhoseBoxesMeetStayTwo) {
  Picture picture;
  picture.Put(1, {10, 20, 20, 40}, 8);
  picture.Put(2, {28, 22, 20, 36}, 8);  // a tenth of it
  EXPECT_EQ(picture.Joined().size(), 2U);
}

TEST(JoinRegions, AtAnUnknownDistanceNothingIsJoined) {
  Picture picture;
  picture.Put(1, {10, 20, 60, 40}, 8);
  picture.Put(2, {30, 25, 10, 30}, -1);
  EXPECT_EQ(picture.Joined().size(), 2U);
}

TEST(JoinRegions, PixelsAndBoxesAreKeptAndIdsAreThoseOfTheOldest) {
  std::mt19937 random(3);
  const auto below = [&](int limit) {
    return static_cast<int>(random() % static_cast<unsigned>(limit));
  };
  int joined = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Picture picture;
    std::vector<cv::Rect> boxes;
    for (int k = 0; k < 6; ++k) {
      boxes.emplace_back(below(80), below(50), 10 + below(30), 10 + below(20));
    }
    std::ranges::sort(boxes, std::greater(), [](const cv::Rect& box) { return box.area(); });
    for (int k = 0; k < 6; ++k) {  // the largest is neither the oldest nor the newest
      picture.Put(10 * ((k + 3) % 6) + 1, boxes[static_cast<std::size_t>(k)],
                  5 + static_cast<float>(below(3)));
    }
    const auto whole = picture.Joined();
    joined += 6 - static_cast<int>(whole.size());
    int pixels = 0, parts_pixels = 0;
    for (const PixelRegion& one : whole) pixels += one.pixels;
    for (const PixelRegion& part : picture.regions.regions) {
      parts_pixels += part.pixels;
      EXPECT_TRUE(std::ranges::any_of(whole, [&](const PixelRegion& one) {
        return (one.box & part.box) == part.box && one.id <= part.id;
      }));
    }
    EXPECT_EQ(pixels, parts_pixels);
    std::set<int> ids;
    for (const PixelRegion& one : whole) ids.insert(one.id);
    EXPECT_EQ(ids.size(), whole.size());
  }
  EXPECT_GT(joined, 100);  // the law is not an empty one
}

}  // namespace
}  // namespace aisle::slam::dynamic
