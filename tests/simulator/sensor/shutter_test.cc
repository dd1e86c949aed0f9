#include "simulator/sensor/shutter.h"

#include <gmock/gmock.h>

#include <numeric>

namespace aisle::sim {
namespace {

const ShutterOptions kBlur{.motion_blur = true, .spacing_px = 1};
const ShutterOptions kRolling{.motion_blur = true, .readout_ms = 16, .spacing_px = 1};

/// Time that a row's light comes from on average, seconds from the stamp.
double MeanTime(const ShutterPlan& plan, int row) {
  double sum = 0;
  for (std::size_t k = 0; k < plan.offsets_s.size(); ++k) {
    sum += plan.weights(row, static_cast<int>(k)) * plan.offsets_s[k];
  }
  return sum;
}

TEST(PlanShutter, AStillImageNeedsOneInstant) {
  EXPECT_THAT(PlanShutter(kBlur, 10, 480, 0.2).offsets_s, testing::ElementsAre(0.0));
}

TEST(PlanShutter, InstantsAreNoFartherApartThanAskedAndTheMiddleOneIsTheStamp) {
  for (const double motion_px : {0.3, 1.0, 3.2, 7.9, 23.0}) {
    const ShutterPlan plan = PlanShutter(kBlur, 10, 480, motion_px);
    const std::size_t count = plan.offsets_s.size();
    EXPECT_EQ(count % 2, 1u);
    EXPECT_EQ(plan.offsets_s[count / 2], 0);
    EXPECT_GE(static_cast<double>(count - 1), motion_px / kBlur.spacing_px);
    EXPECT_DOUBLE_EQ(plan.offsets_s.back(), 0.005);
  }
  EXPECT_EQ(PlanShutter(kBlur, 10, 480, 1000).offsets_s.size(), 25u);
}

TEST(PlanShutter, EveryRowGetsAllItsLightAtItsOwnTime) {
  const ShutterPlan plan = PlanShutter(kRolling, 6, 480, 9);
  for (int row = 0; row < 480; ++row) {
    EXPECT_NEAR(cv::sum(plan.weights.row(row))[0], 1, 1e-5);
    EXPECT_NEAR(MeanTime(plan, row), 0.016 * ((row + 0.5) / 480 - 0.5), 1e-7);
  }
}

TEST(PlanShutter, AGlobalShutterGivesAllRowsTheSame) {
  const ShutterPlan plan = PlanShutter(kBlur, 10, 480, 4);
  for (int row = 1; row < 480; ++row) {
    EXPECT_EQ(cv::norm(plan.weights.row(row), plan.weights.row(0)), 0);
  }
  // Trapezoids: the first and the last instant count half.
  EXPECT_NEAR(plan.weights(0, 0), 0.125, 1e-6);
  EXPECT_NEAR(plan.weights(0, 1), 0.25, 1e-6);
}

TEST(PlanShutter, ARollingShutterWithoutBlurMixesTheTwoInstantsAround) {
  const ShutterOptions options{.readout_ms = 16, .spacing_px = 1};
  const ShutterPlan plan = PlanShutter(options, 8, 480, 4);
  for (int row = 0; row < 480; ++row) {
    EXPECT_LE(cv::countNonZero(plan.weights.row(row)), 2);
    EXPECT_NEAR(MeanTime(plan, row), 0.016 * ((row + 0.5) / 480 - 0.5), 1e-7);
  }
  const cv::Range first = plan.RowsOf(0);
  EXPECT_EQ(first.start, 0);
  EXPECT_LE(first.end, 121);  // instants are a quarter of the readout apart
}

TEST(AddInstant, TheSumIsTheWeightedMeanOfTheBands) {
  const ShutterPlan plan = PlanShutter(kRolling, 6, 480, 9);
  cv::Mat1f sum(480, 752, 0.0f);
  for (int k = 0; k < static_cast<int>(plan.offsets_s.size()); ++k) {
    const cv::Range rows = plan.RowsOf(k);
    AddInstant(plan, k, cv::Mat1f(rows.size(), 752, 0.7f), rows.start, &sum);
  }
  EXPECT_LT(cv::norm(sum, cv::Mat1f(480, 752, 0.7f), cv::NORM_INF), 1e-5);
}

TEST(ShutterOptions, ValidateNamesTheBrokenRule) {
  EXPECT_EQ(ShutterOptions{}.Validate(), "");
  EXPECT_THAT(ShutterOptions{.readout_ms = -1}.Validate(), testing::HasSubstr("readout_ms is -1"));
  EXPECT_THAT(ShutterOptions{.most_instants = 4}.Validate(), testing::HasSubstr("most_instants"));
}

}  // namespace
}  // namespace aisle::sim
