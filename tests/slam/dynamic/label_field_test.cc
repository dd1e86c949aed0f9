#include "slam/dynamic/label_field.h"

#include <gtest/gtest.h>

#include "slam/dynamic/disparity.h"
#include "slam/dynamic/moving_regions.h"

namespace aisle::slam::dynamic {
namespace {

/// A far wall with a near square in the middle, 40x40 nodes.
struct Square {
  cv::Mat1f disparity = cv::Mat1f(40, 40, 3.0F);
  cv::Mat1b half_image = cv::Mat1b(80, 80, 100);
  cv::Rect area{12, 10, 14, 18};
  Square() { disparity(area).setTo(12.0F); }
};

TEST(SolveField, WithoutLinksIsTheEvidence) {
  cv::Mat1f evidence(10, 10, -0.5F);
  evidence(4, 4) = 3;
  FieldOptions options;
  options.coupling = 0;
  const Square square;
  const NodeLinks links = LinkNodes(cv::Mat1f(10, 10, 5.0F), cv::Mat1b(20, 20, 90), options);
  EXPECT_EQ(cv::norm(SolveField(evidence, links, options), evidence, cv::NORM_INF), 0);
}

TEST(SolveField, SparseEvidenceFillsItsSurfaceAndStopsAtTheStep) {
  const Square square;
  cv::Mat1f evidence(40, 40, -0.25F);
  for (int y = 0; y < 40; y += 2) {
    for (int x = 0; x < 40; x += 2) {
      evidence(y, x) = square.area.contains({x, y}) ? 4.0F : -4.0F;
    }
  }
  const FieldOptions options;
  const cv::Mat1f log_odds =
      SolveField(evidence, LinkNodes(square.disparity, square.half_image, options), options);
  int wrong = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      wrong += (log_odds(y, x) > 0) != square.area.contains({x, y});
    }
  }
  EXPECT_LT(wrong, 40 * 40 / 20);
}

TEST(SolveField, ALoneWrongNodeIsOutvoted) {
  cv::Mat1f evidence(20, 20, -1.0F);
  evidence(10, 10) = 1.5F;
  const FieldOptions options;
  const NodeLinks links = LinkNodes(cv::Mat1f(20, 20, 5.0F), cv::Mat1b(40, 40, 90), options);
  EXPECT_LT(SolveField(evidence, links, options)(10, 10), 0);
}

TEST(NodeDisparity, HolesTakeTheFartherSide) {
  cv::Mat1f half(4, 12, 9.0F);
  half.colRange(6, 12).setTo(4.0F);
  half.colRange(4, 8).setTo(kNoDisparity);
  const cv::Mat1f nodes = NodeDisparity(half);
  EXPECT_EQ(nodes(0, 1), 9);
  EXPECT_EQ(nodes(0, 2), 4);
  EXPECT_EQ(nodes(0, 3), 4);
}

/// Moving points wherever the tests put a region: enough of them for one to be born.
std::vector<PointVote> Votes() {
  std::vector<PointVote> votes;
  for (int k = 0; k < RegionOptions{}.birth_points; ++k) {
    votes.push_back({{24, 20 + k}, 3});
    votes.push_back({{62 + k, 32}, 3});
    votes.push_back({{5, 42 + k}, 3});
  }
  return votes;
}
const std::vector<PointVote> kVotes = Votes();

cv::Mat1f Blob(const cv::Rect& area, float best) {
  cv::Mat1f log_odds(60, 90, -2.0F);
  log_odds(area).setTo(1.0F);
  log_odds(area.y + 1, area.x + 1) = best;
  return log_odds;
}

TEST(FindRegions, ARegionIsBornOnlyOfStrongEvidenceButLivesOnWithLess) {
  int next_id = 0;
  const cv::Rect area(20, 10, 10, 20);
  const RegionOptions options;
  const float weak = static_cast<float>(options.birth_log_odds) - 1.0F;
  EXPECT_TRUE(FindRegions(Blob(area, weak), kVotes, {}, next_id, options).regions.empty());
  const NodeRegions born = FindRegions(Blob(area, 5), kVotes, {}, next_id, options);
  ASSERT_EQ(born.regions.size(), 1U);
  EXPECT_EQ(born.regions[0].box, area);
  const NodeRegions kept = FindRegions(Blob(area, weak), kVotes, born, next_id, options);
  ASSERT_EQ(kept.regions.size(), 1U);
  EXPECT_EQ(kept.regions[0].id, born.regions[0].id);
}

TEST(FindRegions, IdsFollowTheirRegionsAndAreNotReused) {
  int next_id = 0;
  const RegionOptions options;
  const NodeRegions first = FindRegions(Blob({20, 10, 10, 20}, 5), kVotes, {}, next_id, options);
  cv::Mat1f two = Blob({22, 10, 10, 20}, 5);
  two(cv::Rect(60, 30, 10, 10)).setTo(6.0F);
  const NodeRegions second = FindRegions(two, kVotes, first, next_id, options);
  ASSERT_EQ(second.regions.size(), 2U);
  EXPECT_EQ(second.regions[0].id, first.regions[0].id);
  EXPECT_NE(second.regions[1].id, first.regions[0].id);
  const NodeRegions third = FindRegions(Blob({2, 40, 10, 10}, 6), kVotes, second, next_id, options);
  ASSERT_EQ(third.regions.size(), 1U);
  EXPECT_EQ(third.regions[0].id, 2);
}

TEST(FindRegions, PointsThatStandStillContradict) {
  int next_id = 0;
  std::vector<PointVote> votes = kVotes;
  for (int k = 0; k < 4; ++k) votes.push_back({{22 + k, 15}, -2});
  const cv::Mat1f blob = Blob({20, 10, 10, 20}, 6);
  EXPECT_TRUE(FindRegions(blob, votes, {}, next_id, {}).regions.empty());
  EXPECT_TRUE(FindRegions(blob, {}, {}, next_id, {}).regions.empty());
}

TEST(FindRegions, PointsOfOneBodyGoTogetherAndErrorsGoAnywhere) {
  int next_id = 0;
  const cv::Mat1f blob = Blob({20, 10, 10, 20}, 6);
  std::vector<PointVote> together, apart;
  for (int k = 0; k < 8; ++k) {
    const double swing = 0.01 * (k % 3 - 1), angle = 2.4 * k;
    together.push_back({{22, 12 + k}, 3, {0.05 + swing, 0, swing}});
    apart.push_back({{22, 12 + k}, 3, {0.05 * std::cos(angle), 0, 0.05 * std::sin(angle)}});
  }
  EXPECT_EQ(FindRegions(blob, together, {}, next_id, {}).regions.size(), 1U);
  EXPECT_TRUE(FindRegions(blob, apart, {}, next_id, {}).regions.empty());
}

TEST(FindRegions, SmallOnesAreNoise) {
  int next_id = 0;
  EXPECT_TRUE(FindRegions(Blob({20, 10, 4, 4}, 6), kVotes, {}, next_id, {}).regions.empty());
}

}  // namespace
}  // namespace aisle::slam::dynamic
