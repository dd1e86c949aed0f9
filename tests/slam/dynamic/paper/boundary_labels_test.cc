#include "slam/dynamic/paper/boundary_labels.h"

#include <gtest/gtest.h>

#include "slam/dynamic/common/counter_random.h"
#include "slam/dynamic/paper/mark_regions.h"

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

/// Five superpixels in a random map of 6x6 blocks, some without a plane.
struct RandomMap {
  cv::Mat1i labels = cv::Mat1i(30, 36);
  std::vector<DisparityPlane> planes;
  explicit RandomMap(CounterRandom& random) {
    const auto uniform = [&] { return random.Below(2001) / 1000.0 - 1; };
    for (int y = 0; y < labels.rows; y += 6) {
      for (int x = 0; x < labels.cols; x += 6) labels(cv::Rect(x, y, 6, 6)) = random.Below(5);
    }
    for (int k = 0; k < 5; ++k) {
      planes.push_back(Plane(0.3 * uniform(), 0.3 * uniform(), 20 + 6 * uniform()));
      planes.back().valid = random.Below(8) > 0;
    }
  }
};

/// Equations (9) to (11) as they are written, sums over sets of pixels.
BoundaryType LeastByDefinition(const RandomMap& map, int i, int j, const BoundaryOptions& options) {
  const DisparityPlane &a = map.planes[static_cast<std::size_t>(i)],
                       &b = map.planes[static_cast<std::size_t>(j)];
  if (!a.valid || !b.valid) return BoundaryType::kUnknown;
  double front = 0, on_boundary = 0, boundary = 0, on_both = 0, both = 0;
  for (int y = 0; y < map.labels.rows; ++y) {
    for (int x = 0; x < map.labels.cols; ++x) {
      const int here = map.labels(y, x), other = here == i ? j : i;
      if (here != i && here != j) continue;
      const double gap = a.At(x, y) - b.At(x, y);
      on_both += gap * gap, both += 1;
      bool touches = false;
      for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        const cv::Point p(x + dx, y + dy);
        touches |= cv::Rect({}, map.labels.size()).contains(p) && map.labels(p) == other;
      }
      if (!touches) continue;
      front += gap, on_boundary += gap * gap, boundary += 1;
    }
  }
  const std::vector<std::pair<double, BoundaryType>> energies = {
      {on_both / both, BoundaryType::kCoplanar},
      {on_boundary / boundary + options.lambda_hinge, BoundaryType::kHinge},
      {(front < 0 ? options.lambda_penalty : 0) + options.lambda_occlusion,
       BoundaryType::kLeftOcclusion},
      {(-front < 0 ? options.lambda_penalty : 0) + options.lambda_occlusion,
       BoundaryType::kRightOcclusion}};
  return std::min_element(energies.begin(), energies.end())->second;
}

TEST(LabelBoundaries, AreTheLeastOfTheEnergiesSummedPixelByPixel) {
  CounterRandom random(6, 1);
  std::map<BoundaryType, int> seen;
  for (int trial = 0; trial < 60; ++trial) {
    const RandomMap map(random);
    for (const auto& [key, type] : LabelBoundaries(map.labels, map.planes, {})) {
      EXPECT_EQ(type, LeastByDefinition(map, key.first, key.second, {}))
          << "trial " << trial << ", " << key.first << " and " << key.second;
      ++seen[type];
    }
  }
  EXPECT_EQ(seen.size(), 5U) << "every type has been asked for";
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

TEST(SearchOcclusions, AreTheNearestOfAllOcclusionsOfTheRowAndTheColumn) {
  CounterRandom random(11, 2);
  for (int trial = 0; trial < 40; ++trial) {
    const RandomMap map(random);
    const auto boundaries = LabelBoundaries(map.labels, map.planes, {});
    const auto occluded = [&](cv::Point p, cv::Point q) {
      return map.labels(p) != map.labels(q) &&
             IsOcclusion(boundaries, map.labels(p), map.labels(q));
    };
    const cv::Point from(random.Below(map.labels.cols), random.Below(map.labels.rows));
    // The last pixel before each occlusion, seen from the point: the nearest is where a ray stops.
    std::vector<int> right, left, down, up;
    for (int x = 0; x + 1 < map.labels.cols; ++x) {
      if (!occluded({x, from.y}, {x + 1, from.y})) continue;
      if (x >= from.x) right.push_back(x);
      if (x + 1 <= from.x) left.push_back(x + 1);
    }
    for (int y = 0; y + 1 < map.labels.rows; ++y) {
      if (!occluded({from.x, y}, {from.x, y + 1})) continue;
      if (y >= from.y) down.push_back(y);
      if (y + 1 <= from.y) up.push_back(y + 1);
    }
    std::vector<cv::Point> expected;
    if (!right.empty()) expected.emplace_back(right.front(), from.y);
    if (!left.empty()) expected.emplace_back(left.back(), from.y);
    if (!down.empty()) expected.emplace_back(from.x, down.front());
    if (!up.empty()) expected.emplace_back(from.x, up.back());
    EXPECT_EQ(SearchOcclusions(from, map.labels, boundaries), expected) << "trial " << trial;
  }
}

TEST(MarkRegion, EnclosesTheRayEndsOfThePointsThatHaveEnoughOfThem) {
  CounterRandom random(12, 3);
  for (int trial = 0; trial < 40; ++trial) {
    const RandomMap map(random);
    const auto boundaries = LabelBoundaries(map.labels, map.planes, {});
    std::vector<cv::Point> points;
    for (int k = 0; k < 6; ++k) points.emplace_back(random.Below(40) - 2, random.Below(34) - 2);
    for (int min_rays = 1; min_rays <= 4; ++min_rays) {
      int left = 1000, right = -1, top = 1000, bottom = -1;
      for (const cv::Point& point : points) {
        const auto ends = SearchOcclusions(point, map.labels, boundaries);
        if (static_cast<int>(ends.size()) < min_rays) continue;
        for (const cv::Point& end : ends) {
          left = std::min(left, end.x), right = std::max(right, end.x);
          top = std::min(top, end.y), bottom = std::max(bottom, end.y);
        }
      }
      const auto box = MarkRegion(points, map.labels, boundaries, {.min_rays = min_rays});
      ASSERT_EQ(box.has_value(), right >= 0);
      if (!box) continue;
      EXPECT_EQ(*box, cv::Rect(cv::Point(left, top), cv::Point(right + 1, bottom + 1)));
    }
  }
}

TEST(MarkRegion, IsTheSmallestRectangleOfTheOutline) {
  const Cross cross;
  EXPECT_EQ(MarkRegion({{14, 15}, {12, 13}}, cross.labels, cross.boundaries, {}),
            cv::Rect(10, 12, 9, 8));
  EXPECT_FALSE(MarkRegion({{2, 2}}, cross.labels, cross.boundaries, {}));
}

}  // namespace
}  // namespace aisle::slam::dynamic
