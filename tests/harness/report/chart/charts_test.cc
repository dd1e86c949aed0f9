#include "harness/report/chart/charts.h"

#include <gtest/gtest.h>

#include <random>

#include "harness/report/chart/drive_chart.h"
#include "harness/report/chart/time_chart.h"
#include "tests/harness/report/svg_reader.h"

namespace aisle {
namespace {

/// A drive along x that swings to the left, each track off by its own error.
std::vector<FrameRow> Drive(int frames, double error_m) {
  std::vector<FrameRow> rows(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    FrameRow& row = rows[static_cast<std::size_t>(i)];
    row.id = i;
    row.stamp_ns = 50'000'000LL * i;
    row.truth_m = {0.1 * i, std::sin(0.1 * i), 0.3};
    row.live_m = row.truth_m + Eigen::Vector3d(0, error_m * i / frames, 0);
    row.live_error_m = (*row.live_m - row.truth_m).norm();
    row.movers_share = 0.002 * (i % 40);
    row.corners_rejected = i % 17;
  }
  return rows;
}

std::vector<pugi::xml_node> Bars(const SvgReader& reader) {
  std::vector<pugi::xml_node> bars = reader.All("rect");
  std::erase_if(bars, [](const pugi::xml_node& n) {
    return !std::string(n.attribute("class").value()).starts_with("bar");
  });
  return bars;
}

TEST(StageChart, BarsAreAsLongAsTheirTimesEndToEndAndInside) {
  const std::vector<StageRow> rows = {
      {"plain", 30, {{"extract", 0, 10}, {"match", 1, 5.5}}, {{"mapping", 2, 22}}},
      {"robust", 64, {{"extract", 0, 12}, {"dynamic", 3, 40}}, {}},
      {"none", 0, {}, {}}};
  const SvgReader reader(StageChart(rows));
  std::map<std::string, double> ms = {{"the whole step 30.00 ms", 30}, {"extract 10.00 ms", 10},
                                      {"match 5.50 ms", 5.5},          {"mapping 22.00 ms", 22},
                                      {"the whole step 64.00 ms", 64}, {"extract 12.00 ms", 12},
                                      {"dynamic 40.00 ms", 40}};
  double per_ms = 0, end = 0;
  std::string row_y;
  const auto bars = Bars(reader);
  ASSERT_EQ(bars.size(), ms.size());
  for (const pugi::xml_node& bar : bars) {
    const double x = SvgReader::Across(bar.attribute("x"));
    const double width = SvgReader::Across(bar.attribute("width"));
    const std::string tip = bar.child("title").child_value();
    ASSERT_TRUE(ms.contains(tip)) << tip;
    if (per_ms == 0) per_ms = width / ms[tip];
    EXPECT_NEAR(width, per_ms * ms[tip], 0.01) << tip;
    EXPECT_LE(x + width, 1000);
    const bool whole = tip.starts_with("the whole");
    if (whole || row_y != bar.attribute("y").value()) end = 0;
    row_y = bar.attribute("y").value();
    EXPECT_NEAR(x, whole ? 0 : end, 0.02) << tip << " begins where the one before it ends";
    if (!whole) end = x + width;
  }
  EXPECT_GT(per_ms, 1000 / 64.0 * 0.9) << "the longest fills the chart";
}

/// Whatever a system calls its stages, no two of sixteen look the same.
TEST(StageChart, TheNinthStageIsNotTheFirst) {
  StageRow row{"many", 32, {}, {}};
  for (int i = 0; i < 16; ++i) row.inside.push_back({fmt::format("s{}", i), i, 2});
  const SvgReader reader(StageChart({row}));
  std::set<std::string> bars, swatches;
  for (const pugi::xml_node& bar : Bars(reader)) bars.insert(bar.attribute("class").value());
  for (const pugi::xml_node& line : reader.All("line")) {
    const std::string css = line.attribute("class").value();
    if (css.starts_with("swatch")) swatches.insert(css);
  }
  EXPECT_EQ(bars.size(), 17u) << "sixteen and the rest of the step";
  EXPECT_EQ(swatches.size(), 17u);
}

TEST(SpreadChart, DotsStandAtTheirValuesAndTheBoxHoldsTheMiddleHalf) {
  const std::vector<double> values = {0.05, 0.01, 0.03, 0.02, 0.04};
  const SvgReader reader(SpreadChart({{"plain", 1, values}, {"oracle", 2, {0.02}}}, "ATE [m]"));
  const double per_m = 1000 / (1.05 * 0.05);
  std::vector<double> dots;
  for (const pugi::xml_node& dot : reader.All("svg", "at")) {
    dots.push_back(SvgReader::Across(dot.attribute("x")));
  }
  ASSERT_EQ(dots.size(), 6u);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(dots[i], per_m * values[i], 0.02);
  EXPECT_NEAR(dots[5], per_m * 0.02, 0.02);
  const auto box = reader.All("rect", "box c1");
  ASSERT_EQ(box.size(), 1u) << "of more than two values alone";
  EXPECT_NEAR(SvgReader::Across(box[0].attribute("x")), per_m * 0.02, 0.02);
  EXPECT_NEAR(SvgReader::Across(box[0].attribute("width")), per_m * 0.02, 0.02);
  const auto median = reader.All("line", "line c1");
  EXPECT_NEAR(SvgReader::Across(median.at(0).attribute("x1")), per_m * 0.03, 0.02);
  EXPECT_EQ(SpreadChart({{"plain", 1, {0, 0}}}, "x"), "") << "nothing to see";
}

/// Every point of every line lies in the panel that says which values it has, at those values.
TEST(TimeChart, PointsLieInTheirPanelAtTheirValues) {
  const std::vector<FrameRow> near = Drive(100, 0.05), far = Drive(80, 0.4);
  const std::vector<ChartSeries> series = {{"near", 1, &near}, {"far", 2, &far}};
  const SvgReader reader(TimeChart(series));
  const auto panels = reader.All("rect", "panel");
  ASSERT_EQ(panels.size(), 3u) << "error, movers, corners; of the rest nothing is known";
  std::istringstream x(panels[0].attribute("data-x").value());
  std::istringstream y(panels[0].attribute("data-y").value());
  double low, high, from, to, y_low, y_high, y_from, y_to;
  x >> low >> high >> from >> to;
  y >> y_low >> y_high >> y_from >> y_to;
  EXPECT_NEAR(high, 99 * 0.05, 1e-3);
  const std::vector<std::pair<std::string, const std::vector<FrameRow>*>> lines = {
      {"line c1", &near}, {"line c2", &far}};
  for (const auto& [css, rows] : lines) {
    const auto paths = reader.Paths(css);
    ASSERT_FALSE(paths.empty());
    const auto& [end_x, end_y] = paths[0].points.back();
    const FrameRow& last = rows->back();
    const double seconds = 1e-9 * static_cast<double>(last.stamp_ns);
    EXPECT_NEAR(end_x, from + (seconds - low) / (high - low) * (to - from), 0.5) << css;
    const double cm = 100 * *last.live_error_m;
    EXPECT_NEAR(end_y, y_from + (cm - y_low) / (y_high - y_low) * (y_to - y_from), 0.5) << css;
    for (const auto& [px, py] : paths[0].points) {
      EXPECT_GE(px, -0.5);
      EXPECT_LE(px, 1000.5);
      EXPECT_LE(py, std::max(y_from, y_to) + 0.5);
      EXPECT_GE(py, std::min(y_from, y_to) - 0.5);
    }
  }
  const std::vector<FrameRow> one = Drive(1, 1);
  EXPECT_EQ(TimeChart({{"short", 1, &one}}), "");
  EXPECT_EQ(TimeChart({}), "");
}

TEST(TimeChart, ALostTrackLeavesAGap) {
  std::vector<FrameRow> rows = Drive(100, 0.3);
  for (std::size_t i = 40; i < 60; ++i) rows[i].live_error_m.reset();
  const auto paths = SvgReader(ErrorOverFrames({{"lost", 1, &rows}})).Paths("line c1");
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_NEAR(paths[0].points.back().first, 1000.0 * 39 / 99, 0.5);
  EXPECT_NEAR(paths[1].points.front().first, 1000.0 * 60 / 99, 0.5);
}

/// The median over seeds has the gap of the frames that every seed lost, and so has its band.
TEST(TimeChart, WhatEverySeedLostIsAGapOfTheMedian) {
  std::vector<std::vector<FrameRow>> seeds(5, Drive(100, 0.3));
  for (std::vector<FrameRow>& rows : seeds) {
    for (std::size_t i = 40; i < 60; ++i) rows[i].live_error_m.reset();
  }
  ChartSeries series{"lost", 1, &seeds[0], "worst: seed 1"};
  for (const std::vector<FrameRow>& rows : seeds) series.seeds.push_back(&rows);
  const SvgReader reader(TimeChart({series}));
  std::vector<SvgReader::Path> median = reader.Paths("line c1");
  std::erase_if(median, [](const auto& path) { return path.name != "lost, median"; });
  for (const auto& pieces : {median, reader.Paths("band d1")}) {
    ASSERT_EQ(pieces.size(), 2u);
    for (const SvgReader::Path& piece : pieces) {
      for (const auto& [x, y] : piece.points) {
        EXPECT_TRUE(x < 1000.0 * 39.5 / 99 || x > 1000.0 * 59.5 / 99) << x;
      }
    }
  }
}

TEST(TimeChart, APoseInEverySecondFrameIsDrawn) {
  std::vector<FrameRow> rows = Drive(100, 0.3);
  for (std::size_t i = 0; i < rows.size(); i += 2) {
    rows[i].live_error_m.reset();
    rows[i].live_m.reset();
  }
  for (const std::string& chart :
       {TimeChart({{"blinks", 1, &rows}}), TopViewChart({{"blinks", 1, &rows}})}) {
    const auto dots = SvgReader(chart).Paths("line c1");
    ASSERT_EQ(dots.size(), chart.find("class=\"map\"") == std::string::npos ? 2u : 1u);
    EXPECT_EQ(dots[0].points.size(), 100u) << "of 50 frames, each as a place and a step of none";
    EXPECT_NE(chart.find("</svg>blinks</span>"), std::string::npos) << "named below";
  }
}

TEST(TopViewChart, NamesATrackThatBeginsWithASinglePose) {
  std::vector<FrameRow> rows = Drive(100, 0.3);
  rows[1].live_m.reset();
  EXPECT_NE(TopViewChart({{"late", 1, &rows}}).find("</svg>late</span>"), std::string::npos);
  for (FrameRow& row : rows) row.live_m.reset();
  EXPECT_EQ(TopViewChart({{"late", 1, &rows}}).find("late"), std::string::npos);
}

/// Seen from above and never mirrored: a turn to the left is one on the page.
TEST(TopViewChart, TurnsLeftWhereTheVehicleDoesHoweverThePageIsTurned) {
  for (const bool along_y : {false, true}) {
    std::vector<FrameRow> rows = Drive(100, 0.1);
    for (int i = 0; i < 100; ++i) {
      const double ahead = 0.1 * std::min(i, 75), left = 0.1 * std::max(0, i - 75);
      FrameRow& row = rows[static_cast<std::size_t>(i)];
      row.truth_m = along_y ? Eigen::Vector3d(-left, ahead, 0) : Eigen::Vector3d(ahead, left, 0);
      row.live_m = row.truth_m;
    }
    const std::string chart = TopViewChart({{"one", 1, &rows}});
    for (const char* css : {"truth", "line c1"}) {
      const auto way = SvgReader(chart).Paths(css).at(0).points;
      ASSERT_GE(way.size(), 3u);
      const auto& [ax, ay] = way.front();
      const auto& [bx, by] = way[1];  // the corner: a straight line has no points of its own
      const auto& [cx, cy] = way.back();
      // The page's y grows downwards: a left turn has a negative cross product there.
      EXPECT_LT((bx - ax) * (cy - by) - (by - ay) * (cx - bx), -100) << along_y << css;
    }
    // What the axes say is where the corner is drawn.
    const pugi::xml_node panel = SvgReader(chart).All("rect", "panel").at(0);
    std::istringstream y(panel.attribute("data-y").value());
    double low, high, from, to;
    y >> low >> high >> from >> to;
    EXPECT_EQ(from < to, along_y) << "x grows downwards where y lies across";
  }
}

/// Who steers has a drive of its own: each system's truth is drawn, and all of them are in sight.
TEST(TopViewChart, DrivesThatDifferHaveEachTheirTruth) {
  const std::vector<FrameRow> one = Drive(100, 0.05);
  std::vector<FrameRow> astray = Drive(60, 0.05);
  for (FrameRow& row : astray) row.truth_m.y() -= 0.1 * static_cast<double>(row.id);
  const std::string chart = TopViewChart({{"one", 1, &one}, {"astray", 2, &astray}});
  const SvgReader reader(chart);
  EXPECT_EQ(reader.Paths("truth c1").size(), 1u);
  ASSERT_EQ(reader.Paths("truth c2").size(), 1u);
  EXPECT_EQ(reader.Paths("truth").size(), 2u);
  EXPECT_NE(chart.find("truth of astray"), std::string::npos);
  const pugi::xml_node panel = reader.All("rect", "panel").at(0);
  const double top = panel.attribute("y").as_double();
  const double bottom = top + panel.attribute("height").as_double();
  const auto way = reader.Paths("truth c2").at(0).points;
  for (const auto& [x, y] : way) {
    EXPECT_GT(y, top);
    EXPECT_LT(y, bottom);
  }
  const std::vector<FrameRow> shorter = Drive(60, 0.05);
  const SvgReader same(TopViewChart({{"one", 1, &one}, {"short", 2, &shorter}}));
  ASSERT_EQ(same.Paths("truth").size(), 1u) << "one drive, one truth";
  EXPECT_EQ(same.Paths("truth").at(0).css, "truth");
}

/// Equal scales; deviations are drawn as many times as large as the caption says.
TEST(TopViewChart, DrawsToScaleAndSaysHowMuchDeviationsAreMagnified) {
  for (const double error_m : {0.004, 0.05, 2.0}) {
    const std::vector<FrameRow> rows = Drive(100, error_m);
    const SvgReader reader(TopViewChart({{"one", 1, &rows}}));
    const auto truth = reader.Paths("truth").at(0).points,
               line = reader.Paths("line c1").at(0).points;
    // 9.9 m across from the first to the last pose, and its difference in y.
    const double px_per_m = (truth.back().first - truth.front().first) / 9.9;
    EXPECT_NEAR(truth.front().second - truth.back().second, px_per_m * std::sin(9.9), 1)
        << "y is up";
    double factor = 1;
    for (const pugi::xml_node& text : reader.All("text", "axis")) {
      const std::string said = text.child_value();
      const std::size_t times = said.find("\xC3\x97");
      if (times != std::string::npos) factor = std::stod(said.substr(times + 2));
    }
    const double off_px = truth.back().second - line.back().second;
    EXPECT_NEAR(off_px, factor * px_per_m * error_m * 0.99, 1) << error_m;
    EXPECT_EQ(factor > 10, error_m < 0.01) << "too small to be seen to scale";
    EXPECT_EQ(factor == 1, error_m > 1);
  }
}

DriveLog Turning(bool along_y) {
  DriveLog log;
  for (int i = 0; i <= 100; ++i) {
    const double s = 0.1 * i, bend = i > 50 ? 0.1 * (i - 50) * 0.5 : 0;  // to the left
    const Eigen::Vector2d place = along_y ? Eigen::Vector2d(-bend, s) : Eigen::Vector2d(s, bend);
    log.route.push_back({place, 0});
    DriveSample sample;
    sample.stamp_ns = 100'000'000LL * i;
    sample.truth = sample.belief = {place, 0};
    sample.cross_track_m = 0.002 * i * std::sin(0.3 * i);
    log.track.samples.push_back(sample);
  }
  return log;
}

/// A map seen from above is never mirrored: a turn to the left is one on the page.
TEST(DrivePlanChart, TurnsLeftWhereTheVehicleDoesHoweverThePageIsTurned) {
  for (const bool along_y : {false, true}) {
    const DriveLog log = Turning(along_y);
    const auto way = SvgReader(DrivePlanChart({{"one", 1, &log}})).Paths("truth").at(0).points;
    ASSERT_GE(way.size(), 3u);
    const auto& [ax, ay] = way.front();
    const auto& [bx, by] = way[way.size() / 2];
    const auto& [cx, cy] = way.back();
    // The page's y grows downwards: a left turn has a negative cross product there.
    EXPECT_LT((bx - ax) * (cy - by) - (by - ay) * (cx - bx), 0) << along_y;
  }
}

TEST(DriveErrorChart, TheWorstSampleIsTheFarthestPointOfTheLine) {
  const DriveLog log = Turning(false);
  const DriveSample* worst = WorstSample(log.track);
  ASSERT_NE(worst, nullptr);
  for (const DriveSample& sample : log.track.samples) {
    EXPECT_LE(std::abs(sample.cross_track_m), std::abs(worst->cross_track_m));
  }
  EXPECT_EQ(WorstSample(DriveTrack{}), nullptr);
  const auto line = SvgReader(DriveErrorChart({{"one", 1, &log}})).Paths("line c1").at(0).points;
  double top = 1e9, bottom = -1e9, top_x = 0, bottom_x = 0;
  for (const auto& [x, y] : line) {
    if (y < top) top = y, top_x = x;
    if (y > bottom) bottom = y, bottom_x = x;
  }
  const double worst_x = 1000 * 1e-9 * static_cast<double>(worst->stamp_ns) / 10;
  EXPECT_NEAR(worst->cross_track_m > 0 ? top_x : bottom_x, worst_x, 5) << "left is up";
  EXPECT_EQ(DriveErrorChart({}), "");
}

}  // namespace
}  // namespace aisle
