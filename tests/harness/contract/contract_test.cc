#include <gtest/gtest.h>

#include <random>

#include "harness/contract/floor.h"
#include "harness/contract/run.h"
#include "harness/contract/system_spec.h"

namespace aisle {
namespace {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double In(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  FloorPose Pose() { return {{In(-9, 9), In(-9, 9)}, In(-8, 8)}; }
  int Below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }

 private:
  std::mt19937 engine_;
};

void ExpectNear(const FloorPose& a, const FloorPose& b) {
  EXPECT_LT((a.position - b.position).norm(), 1e-9);
  EXPECT_NEAR(WrapAngle(a.heading_rad - b.heading_rad), 0, 1e-9);
}

TEST(FloorPose, IsAGroupThatMovesPoints) {
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const FloorPose a = random.Pose(), b = random.Pose(), c = random.Pose();
    const Eigen::Vector2d p(random.In(-5, 5), random.In(-5, 5));
    ExpectNear((a * b) * c, a * (b * c));
    ExpectNear(a * a.inverse(), {});
    ExpectNear(a.inverse() * a, {});
    ExpectNear(a * FloorPose{}, a);
    EXPECT_LT(((a * b) * p - a * (b * p)).norm(), 1e-9);
    EXPECT_LT((a.inverse() * (a * p) - p).norm(), 1e-9);
    // Eigen's rotation says the same.
    const Eigen::Vector2d moved = a.position + Eigen::Rotation2Dd(a.heading_rad) * p;
    EXPECT_LT((a * p - moved).norm(), 1e-9);
    EXPECT_NEAR(a.ahead().dot(a.left()), 0, 1e-12);
    EXPECT_NEAR(a.ahead().x() * a.left().y() - a.ahead().y() * a.left().x(), 1, 1e-12)
        << "left is counter-clockwise of ahead";
  }
}

TEST(WrapAngle, LiesInTheHalfOpenTurnAndIsTheSameDirection) {
  constexpr double kPi = std::numbers::pi;
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const double angle = random.In(-60, 60), wrapped = WrapAngle(angle);
    EXPECT_GT(wrapped, -kPi - 1e-12);
    EXPECT_LE(wrapped, kPi + 1e-12);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), 1e-9);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), 1e-9);
    EXPECT_NEAR(WrapAngle(wrapped), wrapped, 1e-12);
  }
  EXPECT_EQ(WrapAngle(kPi), kPi) << "pi itself is in, -pi is not";
  EXPECT_EQ(WrapAngle(-kPi), kPi);
}

MaskFacts Facts(Random* random) {
  MaskFacts facts;
  facts.true_positives = random->Below(1000);
  facts.false_positives = random->Below(1000);
  facts.false_negatives = random->Below(1000);
  facts.objects_found = random->Below(9);
  facts.objects_invented = random->Below(9);
  facts.objects_missed = random->Below(9);
  facts.parts_of_movers = random->Below(5);
  facts.large_regions = random->Below(5);
  facts.large_regions_astray = random->Below(5);
  facts.iou_sum = random->Below(64) / 64.0;
  facts.static_corners = random->Below(900);
  facts.static_corners_lost = random->Below(90);
  facts.corners_rejected = random->Below(90);
  facts.outline_truth = random->Below(500);
  facts.outline_truth_met = random->Below(500);
  facts.outline_rejected = random->Below(500);
  facts.outline_rejected_met = random->Below(500);
  if (random->Below(2)) {
    facts.objects.push_back({.instance = random->Below(9), .object_class = "person"});
  }
  return facts;
}

/// Counts of frames may be gathered in any grouping; every one of them is gathered.
TEST(MaskFacts, SumsAreThoseOfEveryCount) {
  Random random(3);
  const auto sum = [](MaskFacts a, const MaskFacts& b) { return a += b; };
  for (int i = 0; i < 200; ++i) {
    const MaskFacts a = Facts(&random), b = Facts(&random), c = Facts(&random);
    EXPECT_EQ(sum(sum(a, b), c), sum(a, sum(b, c)));
    EXPECT_EQ(sum(a, MaskFacts{}), a);
    EXPECT_EQ(sum(MaskFacts{}, a), a);
    // Twice the same is twice every count: a count that were left out would stay once.
    const MaskFacts twice = sum(a, a);
    EXPECT_EQ(twice.true_positives, 2 * a.true_positives);
    EXPECT_EQ(twice.false_positives, 2 * a.false_positives);
    EXPECT_EQ(twice.false_negatives, 2 * a.false_negatives);
    EXPECT_EQ(twice.objects_found, 2 * a.objects_found);
    EXPECT_EQ(twice.objects_invented, 2 * a.objects_invented);
    EXPECT_EQ(twice.objects_missed, 2 * a.objects_missed);
    EXPECT_EQ(twice.parts_of_movers, 2 * a.parts_of_movers);
    EXPECT_EQ(twice.large_regions, 2 * a.large_regions);
    EXPECT_EQ(twice.large_regions_astray, 2 * a.large_regions_astray);
    EXPECT_EQ(twice.iou_sum, 2 * a.iou_sum);
    EXPECT_EQ(twice.static_corners, 2 * a.static_corners);
    EXPECT_EQ(twice.static_corners_lost, 2 * a.static_corners_lost);
    EXPECT_EQ(twice.corners_rejected, 2 * a.corners_rejected);
    EXPECT_EQ(twice.outline_truth, 2 * a.outline_truth);
    EXPECT_EQ(twice.outline_truth_met, 2 * a.outline_truth_met);
    EXPECT_EQ(twice.outline_rejected, 2 * a.outline_rejected);
    EXPECT_EQ(twice.outline_rejected_met, 2 * a.outline_rejected_met);
    EXPECT_EQ(twice.objects.size(), 2 * a.objects.size());
  }
}

TEST(MaskErrors, HoldTheirBoundsAndNothingBeyond) {
  EXPECT_EQ(MaskErrors{}.Validate(), "");
  for (const double bad : {-0.1, 100.1, std::nan("")}) {
    MaskErrors errors;
    errors.boundary_px = bad;
    EXPECT_NE(errors.Validate().find("boundary_px"), std::string::npos) << bad;
  }
  for (const double bad : {-0.1, 1.1, std::nan("")}) {
    MaskErrors errors;
    errors.miss_share = bad;
    EXPECT_NE(errors.Validate().find("miss_share"), std::string::npos) << bad;
  }
  for (const int bad : {-1, 101}) {
    MaskErrors errors;
    errors.latency_frames = bad;
    EXPECT_NE(errors.Validate().find("latency_frames"), std::string::npos) << bad;
  }
  const MaskErrors most{
      .boundary_px = 100, .miss_below_px = 1 << 30, .miss_share = 1, .latency_frames = 100};
  EXPECT_EQ(most.Validate(), "");
}

TEST(RunStatus, ALostRunCameToItsEndAndACrashedOneDidNot) {
  EXPECT_TRUE(IsComplete(RunStatus::kOk));
  EXPECT_TRUE(IsComplete(RunStatus::kLost));
  for (const RunStatus failed : {RunStatus::kCrashed, RunStatus::kTimeout, RunStatus::kInvalid}) {
    EXPECT_FALSE(IsComplete(failed));
  }
}

}  // namespace
}  // namespace aisle
