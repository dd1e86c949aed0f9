#include "harness/campaign/forecast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

TEST(ForecastTest, FramesAreRenderedOnceForAllSystems) {
  std::vector<RunSpec> specs;
  for (const char* twin : {"live", "empty"}) {
    for (const std::uint64_t seed : {1u, 2u}) {
      for (const char* system : {"a", "b", "c"}) {
        specs.push_back({"s", "s.yaml", twin, BuiltIn(system), seed});
      }
    }
  }
  int asked = 0;
  const auto count = [&](const std::string&) {
    ++asked;
    return std::int64_t{500};
  };
  const Forecast forecast = ForecastOf(specs, 2, count);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(forecast.runs, 12u);
  EXPECT_EQ(forecast.pairs, 4 * 500);
  EXPECT_EQ(forecast.system_frames, 12 * 500);
  EXPECT_NEAR(ForecastOf(specs, 4, count).wall_s, forecast.wall_s / 2, 1e-9);
  EXPECT_THAT(ToText(forecast), testing::HasSubstr("12 runs: 1 scene, 2 twins, 3 systems, 2 seeds; "
                                                   "2,000 stereo pairs to render, 6,000 frames"));
}

}  // namespace
}  // namespace aisle
