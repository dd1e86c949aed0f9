#include "simulator/sensor/auto_exposure.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

namespace aisle::sim {
namespace {

const AutoExposureOptions kAuto{.on = true, .target_grey = 100, .longest_ms = 10};

double MeanGrey(const cv::Mat1f& light, double white_per_ms, const ExposureSetting& setting) {
  double sum = 0;
  for (const float value : light) {
    sum += std::min(255.0, 255 * white_per_ms * setting.time_ms * setting.gain * value);
  }
  return sum / static_cast<double>(light.total());
}

TEST(AutoExposure, TheMeanIsTheTarget) {
  cv::Mat1f light(60, 94);
  cv::randu(light, 0.0f, 1.0f);
  const ExposureSetting setting = ChooseExposure(light, 0.3, Tone::kLinear, kAuto);
  EXPECT_EQ(setting.gain, 1);
  EXPECT_NEAR(MeanGrey(light, 0.3, setting), 100, 0.1);
}

TEST(AutoExposure, ALampInViewDoesNotDarkenTheHall) {
  cv::Mat1f light(60, 94, 0.2f);
  const double without = ChooseExposure(light, 0.5, Tone::kLinear, kAuto).time_ms;
  light.rowRange(0, 2) = 500.0f;
  const double with = ChooseExposure(light, 0.5, Tone::kLinear, kAuto).time_ms;
  EXPECT_LT(with, without);
  EXPECT_GT(with, 0.9 * without);
}

TEST(AutoExposure, ADarkThingBeforeABrightHallDoesNotWashItOut) {
  cv::Mat1f light(60, 94, 0.4f);
  light.colRange(0, 60) = 0.001f;
  EXPECT_NEAR(MeanGrey(light, 0.3, ChooseExposure(light, 0.3, Tone::kLinear, kAuto)),
              255 * 34.0 / 94, 1);
}

TEST(AutoExposure, WhatIsAboveTheMeteredRowsDoesNotCount) {
  cv::Mat1f street(60, 94, 0.05f), sky = street.clone();
  sky.rowRange(0, 30) = 3.0f;
  AutoExposureOptions lower = kAuto;
  lower.meter_from = 0.5f;
  EXPECT_LT(ChooseExposure(sky, 0.5, Tone::kLinear, kAuto).time_ms,
            ChooseExposure(street, 0.5, Tone::kLinear, kAuto).time_ms);
  EXPECT_EQ(ChooseExposure(sky, 0.5, Tone::kLinear, lower).time_ms,
            ChooseExposure(street, 0.5, Tone::kLinear, kAuto).time_ms);
}

TEST(AutoExposure, GainComesWhenTimeHasReachedItsLimitAndInTheSensorsSteps) {
  const cv::Mat1f light(60, 94, 0.1f);
  const double white_per_ms = 100.0 / 255 / 0.1 / 23;  // 23 ms at gain 1 would do
  const ExposureSetting setting = ChooseExposure(light, white_per_ms, Tone::kLinear, kAuto);
  EXPECT_EQ(setting.gain, 2.3125f);
  EXPECT_LE(setting.time_ms, 10);
  EXPECT_NEAR(MeanGrey(light, white_per_ms, setting), 100, 0.1);
}

TEST(AutoExposure, InTheDarkItStopsAtItsLimits) {
  const ExposureSetting setting = ChooseExposure(cv::Mat1f(60, 94, 0.0f), 1, Tone::kLinear, kAuto);
  EXPECT_EQ(setting.time_ms, 10);
  EXPECT_EQ(setting.gain, 4);
}

TEST(AutoExposure, StepsBelowWhatItWouldChooseAndByWholeStepsAlone) {
  AutoExposureOptions steps = kAuto;
  steps.step_ev = 0.5;
  std::set<double> settings;
  for (int k = 0; k < 60; ++k) {
    const cv::Mat1f light(60, 94, static_cast<float>(0.5 * std::exp2(0.05 * k)));  // three stops
    const ExposureSetting any = ChooseExposure(light, 0.3, Tone::kLinear, kAuto),
                          stepped = ChooseExposure(light, 0.3, Tone::kLinear, steps);
    const double less = std::log2(any.time_ms * any.gain / (stepped.time_ms * stepped.gain));
    EXPECT_GE(less, -1e-9);
    EXPECT_LT(less, 0.5);
    const double stops = std::log2(stepped.time_ms * stepped.gain / steps.shortest_ms);
    EXPECT_NEAR(stops / steps.step_ev, std::round(stops / steps.step_ev), 1e-6);
    settings.insert(stepped.time_ms * stepped.gain);
  }
  EXPECT_GE(settings.size(), 6U);
  EXPECT_LE(settings.size(), 7U);
}

TEST(AutoExposure, ValidateNamesTheBrokenRule) {
  EXPECT_EQ(AutoExposureOptions{}.Validate(), "");
  EXPECT_THAT(AutoExposureOptions{.target_grey = 300}.Validate(), testing::HasSubstr("300"));
  EXPECT_THAT(AutoExposureOptions{.meter_from = 1}.Validate(), testing::HasSubstr("meter_from"));
  EXPECT_THAT(AutoExposureOptions{.step_ev = -1}.Validate(), testing::HasSubstr("step_ev is -1"));
  EXPECT_THAT(AutoExposureOptions{.longest_ms = 0.01}.Validate(), testing::HasSubstr("longest_ms"));
}

}  // namespace
}  // namespace aisle::sim
