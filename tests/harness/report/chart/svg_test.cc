#include "harness/report/chart/svg.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/harness/report/svg_reader.h"

namespace aisle {
namespace {

TEST(Axis, IsAffineAndMeetsItsEndsBothWaysRound) {
  for (const Axis& axis : {Axis{-3, 7, 10, 400}, Axis{0, 1e-3, 300, 20}}) {
    EXPECT_DOUBLE_EQ(axis(axis.low), axis.from_px);
    EXPECT_NEAR(axis(axis.high), axis.to_px, 1e-9);
    const double middle = (axis.low + axis.high) / 2;
    EXPECT_NEAR(axis(middle), (axis.from_px + axis.to_px) / 2, 1e-9);
  }
}

TEST(Ticks, AreRoundEvenInsideAndAboutAsManyAsAskedFor) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int round = 0; round < 2000; ++round) {
    const double size = std::pow(10, 12 * unit(random) - 6);
    const double low = size * 10 * (unit(random) - 0.5), high = low + size * (0.1 + unit(random));
    const int count = 2 + round % 9;
    const std::vector<double> ticks = Ticks(low, high, count);
    const double slack = 1e-6 * (high - low);
    ASSERT_LE(ticks.size(), static_cast<std::size_t>(count) + 1) << low << " to " << high;
    // Steps are at most 2.5 times what was asked for.
    ASSERT_GE(ticks.size(), static_cast<std::size_t>(count / 2.5) / 1) << low << " to " << high;
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_GE(ticks[i], low - slack);
      EXPECT_LE(ticks[i], high + slack);
      if (i < 2) continue;
      EXPECT_NEAR(ticks[i] - ticks[i - 1], ticks[1] - ticks[0], slack);
    }
    if (ticks.size() < 2) continue;
    const double step = ticks[1] - ticks[0];
    const double digit = step / std::pow(10, std::floor(std::log10(step) + 1e-9));
    const double nearest =
        std::min({std::abs(digit - 1), std::abs(digit - 2), std::abs(digit - 5)});
    EXPECT_LT(nearest, 1e-6) << step;
    // A multiple of the step: 0 is a tick where it is inside.
    EXPECT_NEAR(std::remainder(ticks[0], step), 0, slack);
  }
}

TEST(Ticks, OfNothingAreOne) {
  EXPECT_EQ(Ticks(3, 3, 5), std::vector<double>{3});
  EXPECT_EQ(Ticks(3, std::nan(""), 5), std::vector<double>{3});
  EXPECT_EQ(Ticks(5, 3, 5), std::vector<double>{5});
}

double DistanceTo(const std::vector<std::pair<double, double>>& line, double x, double y) {
  double nearest = 1e9;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Eigen::Vector2d a(line[i - 1].first, line[i - 1].second);
    const Eigen::Vector2d b(line[i].first, line[i].second), p(x, y);
    const double length = (b - a).squaredNorm();
    const double at = length > 0 ? std::clamp((p - a).dot(b - a) / length, 0.0, 1.0) : 0.0;
    nearest = std::min(nearest, (p - a - at * (b - a)).norm());
  }
  return nearest;
}

/// What the short notation says is the line that was given, to 0.7 pixels and the half pixel in
/// which it is told.
TEST(Svg, ALineReadBackPassesEveryPointThatWasGiven) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> step(0, seed % 4 ? 20 : 0.3);
    std::vector<std::pair<double, double>> points{{400, 100}};
    while (points.size() < 60) {
      points.emplace_back(points.back().first + step(random), points.back().second + step(random));
    }
    Svg svg = Svg::Map(800, 300, "lines");
    svg.Polyline(points, "line c1", "one");
    const auto paths = SvgReader(svg.Finish()).Paths("line c1");
    ASSERT_EQ(paths.size(), 1u);
    EXPECT_EQ(paths[0].name, "one");
    for (const auto& [x, y] : points) EXPECT_LT(DistanceTo(paths[0].points, x, y), 1.1) << seed;
    EXPECT_NEAR(paths[0].points.front().first, points.front().first, 0.26);
    EXPECT_NEAR(paths[0].points.back().second, points.back().second, 0.26);
  }
}

TEST(Svg, AreasReachTheirBaseAndBandsGoOutAndBack) {
  Svg svg = Svg::Chart(100, "areas");
  svg.Area({{100, 20}, {500, 80}, {900, 30}}, 95, "movers");
  svg.Band({{100, 60}, {900, 70}}, {{100, 40}, {900, 10}}, "band d1");
  svg.Band({{1, 2}}, {{1, 3}}, "band d2");
  svg.Polyline({{5, 5}}, "line c1");
  const SvgReader reader(svg.Finish());
  using Points = std::vector<std::pair<double, double>>;
  EXPECT_EQ(reader.Paths("movers").at(0).points,
            (Points{{100, 95}, {100, 20}, {500, 80}, {900, 30}, {900, 95}}));
  EXPECT_EQ(reader.Paths("band d1").at(0).points,
            (Points{{100, 40}, {900, 10}, {900, 70}, {100, 60}}));
  EXPECT_TRUE(reader.Paths("band d2").empty()) << "one place is no band";
  EXPECT_TRUE(reader.Paths("line").empty()) << "one point is no line";
}

TEST(Svg, APieceOfOnePointIsADotAtItsPlace) {
  Svg svg = Svg::Chart(100, "pieces");
  EXPECT_TRUE(svg.Pieces({{{10, 20}}, {{30, 20}, {50, 60}}, {}, {{70, 40}}}, "line c1", "one"));
  EXPECT_FALSE(svg.Pieces({{}}, "line c2", "none"));
  EXPECT_FALSE(svg.Pieces({}, "line c2", "none"));
  const SvgReader reader(svg.Finish());
  const auto paths = reader.Paths("line c1");
  ASSERT_EQ(paths.size(), 2u) << "the line, and all dots together";
  using Points = std::vector<std::pair<double, double>>;
  EXPECT_EQ(paths[0].points, (Points{{30, 20}, {50, 60}}));
  EXPECT_EQ(paths[1].points, (Points{{10, 20}, {10, 20}, {70, 40}, {70, 40}}));
  EXPECT_EQ(paths[1].css, "line c1 point");
  EXPECT_TRUE(reader.Paths("line c2").empty());
}

/// Whatever a system is called, the chart stays well-formed and says that very name.
TEST(Svg, HostileNamesAreTextAndNothingElse) {
  const std::string name = "<script>\"&'>]]><!-- \xC3\xA4";
  Svg svg = Svg::Chart(100, name, Svg::Names::kSystems);
  svg.Text(10, 10, name, "axis");
  svg.NameAtLeft(30, name, "legend");
  svg.Rect(10, 10, 20, 20, "bar", name);
  svg.Marker(50, 50, 7, name, "a.html?x=\"&y='");
  svg.Cross(60, 50, name);
  svg.Circle(70, 50, 3, "dot", name);
  svg.Polyline({{0, 0}, {9, 9}}, "line", name);
  svg.Grid({0, 1, 0, 1000}, {0, 1, 90, 10}, name, name);
  const SvgReader reader(svg.Finish() + Legend({{name, "line"}}));
  EXPECT_TRUE(reader.All("script").empty());
  EXPECT_EQ(reader.Paths("line").at(0).name, name);
  EXPECT_EQ(reader.All("a").at(0).attribute("href").value(), std::string("a.html?x=\"&y='"));
  std::size_t told = 0;
  for (const char* element : {"text", "title"}) {
    for (const pugi::xml_node& node : reader.All(element)) told += node.child_value() == name;
  }
  EXPECT_EQ(told, 2u + 2u + 4u) << "texts, titles of the axes, tips";
}

}  // namespace
}  // namespace aisle
