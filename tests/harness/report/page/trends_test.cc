#include "harness/report/page/trends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;

TEST(TrendsTest, AreDrawnFromTwoNightsOn) {
  const std::string hostile = "\"><script>alert(1)</script>";
  std::vector<TrendPoint> points;
  const auto add_night = [&](const std::string& started, double ate_m) {
    for (const char* system : {"orbslam2", "ora|cle_"}) {
      points.push_back({.started = started,
                        .commit = "abc",
                        .scene = hostile,
                        .twin = "live",
                        .system = system,
                        .score = "ate_rmse_m",
                        .median = ate_m});
    }
  };
  add_night("1", 0.01);
  EXPECT_EQ(TrendSection(points), "");
  add_night("2", 0.02);
  const std::string section = TrendSection(points);
  EXPECT_THAT(section, HasSubstr("2 nights"));
  EXPECT_THAT(section, HasSubstr("data-name=\"ora|cle_\""));
  EXPECT_THAT(section, testing::Not(HasSubstr("<script")));
}

}  // namespace
}  // namespace aisle
