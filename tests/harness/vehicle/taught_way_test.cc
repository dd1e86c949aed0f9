#include "harness/vehicle/taught_way.h"

#include <gtest/gtest.h>

#include <functional>

namespace aisle {
namespace {

/// Along a polygon, samples every 2 cm.
WayLeg Along(const std::vector<Eigen::Vector2d>& corners) {
  WayLeg leg{.kind = WayLeg::Kind::kDrive};
  double before_m = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Eigen::Vector2d way = corners[i] - corners[i - 1];
    const int steps = static_cast<int>(way.norm() / 0.02);
    for (int k = i == 1 ? 0 : 1; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      leg.points.push_back({.distance_m = before_m + share * way.norm(),
                            .position = corners[i - 1] + share * way,
                            .heading_rad = std::atan2(way.y(), way.x()),
                            .curvature_per_m = 0.25,
                            .speed_mps = 0.7});
    }
    before_m += way.norm();
  }
  return leg;
}

using Map = std::function<FloorPose(const FloorPose& site)>;

/// Led along a leg a hand's breadth beside it, a pose every `every_m`, and what a map says of it.
std::vector<TaughtPose> Led(const WayLeg& leg, const Map& map, double every_m = 0.04) {
  std::vector<TaughtPose> poses;
  for (double on_m = 0; on_m <= leg.length_m(); on_m += every_m) {
    const WayPoint point = PointAt(leg, on_m);
    const FloorPose led = FloorPose{point.position, point.heading_rad} * FloorPose{{0, 0.03}, 0.02};
    poses.push_back({led, map(led)});
  }
  return poses;
}

TEST(TaughtWayTest, AMapOfAnotherScaleAndHeadingTakesTheWayWithIt) {
  const WayLeg leg = Along({{0, 0}, {6, 0}, {6, 4}});
  const double scale = 1.004, turned = 0.01;
  const FloorPose turn{{0, 0}, turned};
  const Map map = [&](const FloorPose& site) -> FloorPose {
    return turn * FloorPose{scale * site.position, site.heading_rad};
  };
  const Way taught = TaughtWay({leg}, Led(leg, map));
  ASSERT_EQ(taught.size(), 1u);
  ASSERT_EQ(taught[0].points.size(), leg.points.size());
  for (std::size_t i = 0; i < leg.points.size(); ++i) {
    const WayPoint &was = leg.points[i], &is = taught[0].points[i];
    const FloorPose expected = map({was.position, was.heading_rad});
    // A hand's breadth and half a frame off by a scale of 0.4 %.
    EXPECT_LT((is.position - expected.position).norm(), 3e-4) << i;
    EXPECT_NEAR(is.heading_rad, expected.heading_rad, 1e-9) << i;
    EXPECT_EQ(is.speed_mps, was.speed_mps);
    EXPECT_EQ(is.curvature_per_m, was.curvature_per_m);
  }
  EXPECT_NEAR(taught[0].length_m(), scale * leg.length_m(), 1e-3);
}

TEST(TaughtWayTest, APlaceThatIsPassedTwiceIsTaughtTwice) {
  // Round a square, two times; the map of the second round lies aside.
  const std::vector<Eigen::Vector2d> round = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0}};
  const WayLeg first = Along(round), second = Along(round);
  const Map straight = [](const FloorPose& site) { return site; };
  const Map aside = [](const FloorPose& site) {
    return FloorPose{site.position + Eigen::Vector2d(0.05, -0.02), site.heading_rad};
  };
  std::vector<TaughtPose> poses = Led(first, straight);
  for (const TaughtPose& pose : Led(second, aside)) poses.push_back(pose);
  const Way taught = TaughtWay({first, second}, poses);
  for (std::size_t i = 20; i + 20 < first.points.size(); ++i) {
    EXPECT_LT((taught[0].points[i].position - first.points[i].position).norm(), 1e-9) << i;
    const Eigen::Vector2d moved = taught[1].points[i].position - second.points[i].position;
    EXPECT_LT((moved - Eigen::Vector2d(0.05, -0.02)).norm(), 1e-9) << i;
  }
}

TEST(TaughtWayTest, WhereTheSystemWasLostTheErrorBeforePassesIntoTheErrorAfter) {
  const WayLeg leg = Along({{0, 0}, {10, 0}});
  const Map map = [](const FloorPose& site) {
    return FloorPose{site.position + Eigen::Vector2d(0, 0.01 * site.position.x()),
                     site.heading_rad};
  };
  std::vector<TaughtPose> poses = Led(leg, map);
  std::erase_if(poses, [](const TaughtPose& pose) {
    return pose.led.position.x() > 4 && pose.led.position.x() < 6.5;
  });
  const Way taught = TaughtWay({leg}, poses);
  for (const WayPoint& point : taught[0].points) {
    EXPECT_NEAR(point.position.y(), 0.01 * point.position.x(), 0.002) << point.position.x();
  }
}

TEST(TaughtWayTest, ATurnOnTheSpotEndsWhereTheMapSaysThatItEnded) {
  const WayLeg there = Along({{0, 0}, {2, 0}}), on = Along({{2, 0}, {2, 2}});
  const WayLeg turn{.kind = WayLeg::Kind::kTurn, .turn_to_rad = std::numbers::pi / 2};
  const Map map = [](const FloorPose& site) {  // turns come out 1 % too large
    return FloorPose{site.position, 1.01 * site.heading_rad};
  };
  std::vector<TaughtPose> poses = Led(there, map);
  for (double heading = 0; heading < 1.56; heading += 0.02) {
    const FloorPose led{{2, 0.03}, heading};
    poses.push_back({led, map(led)});
  }
  for (const TaughtPose& pose : Led(on, map)) poses.push_back(pose);
  const Way taught = TaughtWay({there, turn, on}, poses);
  EXPECT_NEAR(taught[1].turn_to_rad, 1.01 * std::numbers::pi / 2, 1e-3);
}

TEST(TaughtWayTest, WithoutPosesItStaysAsPlanned) {
  const WayLeg leg = Along({{0, 0}, {1, 0}});
  const Way taught = TaughtWay({leg}, {});
  EXPECT_EQ(taught[0].points.back().position, leg.points.back().position);
}

}  // namespace
}  // namespace aisle
