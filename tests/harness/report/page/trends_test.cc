#include "harness/report/page/trends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "harness/report/page/night_series.h"

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* kHostile = "\"><script>alert(1)</script>";

/// Ten nights; what stands for a night in the month is told each of them.
struct Month {
  std::vector<TrendPoint> points;
  void Add(int day, const std::string& system, std::optional<double> ate_m, std::size_t failed = 0,
           const std::string& version = "") {
    points.push_back({.started = fmt::format("2026-01-{:02}T02:00:00Z", day),
                      .commit = fmt::format("c{}", day),
                      .scene = kHostile,
                      .twin = "live",
                      .system = system,
                      .score = "ate_rmse_m",
                      .median = ate_m,
                      .low = ate_m,
                      .high = ate_m,
                      .seeds = 9,
                      .failed = failed,
                      .limit = 0.03,
                      .version = version});
  }
};

Month Drifting() {
  Month month;
  for (int day = 1; day <= 10; ++day) {
    month.Add(day, "robust", day < 7 ? 0.020 : 0.041);
    month.Add(day, "ora|cle_", 0.01, 0, day < 4 ? "v1" : "v2");
  }
  return month;
}

TEST(TrendsTest, AreDrawnFromTwoNightsOn) {
  Month month;
  month.Add(1, "robust", 0.02);
  EXPECT_EQ(TrendSection(month.points, {}), "");
  month.Add(2, "robust", 0.02);
  const std::string section = TrendSection(month.points, {});
  EXPECT_THAT(section, HasSubstr("2 nights"));
  EXPECT_THAT(section, HasSubstr("data-name=\"robust\""));
  EXPECT_THAT(section, HasSubstr("class=\"limit c4\""));
  EXPECT_THAT(section, HasSubstr("Nothing is other than it was"));
  EXPECT_THAT(section, Not(HasSubstr("<script")));
}

TEST(TrendsTest, SayWhatChangedSinceWhenAndByHowMuch) {
  const Month month = Drifting();
  EXPECT_THAT(ChangesInWords(month.points),
              testing::ElementsAre(std::string(kHostile) +
                                   " live robust: ATE RMSE from 2 cm to 4.1 cm since 2026-01-07 "
                                   "(4 nights, commit c7)"));
  const SinceNotes notes = SinceWhen(month.points);
  EXPECT_THAT(notes.at({kHostile, "live", "robust", "ate_rmse_m"}), HasSubstr("since 2026-01-07"));
  EXPECT_THAT(TrendSection(month.points, {}), HasSubstr("git log --oneline c6..c7"));
}

TEST(TrendsTest, AForeignSystemsVersionsLeadToBisect) {
  Month month;
  for (int day = 1; day <= 10; ++day) {
    month.Add(day, "mine", day < 7 ? 0.02 : 0.04, 0, day < 7 ? "1a2b" : "v2; rm -r 'x'");
  }
  const std::string section = TrendSection(month.points, {.suite_file = "mine.yaml"});
  EXPECT_THAT(section, HasSubstr("./aisle bisect 1a2b "));
  // A system says its version itself: what is to be pasted into a shell holds one word.
  EXPECT_THAT(section,
              HasSubstr("&#39;v2; rm -r &#39;\\&#39;&#39;x&#39;\\&#39;&#39;&#39; mine.yaml"));
  EXPECT_THAT(section, HasSubstr("--limit &#39;ate_rmse_m&lt;=0.03&#39;"));
}

TEST(TrendsTest, NightsThatFailedStayAsMarks) {
  Month month;
  for (int day = 1; day <= 5; ++day) {
    month.Add(day, "mine", day < 5 ? std::optional(0.02) : std::nullopt, day < 5 ? 0 : 9);
  }
  const std::string section = TrendSection(month.points, {});
  EXPECT_THAT(section, HasSubstr("class=\"cross\""));
  EXPECT_THAT(section, HasSubstr("9 of 9 seeds failed"));
  EXPECT_THAT(section, HasSubstr("9 of 9 seeds fail since 2026-01-05 (last night"));
}

std::vector<std::string> AllOf(const std::string& page, const std::string& pattern) {
  const std::regex wanted(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(page.begin(), page.end(), wanted), end; at != end; ++at) {
    found.push_back((*at)[1]);
  }
  return found;
}

/// Whatever changed, and however long the scenes' names are: no link leads nowhere, no id is there
/// twice.
TEST(TrendsTest, EveryLinkHasItsChart) {
  Month month;
  for (const char* end : {"1", "2"}) {
    for (const char* score : {"ate_rmse_m", "coverage", "rpe_1s_trans_rmse_m", "mask_iou"}) {
      for (int day = 1; day <= 10; ++day) {
        month.Add(day, "robust", day < 7 ? 0.020 : 0.041);
        month.points.back().scene = std::string(90, 'n') + end;
        month.points.back().score = score;
      }
    }
  }
  for (int day = 1; day <= 10; ++day) {  // never has a number: there is nothing to draw
    month.Add(day, "mine", std::nullopt, day < 7 ? 0 : 9);
    month.points.back().scene = "crashes";
  }
  std::ranges::stable_sort(month.points, {}, &TrendPoint::started);
  const std::string section = TrendSection(month.points, {});
  const std::vector<std::string> ids = AllOf(section, " id=\"([^\"]*)\"");
  const std::set<std::string> known(ids.begin(), ids.end());
  EXPECT_EQ(known.size(), ids.size());
  const std::vector<std::string> links = AllOf(section, " href=\"#([^\"]*)\"");
  EXPECT_EQ(links.size(), 8u) << "four scores of two scenes";
  EXPECT_EQ(std::set<std::string>(links.begin(), links.end()).size(), 8u);
  for (const std::string& link : links) EXPECT_TRUE(known.contains(link)) << link;
  for (const auto& [what, note] : SinceWhen(month.points)) {
    for (const std::string& link : AllOf(note, "trends.html#([^\"]*)\"")) {
      EXPECT_TRUE(known.contains(link)) << link;
    }
  }
}

TEST(TrendsTest, WhatIsAsItWasIsNoNews) {
  Month month;
  for (int day = 1; day <= 10; ++day) month.Add(day, "robust", 0.02 + 0.0001 * (day % 3));
  EXPECT_THAT(ChangesInWords(month.points), IsEmpty());
  EXPECT_THAT(SinceWhen(month.points), IsEmpty());
}

TEST(NightSeriesTest, NightsStandWhereTheirDatesAre) {
  Month month;
  month.Add(1, "robust", 0.02);
  month.Add(5, "robust", 0.02);
  EXPECT_DOUBLE_EQ(ReadNights(month.points).nights[1].day, 4);
  month.points[1].started = "5";
  month.points[0].started = "1";
  EXPECT_DOUBLE_EQ(ReadNights(month.points).nights[1].day, 1);  // no date: its number
}

}  // namespace
}  // namespace aisle
