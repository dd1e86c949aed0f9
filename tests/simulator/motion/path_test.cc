#include "simulator/motion/path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "simulator/motion/cornering.h"

namespace aisle::sim {
namespace {

using std::numbers::pi;

/// Exp(i theta(s)) summed by the midpoint rule over many steps, Richardson-extrapolated: slow, and
/// nothing like the quadrature that it checks.
Eigen::Vector2d BruteForce(const PathPoint& start, double sharpness, double distance) {
  const auto sum = [&](int steps) {
    std::complex<long double> total = 0;
    const long double h = static_cast<long double>(distance) / steps;
    for (int i = 0; i < steps; ++i) {
      const long double s = (static_cast<long double>(i) + 0.5L) * h;
      total +=
          h * std::polar(1.0L, start.heading_rad + (start.curvature_per_m + sharpness * s / 2) * s);
    }
    return total;
  };
  const std::complex<long double> fine = (4.0L * sum(20000) - sum(10000)) / 3.0L;
  return start.position +
         Eigen::Vector2d(static_cast<double>(fine.real()), static_cast<double>(fine.imag()));
}

TEST(Clothoid, IsTheIntegralOfItsDirection) {
  for (const double sharpness : {1e-6, 0.002, 0.3, 4.1, 60.0, -7.0}) {
    for (const double curvature : {0.0, 0.0033, -0.4, 2.9}) {
      const PathPoint start{{3, -2}, 0.7, curvature};
      // As far as half a turn goes.
      const double far = std::min(std::sqrt(pi / std::abs(sharpness)),
                                  curvature == 0 ? 1e9 : pi / 2 / std::abs(curvature));
      for (const double share : {0.1, 0.5, 1.0}) {
        const double distance = share * std::min(far, 100.0);
        const PathPoint end = AlongClothoid(start, sharpness, distance);
        EXPECT_NEAR((end.position - BruteForce(start, sharpness, distance)).norm(), 0,
                    1e-12 * (1 + distance))
            << sharpness << " " << curvature << " " << distance;
        EXPECT_NEAR(end.curvature_per_m, curvature + sharpness * distance, 1e-12);
      }
    }
  }
}

TEST(Clothoid, EndsWhereFresnelsIntegralsSay) {
  // C(1) and S(1) of Abramowitz & Stegun, table 7.7: cos and sin of pi s^2 / 2.
  const PathPoint end = AlongClothoid({}, pi, 1);
  EXPECT_NEAR(end.position.x(), 0.7798934003768228, 1e-14);
  EXPECT_NEAR(end.position.y(), 0.4382591473903548, 1e-14);
}

TEST(Path, AQuarterCircleHasItsLengthAndItsCentre) {
  const std::vector<Waypoint> corner = {{{0, 0}, 0}, {{3, 0}, 2}, {{3, 5}, 0}};
  const Path path = Path::Through(corner);
  EXPECT_NEAR(path.length_m(), 1 + pi + 3, 1e-12);
  for (double s = 1; s <= 1 + pi; s += 0.1) {
    EXPECT_NEAR((path.At(s).position - Eigen::Vector2d(1, 2)).norm(), 2, 1e-12);
    EXPECT_NEAR(path.At(s).heading_rad, (s - 1) / 2, 1e-12);
  }
  EXPECT_TRUE(path.At(99).position.isApprox(Eigen::Vector2d(3, 5), 1e-12));
}

TEST(Path, ACornerThatDoesNotFitIsRefused) {
  const std::vector<Waypoint> tight = {{{0, 0}, 0}, {{1, 0}, 2}, {{1, 5}, 0}};
  EXPECT_THROW(Path::Through(tight), std::invalid_argument);
  const std::vector<Waypoint> back = {{{0, 0}, 0}, {{1, 0}, 0.1}, {{0, 0}, 0}};
  EXPECT_THROW(Path::Through(back), std::invalid_argument);
}

/// Polylines as people draw them: each with its own radius and steering.
struct Polyline {
  const char* what;
  std::vector<Eigen::Vector2d> points;
  double radius_m;
  double sharpness_per_m2;
};

void PrintTo(const Polyline& line, std::ostream* stream) { *stream << line.what; }

class Polylines : public testing::TestWithParam<Polyline> {
 protected:
  std::vector<Waypoint> Waypoints() const {
    std::vector<Waypoint> waypoints;
    for (const Eigen::Vector2d& point : GetParam().points) {
      waypoints.push_back({point, GetParam().radius_m, GetParam().sharpness_per_m2});
    }
    return waypoints;
  }
};

TEST_P(Polylines, AreRoundedWithContinuousCurvatureWithinTheirLimits) {
  const Path path = Path::Through(Waypoints());
  const double h = 1e-5;
  for (double s = 2 * h; s < path.length_m() - 2 * h; s += path.length_m() / 3001) {
    const PathPoint before = path.At(s - h), now = path.At(s), after = path.At(s + h);
    const Eigen::Vector2d velocity = (after.position - before.position) / (2 * h);
    EXPECT_NEAR(velocity.x(), std::cos(now.heading_rad), 1e-7) << s;
    EXPECT_NEAR(velocity.y(), std::sin(now.heading_rad), 1e-7) << s;
    // One-sided slopes differ by a kink's share of the step.
    const double kink = GetParam().sharpness_per_m2 * h;
    EXPECT_NEAR((after.heading_rad - before.heading_rad) / (2 * h), now.curvature_per_m, kink) << s;
    EXPECT_LE(std::abs(after.curvature_per_m - before.curvature_per_m),
              GetParam().sharpness_per_m2 * 2 * h * (1 + 1e-9) + 1e-12)
        << s;
    EXPECT_LE(std::abs(now.curvature_per_m), (1 + 1e-12) / GetParam().radius_m) << s;
  }
}

TEST_P(Polylines, SegmentsJoinToWithinANanometre) {
  const Path path = Path::Through(Waypoints());
  const auto& segments = path.segments();
  for (std::size_t i = 0; i + 1 < segments.size(); ++i) {
    const PathPoint end =
        AlongClothoid(segments[i].start, segments[i].sharpness_per_m2, segments[i].length_m);
    const PathPoint& next = segments[i + 1].start;
    EXPECT_NEAR((end.position - next.position).norm(), 0, 1e-9) << i;
    EXPECT_NEAR(end.heading_rad, next.heading_rad, 1e-12) << i;
    EXPECT_NEAR(end.curvature_per_m, next.curvature_per_m, 1e-9) << i;
  }
}

TEST_P(Polylines, StraightLegsAreOnTheirSidesAndCornersAreCutInside) {
  const Path path = Path::Through(Waypoints());
  const auto& points = GetParam().points;
  for (const Path::Segment& segment : path.segments()) {
    const auto side = static_cast<std::size_t>(segment.side);
    const Eigen::Vector2d along = (points[side + 1] - points[side]).normalized();
    const Eigen::Vector2d left(-along.y(), along.x());
    if (segment.IsLine()) {
      EXPECT_NEAR((segment.start.position - points[side]).dot(left), 0, 1e-12);
      EXPECT_NEAR(std::cos(segment.start.heading_rad), along.x(), 1e-12);
      continue;
    }
    const Eigen::Vector2d out = (points[side + 2] - points[side + 1]).normalized();
    const double turn = along.x() * out.y() - along.y() * out.x() > 0 ? 1 : -1;
    for (double s = 0; s <= segment.length_m; s += segment.length_m / 20) {
      const PathPoint now = path.At(segment.start_m + s);
      EXPECT_GE(turn * (now.position - points[side]).dot(left), -1e-9) << "outside of the corner";
    }
  }
  EXPECT_TRUE(path.At(1e9).position.isApprox(points.back(), 1e-9));
}

INSTANTIATE_TEST_SUITE_P(
    Drawn, Polylines,
    testing::Values(Polyline{"right angle", {{0, 0}, {5, 0}, {5, 5}}, 0.6, 5.7},
                    Polyline{"too short for an arc", {{0, 0}, {5, 0}, {5, -5}}, 0.35, 4.0},
                    Polyline{"gentle bend", {{0, 0}, {200, 0}, {372, 15.5}}, 300, 0.0018},
                    Polyline{"hardly a bend", {{0, 0}, {5, 0}, {10, 1e-5}}, 0.5, 4},
                    Polyline{"acute", {{0, 0}, {6, 0}, {0, 2}}, 0.5, 8},
                    Polyline{"hairpin", {{0, 0}, {20, 0}, {0, 1}}, 0.3, 40},
                    Polyline{"u-turn of two corners", {{0, 0}, {5, 0}, {5, 2}, {0, 2}}, 0.6, 6},
                    Polyline{"s-bend", {{0, 0}, {3, 0}, {4.5, 1.5}, {7.5, 1.5}}, 0.8, 3},
                    Polyline{"zigzag", {{0, 0}, {2, 0}, {2, 2}, {4, 2}, {4, 4}, {2, 4}}, 0.5, 8}));

TEST(Corner, TheRadiusIsReachedOrTheClothoidsMeet) {
  const CornerShape wide = ShapeCorner(pi / 2, 0.6, 5.7);
  EXPECT_EQ(wide.curvature_per_m, 1 / 0.6);
  EXPECT_GT(wide.arc_m, 0);
  const CornerShape brief = ShapeCorner(-0.3, 0.6, 5.7);
  EXPECT_LT(brief.curvature_per_m, 1 / 0.6);
  EXPECT_EQ(brief.arc_m, 0);
  EXPECT_NEAR(brief.curvature_per_m * brief.ramp_m, 0.3, 1e-12) << "two triangles of curvature";
}

TEST(Corner, AsSteeringGetsFasterItBecomesTheArc) {
  const CornerShape arc = ShapeCorner(2.1, 0.7, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(arc.tangent_m, 0.7 * std::tan(1.05), 1e-12);
  double before = 1e9;
  for (const double sharpness : {10.0, 100.0, 1e4, 1e6}) {
    const double longer = ShapeCorner(2.1, 0.7, sharpness).tangent_m - arc.tangent_m;
    EXPECT_GT(longer, 0);
    EXPECT_LT(longer, before);
    before = longer;
  }
  EXPECT_LT(before, 1e-5);
}

TEST(Cornering, CornersThatAreCrowdedAreTakenMoreSlowly) {
  RouteLimits limits;
  limits.curvature_rate_per_m_s = 3;
  limits.lateral_jerk_mps3 = 4;
  const auto u_turn = [&](double width_m) {
    return TakeCorners(
        {{{0, 0}, 0, 1}, {{5, 0}, 0.6, 1}, {{5, width_m}, 0.6, 1}, {{0, width_m}, 0.6, 1}}, limits);
  };
  const Cornering roomy = u_turn(3), tight = u_turn(1.35);
  EXPECT_NEAR(roomy.speeds_mps[1], 0.8 * 0.6, 1e-12) << "the turn rate at the radius";
  EXPECT_LT(tight.speeds_mps[1], roomy.speeds_mps[1]);
  EXPECT_NO_THROW(Path::Through(tight.waypoints));
  EXPECT_THROW(Path::Through(u_turn(1.21).waypoints), std::invalid_argument);
  EXPECT_THROW(Path::Through(u_turn(1.1).waypoints), std::invalid_argument) << "no room for arcs";
}

}  // namespace
}  // namespace aisle::sim
