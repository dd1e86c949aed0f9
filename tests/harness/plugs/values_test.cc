#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "harness/io/input_error.h"
#include "harness/io/places.h"
#include "harness/plugs/simulated_frame.h"
#include "harness/plugs/slam_values.h"
#include "harness/plugs/stage_bits.h"
#include "harness/plugs/steering_options.h"
#include "slam/stereo_slam.h"

namespace aisle {
namespace {

TEST(SteeringOptions, WhatIsDescribedIsReadBackAsTheSame) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> ms(0, 10'000);
  for (int round = 0; round < 300; ++round) {
    Steering steering;
    steering.latency_ms = round % 3 ? ms(random) : 62.5;
    for (int i = 0; i < round % 5; ++i) steering.latency_profile_ms.push_back(ms(random));
    steering.queue = static_cast<QueueRule>(round % 3);
    steering.scanner = round % 2;
    steering.steered_by_truth = round / 2 % 2;
    steering.taught = round % 3 == 1;
    if (round / 3 % 3 > 0) steering.driver = static_cast<SteeringLaw>(round / 3 % 3 - 1);
    OptionTexts texts;
    for (const SystemOption& option : DescribeSteering(steering)) {
      EXPECT_TRUE(IsSteeringOption(option.path));
      EXPECT_EQ(CheckSteeringOption(option.path, option.value), "") << option.path;
      texts[option.path] = option.value;
    }
    EXPECT_EQ(SteeringOf(texts), steering);
    texts["feature.features"] = "800";
    EXPECT_EQ(SteeringOf(texts), steering) << "the others are none of its business";
    EXPECT_THAT(WithoutSteering(texts),
                testing::ElementsAre(testing::Pair("feature.features", "800")));
  }
  EXPECT_EQ(SteeringOf({}), Steering{});
}

TEST(SteeringOptions, SpeakOfChoicesInTheWordsOfFiles) {
  const Steering steering = SteeringOf({{"drive.queue", "pipeline"}, {"drive.driver", "kanayama"}});
  EXPECT_EQ(steering.queue, QueueRule::kPipeline);
  EXPECT_EQ(steering.driver, SteeringLaw::kKanayama);
  EXPECT_EQ(SteeringOf({{"drive.queue", "drop"}}).queue, QueueRule::kDrop);
  EXPECT_EQ(SteeringOf({{"drive.queue", "newest"}}).queue, QueueRule::kNewest);
  EXPECT_EQ(SteeringOf({{"drive.driver", "pure_pursuit"}}).driver, SteeringLaw::kPurePursuit);
  EXPECT_EQ(SteeringOf({{"drive.driver", "scene"}}).driver, std::nullopt);
  EXPECT_EQ(CheckSteeringOption("drive.latency_ms", "x"),
            "option 'drive.latency_ms' cannot be 'x': expected a number in [0, 10000]");
}

TEST(SteeringOptions, RefuseWhatTheyCannotBeAndSayWhatTheyCan) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"drive.latency_ms", "-1"},        {"drive.latency_ms", "10001"},
      {"drive.latency_ms", "nan"},       {"drive.latency_ms", "5 "},
      {"drive.latency_ms", ""},          {"drive.latency_profile_ms", "5,,6"},
      {"drive.latency_profile_ms", "x"}, {"drive.queue", "oldest"},
      {"drive.scanner", "yes"},          {"drive.steered_by_truth", "1"},
      {"drive.taught", "yes"},           {"drive.driver", ""},
      {"drive.driver", "carrot"},        {"drive.drivers", "scene"}};
  for (const auto& [path, value] : wrong) {
    const std::string message = CheckSteeringOption(path, value);
    EXPECT_THAT(message, testing::HasSubstr(path)) << value;
    EXPECT_THROW(SteeringOf({{path, value}}), InputError) << path << "=" << value;
  }
  EXPECT_THAT(CheckSteeringOption("drive.latency", "1"), testing::HasSubstr("drive.latency_ms"));
}

TEST(SlamValues, CarryEveryNumberOver) {
  const slam::StereoCamera camera = CameraFrom({752, 480, 435.2, 436.1, 367.3, 252.4, 0.125});
  EXPECT_EQ(camera.width, 752);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(camera.fx, 435.2);
  EXPECT_EQ(camera.fy, 436.1);
  EXPECT_EQ(camera.cx, 367.3);
  EXPECT_EQ(camera.cy, 252.4);
  EXPECT_EQ(camera.baseline_m, 0.125);
  slam::DynamicRegions found;
  found.mask = cv::Mat1b::eye(4, 5);
  found.regions.resize(2);
  found.regions[1].id = 9;
  found.regions[1].box = {1, 2, 3, 4};
  found.regions[1].evidence = 0.625f;
  const DynamicRegions regions = RegionsFrom(found);
  EXPECT_EQ(cv::norm(regions.mask, found.mask, cv::NORM_INF), 0);
  ASSERT_EQ(regions.regions.size(), 2u);
  EXPECT_EQ(regions.regions[1].id, 9);
  EXPECT_EQ(cv::Rect2d(regions.regions[1].box), cv::Rect2d(1, 2, 3, 4));
  EXPECT_EQ(regions.regions[1].evidence, 0.625f);
}

std::map<std::string, std::string> ValuesOf(const slam::SlamOptions& options) {
  std::map<std::string, std::string> values;
  for (const slam::OptionDescription& option : slam::DescribeOptions(options)) {
    values[option.path] = option.value;
  }
  return values;
}

/// The base sets many options at once; those that are named depart from it, however the words of
/// the command line are ordered (by name `base` comes before some and after others).
TEST(SlamValues, AnOptionNamedBesideABaseDepartsFromThatBase) {
  const auto base = ValuesOf(SlamOptionsFrom({{"base", "orbslam2"}}));
  const auto plain = ValuesOf(SlamOptionsFrom({}));
  ASSERT_NE(base, plain);
  int departed = 0;
  for (const auto& [path, value] : base) {
    const std::string other = plain.at(path);
    if (path == "base" || other == value) continue;
    std::map<std::string, std::string> expected = base;
    expected[path] = other;
    EXPECT_EQ(ValuesOf(SlamOptionsFrom({{"base", "orbslam2"}, {path, other}})), expected) << path;
    ++departed;
  }
  EXPECT_GT(departed, 3);
}

TEST(SlamValues, WhatCannotBeSetIsNamedAndChangesNothingElse) {
  slam::SlamOptions options;
  EXPECT_THAT(SetSlamOptions({{"feature.features", "many"}}, &options),
              testing::HasSubstr("feature.features"));
  EXPECT_EQ(ValuesOf(options), ValuesOf({}));
  EXPECT_THROW(SlamOptionsFrom({{"no.such", "1"}}), InputError);
}

/// Same inputs, same bits: of every stage, with one thread and with two, alone and among others.
TEST(StageBits, AreThoseOfTheSceneAndOfNothingElse) {
  StageBitsOptions options{.scene_file = SceneFile("smoke/bits"),
                           .assets_dir = AssetsDir().string()};
  options.threads = 1;
  options.hashed_frames = 1;
  options.light_spacing = 12;
  options.drive = false;
  const auto text = [](const std::vector<StageBits>& bits) {
    std::string all;
    for (const StageBits& one : bits) all += fmt::format("{} {:x}\n", one.stage, one.hash);
    return all;
  };
  const std::string one = text(HashStages(options));
  EXPECT_THAT(one, testing::HasSubstr("\n"));
  options.threads = 2;
  EXPECT_EQ(text(HashStages(options)), one);
  options.hashed_frames = 2;
  EXPECT_NE(text(HashStages(options)), one) << "more frames are other bits";
  options.scene_file = "no/such/scene.yaml";
  EXPECT_THROW(HashStages(options), InputError);
}

}  // namespace
}  // namespace aisle
