#include "slam/dynamic/boundary_labels.h"

#include <gtest/gtest.h>

#include "slam/dynamic/counter_random.h"
#include "slam/dynamic/mark_regions.h"

namespace aisle::slam::dynamic {
namespace {

DisparityPlane Plane(double a, double b, double c) {
  DisparityPlane plane;
  plane.a = a;
  plane.b = b;
  plane.c = c;
  plane.valid = true;
  return plane;
}

/// Two superpixels side by side: columns [0, 10) and [10, 20) of 12 rows.
cv::Mat1i TwoHalves() {
  cv::Mat1i labels(12, 20, 0);
  labels.colRange(10, 20).setTo(1);
  return labels;
}

BoundaryType TypeOf(const DisparityPlane& left, const DisparityPlane& right) {
  return LabelBoundaries(TwoHalves(), {left, right}, {}).at({0, 1});
}

TEST(LabelBoundaries, OneSurfaceIsCoplanar) {
  EXPECT_EQ(TypeOf(Plane(0.1, -0.2, 20), Plane(0.1, -0.2, 20)), BoundaryType::kCoplanar);
  EXPECT_EQ(TypeOf(Plane(0, 0, 20), Plane(0, 0, 21)), BoundaryType::kCoplanar);
}

TEST(LabelBoundaries, SurfacesThatMeetAreAHinge) {
  // Equal at x = 9.5, fifteen pixels apart at the far sides.
  EXPECT_EQ(TypeOf(Plane(0, 0, 20), Plane(1.5, 0, 20 - 1.5 * 9.5)), BoundaryType::kHinge);
}

TEST(LabelBoundaries, TheNearerSurfaceOccludes) {
  EXPECT_EQ(TypeOf(Plane(0, 0, 40), Plane(0, 0, 10)), BoundaryType::kLeftOcclusion);
  EXPECT_EQ(TypeOf(Plane(0, 0, 10), Plane(0, 0, 40)), BoundaryType::kRightOcclusion);
}

TEST(LabelBoundaries, WithoutAPlaneNothingIsClaimed) {
  EXPECT_EQ(TypeOf(Plane(0, 0, 40), DisparityPlane{}), BoundaryType::kUnknown);
}

TEST(EnergyOf, EqualsItsDefinitionPixelByPixel) {
  CounterRandom random(4, 4);
  const auto uniform = [&] { return random.Below(2001) / 1000.0 - 1; };
  for (int trial = 0; trial < 50; ++trial) {
    const DisparityPlane i = Plane(uniform(), uniform(), 20 * uniform());
    const DisparityPlane j = Plane(uniform(), uniform(), 20 * uniform());
    PixelMoments boundary, both;
    double boundary_gap = 0, boundary_squares = 0, both_squares = 0;
    for (int y = 0; y < 7; ++y) {
      for (int x = 0; x < 9; ++x) {
        const double gap = i.At(x, y) - j.At(x, y);
        both.Add(x, y);
        both_squares += gap * gap;
        if (x != 4 && x != 5) continue;
        boundary.Add(x, y);
        boundary_gap += gap;
        boundary_squares += gap * gap;
      }
    }
    const BoundaryOptions options;
    const BoundaryEnergy energy = EnergyOf(i, j, boundary, both, options);
    EXPECT_NEAR(energy.coplanar, both_squares / 63, 1e-8);
    EXPECT_NEAR(energy.hinge, boundary_squares / 14 + options.lambda_hinge, 1e-8);
    const double price = options.lambda_occlusion, penalty = options.lambda_penalty;
    EXPECT_EQ(energy.left_occlusion, price + (boundary_gap < 0 ? penalty : 0));
    EXPECT_EQ(energy.right_occlusion, price + (boundary_gap > 0 ? penalty : 0));
  }
}

TEST(FitDisparityPlane, RecoversThePlaneAmongOutliers) {
  CounterRandom random(8, 8);
  std::vector<DisparitySample> samples;
  for (int k = 0; k < 150; ++k) {
    const double x = random.Below(14), y = random.Below(14);
    const bool outlier = k % 3 == 0;
    samples.push_back({x, y, outlier ? random.Below(90) : 0.3 * x - 0.1 * y + 25});
  }
  const DisparityPlane plane = FitDisparityPlane(samples, 0, {});
  ASSERT_TRUE(plane.valid);
  EXPECT_NEAR(plane.a, 0.3, 0.03);
  EXPECT_NEAR(plane.b, -0.1, 0.03);
  EXPECT_NEAR(plane.c, 25, 0.3);
  EXPECT_GE(plane.inliers, 100);
}

TEST(FitDisparityPlane, FewOrAlignedSamplesMakeNoPlane) {
  std::vector<DisparitySample> line;
  for (int k = 0; k < 40; ++k) line.push_back({double(k), 2.0 * k, 10});
  EXPECT_FALSE(FitDisparityPlane(line, 0, {}).valid);
  EXPECT_FALSE(FitDisparityPlane({{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 0, {}).valid);
}

/// A square of superpixels around a middle one: the middle stands before the rest.
struct Cross {
  cv::Mat1i labels = cv::Mat1i(30, 30, 0);
  std::map<BoundaryKey, BoundaryType> boundaries;
  Cross() {
    labels(cv::Rect(10, 12, 9, 8)).setTo(1);
    boundaries[{0, 1}] = BoundaryType::kRightOcclusion;
  }
};

TEST(SearchOcclusions, StopsAtTheFirstOcclusionInEachDirection) {
  const Cross cross;
  const auto found = SearchOcclusions({14, 15}, cross.labels, cross.boundaries);
  EXPECT_EQ(found, (std::vector<cv::Point>{{18, 15}, {10, 15}, {14, 19}, {14, 12}}));
}

TEST(SearchOcclusions, PassesOtherBoundariesAndFindsNothingAtTheEdge) {
  Cross cross;
  cross.boundaries[{0, 1}] = BoundaryType::kHinge;
  EXPECT_TRUE(SearchOcclusions({14, 15}, cross.labels, cross.boundaries).empty());
  EXPECT_TRUE(SearchOcclusions({140, 15}, cross.labels, cross.boundaries).empty());
}

TEST(MarkRegion, IsTheSmallestRectangleOfTheOutline) {
  const Cross cross;
  EXPECT_EQ(MarkRegion({{14, 15}, {12, 13}}, cross.labels, cross.boundaries, {}),
            cv::Rect(10, 12, 9, 8));
  EXPECT_FALSE(MarkRegion({{2, 2}}, cross.labels, cross.boundaries, {}));
}

}  // namespace
}  // namespace aisle::slam::dynamic
