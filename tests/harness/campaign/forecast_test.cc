#include "harness/campaign/forecast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/record/record.h"

namespace aisle {
namespace {

bool Led(const std::string&) { return false; }

std::string ByName(const RunSpec& spec) {
  return fmt::format("{} {} {}", spec.scene, spec.twin, spec.seed);
}

/// 500 frames of each scene, told apart by names, none of which is kept.
FramesOfRuns Ahead() {
  return {.count = [](const std::string&) { return std::int64_t{500}; },
          .key = ByName,
          .kept = [](const std::string&) { return std::int64_t{0}; },
          .steered = Led};
}

FramesOfRuns Steered() {
  FramesOfRuns ahead = Ahead();
  ahead.steered = [](const std::string&) { return true; };
  return ahead;
}

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
  FramesOfRuns ahead = Ahead();
  ahead.count = [&](const std::string&) {
    ++asked;
    return std::int64_t{500};
  };
  const Forecast forecast = ForecastOf(specs, 2, ahead);
  EXPECT_EQ(asked, 1);
  EXPECT_EQ(forecast.runs, 12u);
  EXPECT_EQ(forecast.pairs, 4 * 500);
  EXPECT_EQ(forecast.system_frames, 12 * 500);
  EXPECT_NEAR(ForecastOf(specs, 4, ahead).wall_s, forecast.wall_s / 2, 1e-9);
  EXPECT_THAT(ToText(forecast), testing::HasSubstr("12 runs: 1 scene, 2 twins, 3 systems, 2 seeds; "
                                                   "2,000 stereo pairs to render, 6,000 frames"));
}

TEST(ForecastTest, AFrameTakesLongerOnThePublishedBaseAndWhereMoversAreFound) {
  const auto wall_s = [](const std::string& like,
                         const std::map<std::string, std::string>& options = {}) {
    const SystemSpec system{.name = "mine", .like = like, .options = options};
    return ForecastOf({{"s", "s.yaml", "live", system, 1}}, 2, Ahead()).wall_s;
  };
  EXPECT_GT(wall_s("orbslam2"), wall_s("plain") + 5);
  EXPECT_GT(wall_s("robust"), wall_s("plain") + 5);
  EXPECT_GT(wall_s("paper"), wall_s("orbslam2") + 5);
  EXPECT_EQ(wall_s("oracle"), wall_s("plain"));
  EXPECT_EQ(wall_s("plain", {{"dynamic.method", "robust"}}), wall_s("robust"));
  EXPECT_EQ(wall_s("robust", {{"dynamic.method", "none"}}), wall_s("plain"));
  EXPECT_EQ(wall_s("semantic", {{"base", "plain"}}), wall_s("plain"));
}

TEST(ForecastTest, EqualRunsAreDrivenOnce) {
  FramesOfRuns same = Ahead();
  same.key = [](const RunSpec&) { return std::string("one hall, nobody in it"); };
  SystemSpec foreign{.name = "mine"};
  foreign.external = ExternalSystem{.command = "mine {output}"};
  const std::vector<RunSpec> specs{{"a", "a.yaml", "empty", BuiltIn("plain"), 1},
                                   {"b", "b.yaml", "empty", BuiltIn("plain"), 1},
                                   {"a", "a.yaml", "empty", foreign, 1},
                                   {"b", "b.yaml", "empty", foreign, 1}};
  const Forecast forecast = ForecastOf(specs, 2, same);
  EXPECT_EQ(forecast.pairs, 500);
  EXPECT_EQ(forecast.system_frames, 3 * 500);  // a foreign system is asked each time
  EXPECT_EQ(forecast.answered, 1u);
  EXPECT_THAT(ToText(forecast), testing::HasSubstr(", 1 answered by another of equal inputs; "));
}

TEST(ForecastTest, WhatSystemsSteerThroughIsRenderedForEachAlone) {
  SystemSpec taught = BuiltIn("plain"), other = BuiltIn("robust");
  taught.name = "taught";
  taught.options["drive.taught"] = other.options["drive.taught"] = "true";
  SystemSpec late = taught;
  late.name = "late";
  late.options["drive.latency_ms"] = "50";
  const std::vector<RunSpec> specs{{"d", "d.yaml", "live", BuiltIn("plain"), 1},
                                   {"d", "d.yaml", "live", taught, 1},
                                   {"d", "d.yaml", "live", late, 1},
                                   {"d", "d.yaml", "live", other, 1}};
  const Forecast forecast = ForecastOf(specs, 2, Steered());
  // Four drives, and once the way that three are led along; two of them are taught the same.
  EXPECT_EQ(forecast.pairs, 5 * 500);
  EXPECT_EQ(forecast.system_frames, 6 * 500);
  EXPECT_NEAR(forecast.cache_bytes, ForecastOf({specs[0]}, 2, Ahead()).cache_bytes, 1);
  EXPECT_EQ(ForecastOf({specs[0]}, 2, Steered()).cache_bytes, 0);
}

TEST(ForecastTest, ARecordingIsDrivenAndNotRendered) {
  const Forecast forecast =
      ForecastOf({{"bag", "bag.mcap", "live", BuiltIn("plain"), 1}}, 2, Ahead());
  EXPECT_EQ(forecast.pairs, 0);
  EXPECT_EQ(forecast.cache_bytes, 0);
  EXPECT_EQ(forecast.system_frames, 500);
  const Forecast scene = ForecastOf({{"s", "s.yaml", "live", BuiltIn("plain"), 1}}, 2, Ahead());
  EXPECT_GT(forecast.wall_s, 0);
  EXPECT_LT(forecast.wall_s, scene.wall_s);
}

TEST(ExpectTimes, RenderingIsApartWhereItIsSharedAndPartOfADriveThatSteers) {
  const std::string nowhere = ::testing::TempDir() + "no_such_night";
  const RunSpec plain{"s", "s.yaml", "live", BuiltIn("plain"), 1};
  const RunSpec robust{"s", "s.yaml", "live", BuiltIn("robust"), 1};
  const RunSpec bag{"bag", "bag.mcap", "live", BuiltIn("plain"), 1};
  const ExpectedTimes shared = ExpectTimes({plain, robust, bag}, nowhere, Ahead());
  EXPECT_GT(shared.at(RunId(plain)).render_s, 0);
  EXPECT_EQ(shared.at(RunId(plain)).render_s, shared.at(RunId(robust)).render_s);
  EXPECT_GT(shared.at(RunId(robust)).drive_s, shared.at(RunId(plain)).drive_s);
  EXPECT_EQ(shared.at(RunId(bag)).render_s, 0);
  const ExpectedTime own = ExpectTimes({plain}, nowhere, Steered()).at(RunId(plain));
  EXPECT_EQ(own.render_s, 0);
  EXPECT_NEAR(own.drive_s, shared.at(RunId(plain)).drive_s + shared.at(RunId(plain)).render_s,
              1e-9);
}

TEST(ForecastTest, WhatIsKeptFromBeforeIsNotRenderedAgain) {
  FramesOfRuns ahead = Ahead();
  ahead.kept = [](const std::string& key) { return std::int64_t{key == "s live 1" ? 200 : 900}; };
  const RunSpec some{"s", "s.yaml", "live", BuiltIn("plain"), 1};
  const RunSpec all{"s", "s.yaml", "empty", BuiltIn("plain"), 1};
  const Forecast forecast = ForecastOf({some, all}, 2, ahead);
  EXPECT_EQ(forecast.pairs, 300);
  EXPECT_EQ(forecast.cache_bytes, ForecastOf({some, all}, 2, Ahead()).cache_bytes);
  const std::string nowhere = ::testing::TempDir() + "no_such_night";
  const ExpectedTimes times = ExpectTimes({some, all}, nowhere, ahead);
  EXPECT_EQ(times.at(RunId(all)).render_s, 0);
  EXPECT_NEAR(times.at(RunId(some)).render_s,
              ExpectTimes({some}, nowhere, Ahead()).at(RunId(some)).render_s * 300 / 500, 1e-9);
}

}  // namespace
}  // namespace aisle
