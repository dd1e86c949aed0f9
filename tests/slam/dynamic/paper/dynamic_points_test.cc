#include "slam/dynamic/paper/dynamic_points.h"

#include <gtest/gtest.h>

#include "slam/dynamic/common/counter_random.h"
#include "slam/dynamic/paper/disparity.h"

namespace aisle::slam::dynamic {
namespace {

TestedPoint Point(float x, float y, float disparity, bool moves = true) {
  return {{x, y}, disparity, moves ? 5.0 : 0.0, 1.0};
}

/// Groups by flooding, straight from the paper's sentence.
std::vector<std::set<std::size_t>> FloodedGroups(const std::vector<TestedPoint>& points,
                                                 const GroupOptions& options) {
  std::vector<std::set<std::size_t>> groups;
  std::set<std::size_t> seen;
  for (std::size_t start = 0; start < points.size(); ++start) {
    if (!points[start].IsDynamic() || seen.contains(start)) continue;
    std::set<std::size_t> group = {start};
    for (std::size_t grown = 0; grown != group.size();) {
      grown = group.size();
      for (std::size_t j = 0; j < points.size(); ++j) {
        for (const std::size_t i : std::set<std::size_t>(group)) {
          const float d = std::max(points[i].disparity, points[j].disparity);
          if (points[j].IsDynamic() &&
              cv::norm(points[i].position - points[j].position) <=
                  options.alpha_px + options.beta * d &&
              std::abs(points[i].disparity - points[j].disparity) <= options.disparity_px) {
            group.insert(j);
          }
        }
      }
    }
    seen.insert(group.begin(), group.end());
    if (static_cast<int>(group.size()) >= options.min_points) groups.push_back(group);
  }
  return groups;
}

TEST(GroupDynamicPoints, EqualsFlooding) {
  CounterRandom random(9, 1);
  std::vector<TestedPoint> points;
  for (int k = 0; k < 150; ++k) {
    points.push_back(Point(static_cast<float>(random.Below(752)),
                           static_cast<float>(random.Below(480)),
                           static_cast<float>(random.Below(20)), random.Below(4) > 0));
  }
  GroupOptions options;
  options.min_points = 3;
  const auto expected = FloodedGroups(points, options);
  const auto groups = GroupDynamicPoints(points, {752, 480}, options);
  ASSERT_EQ(groups.size(), expected.size());
  for (std::size_t k = 0; k < groups.size(); ++k) {
    ASSERT_EQ(groups[k].points.size(), expected[k].size());
    std::size_t n = 0;
    for (const std::size_t i : expected[k]) {
      EXPECT_EQ(groups[k].points[n++].position, points[i].position);
    }
  }
}

TEST(GroupDynamicPoints, FourPointsAreNoiseAndFiveAreAnObject) {
  std::vector<TestedPoint> points;
  for (int k = 0; k < 4; ++k)
    points.push_back(Point(100.0F + 5.0F * static_cast<float>(k), 100, 9));
  EXPECT_TRUE(GroupDynamicPoints(points, {752, 480}, {}).empty());
  points.push_back(Point(120, 110, 9, false));
  EXPECT_TRUE(GroupDynamicPoints(points, {752, 480}, {}).empty());
  points.push_back(Point(120, 112, 9));
  EXPECT_EQ(GroupDynamicPoints(points, {752, 480}, {}).size(), 1U);
}

TEST(GroupDynamicPoints, TwoDisparitiesAtOnePlaceAreTwoObjects) {
  std::vector<TestedPoint> points;
  for (int k = 0; k < 12; ++k) {
    points.push_back(Point(200.0F + static_cast<float>(k), 200, k % 2 == 0 ? 5.0F : 30.0F));
  }
  EXPECT_EQ(GroupDynamicPoints(points, {752, 480}, {}).size(), 2U);
}

TEST(GroupDynamicPoints, RegionsEncloseTheirPointsAndStayInTheImage) {
  std::vector<TestedPoint> points;
  for (int k = 0; k < 6; ++k) points.push_back(Point(2.4F, 470.0F + static_cast<float>(k), 40));
  const auto groups = GroupDynamicPoints(points, {752, 480}, {});
  ASSERT_EQ(groups.size(), 1U);
  const cv::Rect roi = groups[0].roi;
  EXPECT_EQ(roi & cv::Rect(0, 0, 752, 480), roi);
  for (const auto& p : points) EXPECT_TRUE(roi.contains(cv::Point(p.position)));
}

TEST(TestAgainstEpipolarLines, TheThresholdGrowsWithDisparity) {
  // With F of a pure sideways motion the epipolar line is the row: the distance is |dy|.
  FundamentalEstimate estimate;
  estimate.F(1, 2) = -1;
  estimate.F(2, 1) = 1;
  cv::Mat1f disparity(100, 100, 10.0F);
  disparity.colRange(50, 100).setTo(60.0F);
  disparity.rowRange(60, 100).setTo(kNoDisparity);
  const EpipolarOptions options{.alpha_px = 1, .beta = 0.1};
  const std::vector<Track> tracks = {
      {{20, 20}, {25, 24}}, {{70, 20}, {75, 24}}, {{9, 80}, {9, 90}}};
  const auto tested = TestAgainstEpipolarLines(tracks, estimate, disparity, options);
  ASSERT_EQ(tested.size(), 2U) << "a point of unknown disparity has no threshold";
  EXPECT_NEAR(tested[0].epipolar_px, 4, 1e-9);
  EXPECT_NEAR(tested[0].threshold_px, 2, 1e-6);
  EXPECT_TRUE(tested[0].IsDynamic());
  EXPECT_NEAR(tested[1].threshold_px, 7, 1e-6);
  EXPECT_FALSE(tested[1].IsDynamic());
}

}  // namespace
}  // namespace aisle::slam::dynamic
