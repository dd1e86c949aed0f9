#include "harness/bench/sensitivity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"

namespace aisle {
namespace {

using Kind = SystemOption::Kind;

SystemOption Robust(const std::string& path) {
  System robust{"robust", "", MaskSource::kNone, {{"dynamic.method", "robust"}}};
  for (const SystemOption& option : OptionsOf(robust)) {
    if (option.path == path) return option;
  }
  throw std::logic_error(path);
}

std::optional<std::string> Scaled(const std::string& path, double factor) {
  return ScaledValue(Robust(path), factor, BuiltIn("robust"));
}

TEST(ScaledValueTest, NumbersAreHalvedAndDoubledWithinTheirRange) {
  const double memory = std::stod(Robust("dynamic.robust.field.memory").value);
  EXPECT_EQ(std::stod(*Scaled("dynamic.robust.field.memory", 0.5)), memory / 2);
  EXPECT_EQ(std::stod(*Scaled("dynamic.robust.field.memory", 2)), 1);  // no share is larger
  EXPECT_EQ(std::stod(*Scaled("dynamic.robust.field.bias", 2)),
            2 * std::stod(Robust("dynamic.robust.field.bias").value));
}

TEST(ScaledValueTest, WholeNumbersGoToTheNearestThatTheRulesAllow) {
  // The side of a window is odd, the matcher's reach a multiple of 32.
  EXPECT_EQ(std::stoi(*Scaled("dynamic.robust.surface.window_px", 2)) % 2, 1);
  EXPECT_EQ(std::stoi(*Scaled("dynamic.robust.disparity.max_disparity_px", 0.5)) % 32, 0);
  EXPECT_LT(std::stoi(*Scaled("dynamic.robust.disparity.max_disparity_px", 0.5)), 96);
}

TEST(ScaledValueTest, NothingWhereTheValueStays) {
  SystemOption zero{.path = "dynamic.robust.field.bias",
                    .value = "0",
                    .unit = "",
                    .help = "",
                    .low = -10,
                    .high = 0,
                    .choices = {}};
  EXPECT_FALSE(ScaledValue(zero, 2, BuiltIn("robust")));
  SystemOption full{.path = "dynamic.robust.field.memory",
                    .value = "1",
                    .unit = "",
                    .help = "",
                    .low = 0,
                    .high = 1,
                    .choices = {}};
  EXPECT_FALSE(ScaledValue(full, 2, BuiltIn("robust")));
  EXPECT_EQ(ScaledValue(full, 0.5, BuiltIn("robust")), "0.5");
  const SystemOption flag{.path = "equal_columns",
                          .kind = Kind::kFlag,
                          .value = "false",
                          .unit = "",
                          .help = "",
                          .choices = {}};
  EXPECT_FALSE(ScaledValue(flag, 2, BuiltIn("robust")));
}

DynamicOfView Counted(int found, int invented, int missed) {
  DynamicOfView view;
  view.pixels = 1000;
  view.masks.objects_found = found;
  view.masks.objects_invented = invented;
  view.masks.objects_missed = missed;
  view.masks.true_positives = 60;
  view.masks.false_positives = 18;
  view.masks.false_negatives = 40;
  return view;
}

TEST(RejectionFiguresTest, F1IsTheHarmonicMeanOfPrecisionAndRecall) {
  const RejectionFigures figures = FiguresOf(Counted(6, 2, 4));
  const double precision = 6.0 / 8, recall = 6.0 / 10;
  EXPECT_DOUBLE_EQ(figures.object_f1, 2 * precision * recall / (precision + recall));
  EXPECT_DOUBLE_EQ(figures.pixel_iou, 60.0 / 118);
  EXPECT_DOUBLE_EQ(figures.static_loss, 18.0 / 900);
  EXPECT_EQ(FiguresOf(DynamicOfView()).object_f1, 0);
}

TEST(RejectionFiguresTest, TheDistanceIsThatOfTheFigureThatMovedFarthest) {
  const RejectionFigures base{0.9, 0.8, 0.01};
  EXPECT_EQ(Distance(base, base), 0);
  EXPECT_DOUBLE_EQ(Distance(base, {0.7, 0.85, 0.012}), 0.9 - 0.7);
  EXPECT_DOUBLE_EQ(Distance(base, {0.89, 0.85, 0.03}), 10 * (0.03 - 0.01));
}

TEST(SensitivityTableTest, ARowAnOptionWithBothChanges) {
  Sensitivity sensitivity;
  sensitivity.base = {0.9, 0.8, 0.01};
  OptionSensitivity one;
  one.option = {.path = "a.b", .value = "2", .unit = "", .help = "", .choices = {}};
  one.halved = {"1", {0.85, 0.81, 0.0125}};
  one.effect = 0.05;
  sensitivity.options = {one};
  const std::string table = ToMarkdown(sensitivity);
  EXPECT_THAT(table, testing::HasSubstr("F1 0.900, pixels' IoU 0.800, static pixels lost 1.00 %"));
  EXPECT_THAT(
      table, testing::HasSubstr("| `a.b` | 2 | 1 | -0.050 / +0.010 / +0.25 % | - | - | 0.050 |\n"));
}

TEST(SensitivityTest, APrefixThatNoOptionHasIsRefusedBeforeAnythingIsDriven) {
  SensitivityOptions options;
  options.prefix = "dynamic.robsut.";
  EXPECT_THROW(MeasureSensitivity({}, options), InputError);
}

}  // namespace
}  // namespace aisle
