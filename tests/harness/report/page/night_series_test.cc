#include "harness/report/page/night_series.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "harness/report/page/trend_chart.h"
#include "tests/harness/report/svg_reader.h"

namespace aisle {
namespace {

struct History {
  std::vector<TrendPoint> points;
  std::set<std::string> evenings;
};

/// Some nights on some systems and scores, some missing, some failed.
History Random(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0, 1);
  History history;
  const int nights = 2 + static_cast<int>(random() % 12);
  int day = 1;
  for (int night = 0; night < nights; ++night) {
    day += 1 + static_cast<int>(random() % 2);
    const std::string started = fmt::format("2026-01-{:02}T02:00:00Z", day);
    for (const char* system : {"plain", "robust", "theirs"}) {
      for (const char* score : {"ate_rmse_m", "coverage"}) {
        if (random() % 6 == 0) continue;
        TrendPoint point;
        point.started = started;
        point.commit = fmt::format("c{}", night);
        point.scene = "hall";
        point.twin = "live";
        point.system = system;
        point.score = score;
        point.seeds = 9;
        point.failed = random() % 5 == 0 ? 1 + random() % 3 : 0;
        if (random() % 8 != 0) point.median = 0.01 + unit(random) * (night > 6 ? 0.2 : 0.01);
        history.points.push_back(point);
        history.evenings.insert(started);
      }
    }
  }
  return history;
}

TEST(NightBook, HasEveryPointOnceInItsNightAndSeries) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const History history = Random(seed);
    const NightBook book = ReadNights(history.points);
    ASSERT_EQ(book.nights.size(), history.evenings.size());
    std::set<const TrendPoint*> seen;
    for (const NightSeries& series : book.series) {
      ASSERT_EQ(series.points.size(), book.nights.size()) << "one per night";
      for (std::size_t night = 0; night < book.nights.size(); ++night) {
        const TrendPoint* point = series.points[night];
        if (point == nullptr) continue;
        EXPECT_TRUE(seen.insert(point).second);
        EXPECT_EQ(point->started, book.nights[night].started);
        EXPECT_EQ(std::tie(point->scene, point->twin, point->system, point->score),
                  std::tie(series.scene, series.twin, series.system, series.score));
      }
    }
    EXPECT_EQ(seen.size(), history.points.size());
    EXPECT_EQ(book.nights.front().day, 0);
    for (std::size_t i = 1; i < book.nights.size(); ++i) {
      EXPECT_GT(book.nights[i].day, book.nights[i - 1].day);
    }
    std::size_t failed = 0, told = 0;
    for (const TrendPoint& point : history.points) {
      if (point.score == "ate_rmse_m") failed += point.failed;
    }
    for (const Night& night : book.nights) told += night.failed;
    EXPECT_EQ(told, failed) << "a run that failed is counted by one of its scores";
  }
}

/// What is told as news is so: it fails since that night and not the night before, or its median
/// has moved to the side that is said.
TEST(NightChanges, AreTrueAndTheWorstComesFirst) {
  std::size_t failures = 0, moves = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const History history = Random(seed);
    const NightBook book = ReadNights(history.points);
    bool only_better = false, only_moves = false;
    for (const NightChange& change : ChangesOf(book)) {
      const auto& points = change.series->points;
      ASSERT_LT(change.night, points.size());
      EXPECT_FALSE(only_moves && change.failing) << "failures come first";
      EXPECT_FALSE(only_better && (change.failing || change.worse)) << "then what got worse";
      only_moves = only_moves || !change.failing;
      only_better = only_better || (!change.failing && !change.worse);
      if (change.failing) {
        ++failures;
        ASSERT_NE(points.back(), nullptr);
        EXPECT_GT(points.back()->failed, 0u);
        EXPECT_EQ(change.after, static_cast<double>(points.back()->failed));
        if (change.night > 0) {
          const TrendPoint* before = points[change.night - 1];
          EXPECT_TRUE(before == nullptr || before->failed == 0);
        }
        continue;
      }
      ++moves;
      const bool more = change.after > change.before;
      EXPECT_EQ(change.worse, more != (change.series->score == "coverage"));
      EXPECT_NE(change.after, change.before);
    }
  }
  EXPECT_GT(failures, 10u);
  EXPECT_GT(moves, 3u);
}

TEST(Followed, UnitsAreWhatTheFactorMakesOfTheScores) {
  EXPECT_EQ(Followed("ate_rmse_m").factor, 100);
  EXPECT_EQ(std::string(Followed("ate_rmse_m").unit), "cm");
  EXPECT_TRUE(Followed("coverage").more_is_better);
  EXPECT_FALSE(Followed("ate_rmse_m").more_is_better);
  EXPECT_EQ(Followed("nobody's score").factor, 1);
}

/// A night in which every run crashed has no error, least of all 0: a cross above a gap of the
/// line.
TEST(TrendChart, ANightWithoutANumberIsAGapAndACrossAtTheTop) {
  std::vector<TrendPoint> points;
  for (int day = 1; day <= 7; ++day) {
    const bool crashed = day == 4;
    const std::optional<double> ate_m = crashed ? std::nullopt : std::optional(0.02);
    points.push_back({.started = fmt::format("2026-01-{:02}T02:00:00Z", day),
                      .commit = "c",
                      .scene = "s",
                      .twin = "live",
                      .system = "robust",
                      .score = "ate_rmse_m",
                      .median = ate_m,
                      .low = ate_m,
                      .high = ate_m,
                      .seeds = 9,
                      .failed = crashed ? 9u : 0u});
  }
  const NightBook book = ReadNights(points);
  const SvgReader reader(
      TrendChart({&book.series[0]}, book.nights, [](const Night&) { return ""; }));
  const auto lines = reader.Paths("line c");
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(reader.Paths("band d").size(), 2u);
  EXPECT_LT(lines[0].points.back().first, lines[1].points.front().first - 100);
  const pugi::xml_node panel = reader.All("rect", "panel").at(0);
  std::size_t crosses = 0;
  for (const pugi::xml_node& mark : reader.All("svg", "at")) {
    if (std::string(mark.child("path").attribute("class").value()) != "cross") continue;
    ++crosses;
    EXPECT_NEAR(mark.attribute("y").as_double(), panel.attribute("y").as_double(), 0.1);
  }
  EXPECT_EQ(crosses, 1u);
}

TEST(TrendChart, PlacesNightsByTheirDaysAndKeepsThemInTheChart) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const History history = Random(seed);
    const NightBook book = ReadNights(history.points);
    std::vector<const NightSeries*> errors;
    for (const NightSeries& series : book.series) {
      if (series.score == "ate_rmse_m") errors.push_back(&series);
    }
    const std::string chart = TrendChart(errors, book.nights, [](const Night&) { return ""; });
    if (chart.empty()) continue;
    const SvgReader reader(chart);
    const double last = book.nights.back().day;
    std::set<long> allowed;
    for (const Night& night : book.nights) allowed.insert(std::lround(1000 * night.day / last));
    std::size_t marks = 0;
    for (const pugi::xml_node& mark : reader.All("svg", "at")) {
      const double x = SvgReader::Across(mark.attribute("x"));
      const auto near = [&](long place) { return std::abs(x - static_cast<double>(place)) < 25; };
      EXPECT_TRUE(std::ranges::any_of(allowed, near)) << x;
      EXPECT_GE(x, 0);
      EXPECT_LE(x, 1000);
      ++marks;
    }
    EXPECT_GT(marks, 0u);
  }
}

}  // namespace
}  // namespace aisle
