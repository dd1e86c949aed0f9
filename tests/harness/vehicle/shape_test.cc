#include "harness/vehicle/shape.h"

#include <gtest/gtest.h>

#include "harness/vehicle/plant.h"

namespace aisle {
namespace {

const Polygon kSquare = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

Polygon Moved(const Polygon& polygon, double x, double y) { return At({{x, y}, 0}, polygon); }

TEST(ShapeTest, DistancesOfSquaresAreThoseOnPaper) {
  EXPECT_DOUBLE_EQ(Distance(kSquare, Moved(kSquare, 3, 0)), 2);
  EXPECT_DOUBLE_EQ(Distance(kSquare, Moved(kSquare, 4, 5)), 5);
  EXPECT_DOUBLE_EQ(Distance(kSquare, Moved(kSquare, 0.5, 0.5)), 0);
  EXPECT_DOUBLE_EQ(Distance(kSquare, Moved(kSquare, 1, 0)), 0);
  const Polygon inner = {{0.4, 0.4}, {0.6, 0.4}, {0.5, 0.6}};
  EXPECT_DOUBLE_EQ(Distance(kSquare, inner), 0);
  EXPECT_DOUBLE_EQ(Distance(inner, kSquare), 0);
}

TEST(ShapeTest, ACrossWithoutACornerInsideTheOtherTouches) {
  const Polygon wide = {{-1, 0.4}, {2, 0.4}, {2, 0.6}, {-1, 0.6}};
  EXPECT_DOUBLE_EQ(Distance(kSquare, wide), 0);
}

TEST(ShapeTest, ACapsuleIsItsLineLessItsRadius) {
  EXPECT_DOUBLE_EQ(Distance(kSquare, Capsule{{3, -1}, {3, 2}, 0.5}), 1.5);
  EXPECT_DOUBLE_EQ(Distance(kSquare, Capsule{{4, 5}, {4, 5}, 1}), 4);
  EXPECT_DOUBLE_EQ(Distance(kSquare, Capsule{{0.5, 0.5}, {0.5, 0.5}, 0.1}), 0);
  EXPECT_DOUBLE_EQ(Distance(kSquare, Capsule{{-1, 0.5}, {2, 0.5}, 0.1}), 0);
}

TEST(ShapeTest, AnOutlineThatIsNotConvexHasItsNotch) {
  const Polygon forks = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}};
  EXPECT_DOUBLE_EQ(Distance(forks, Capsule{{2, 1.5}, {2, 1.5}, 0.2}), 0.3);
  EXPECT_FALSE(Contains(forks, {2, 1.5}));
  EXPECT_TRUE(Contains(forks, {2, 0.5}));
}

TEST(ShapeTest, DistancesDoNotChangeWithTheFrame) {
  const FloorPose pose{{3, -7}, 1.1};
  const Polygon a = {{0.1, -0.3}, {1.2, 0.2}, {0.3, 0.9}}, b = Moved(kSquare, 2, 1.5);
  EXPECT_NEAR(Distance(At(pose, a), At(pose, b)), Distance(a, b), 1e-12);
}

TEST(ShapeTest, TheFastestCornerMovesAsItsPlacesOverAMomentSay) {
  const Polygon truck = {{-0.3, -0.4}, {1.6, -0.4}, {1.6, 0.4}, {-0.3, 0.4}};
  constexpr double kMoment_s = 1e-5;
  for (const double speed : {-0.7, 0.0, 0.019, 0.021, 1.2}) {
    for (const double rate : {-1.0, 0.0, 0.3}) {
      const Polygon later = At(AlongArc({}, speed * kMoment_s, rate * kMoment_s), truck);
      double fastest = 0;
      for (std::size_t i = 0; i < truck.size(); ++i) {
        fastest = std::max(fastest, (later[i] - truck[i]).norm() / kMoment_s);
      }
      EXPECT_NEAR(FastestCorner(truck, speed, rate), fastest, 1e-4) << speed << " " << rate;
    }
  }
}

}  // namespace
}  // namespace aisle
