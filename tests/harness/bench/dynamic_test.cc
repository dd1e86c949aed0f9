#include "harness/bench/dynamic.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace aisle {
namespace {

/// Ten frames of 1000 pixels, of which 400 move; 300 of these were rejected, and 96 at rest.
DynamicOfView Stretch() {
  DynamicOfView view;
  view.frames = 10;
  view.pixels = 10000;
  view.rejected = 396;
  view.masks.true_positives = 300;
  view.masks.false_negatives = 100;
  view.masks.false_positives = 96;
  view.stage_ms = {{"dynamic", 50}};
  return view;
}

TEST(DynamicOfViewTest, SharesAreOfAllPixelsAndOfThoseAtRest) {
  EXPECT_DOUBLE_EQ(Stretch().rejected_share(), 396.0 / 10000);
  EXPECT_DOUBLE_EQ(Stretch().static_wrong(), 96.0 / 9600);
  EXPECT_DOUBLE_EQ(Stretch().mean_ms().at("dynamic"), 5);
}

TEST(DynamicOfViewTest, StretchesAddUpByTheirPixelsNotByTheirShares) {
  DynamicOfView quiet;
  quiet.frames = 30;
  quiet.pixels = 30000;
  quiet.has_truth = true;
  quiet.stage_ms = {{"dynamic", 30}, {"track", 60}};
  DynamicOfView both = Stretch();
  both += quiet;
  EXPECT_EQ(both.frames, 40);
  EXPECT_TRUE(both.has_truth);
  EXPECT_DOUBLE_EQ(both.rejected_share(), 396.0 / 40000);
  EXPECT_DOUBLE_EQ(both.mean_ms().at("dynamic"), 2);
  EXPECT_DOUBLE_EQ(both.mean_ms().at("track"), 1.5);
}

TEST(DynamicOfViewTest, NothingSeenIsNoDivisionByZero) {
  EXPECT_EQ(DynamicOfView().rejected_share(), 0);
  EXPECT_EQ(DynamicOfView().static_wrong(), 0);
  EXPECT_TRUE(DynamicOfView().mean_ms().empty());
}

TEST(DynamicPicturesTest, EachSeedHasItsOwn) {
  const std::filesystem::path out =
      std::filesystem::temp_directory_path() / fmt::format("aisle_pictures_{}", ::getpid());
  BenchView view{.text = "smoke/bits",
                 .path = AISLE_SOURCE_DIR "/scenes/smoke/bits.yaml",
                 .scene = "smoke/bits",
                 .assets_dir = AISLE_SOURCE_DIR "/assets",
                 .to = 1};
  DynamicBenchOptions options;
  options.system = BuiltIn("plain");
  options.out = out;
  for (const std::uint64_t seed : {1, 2}) {
    view.seed = seed;
    MeasureDynamic(view, options);
  }
  EXPECT_TRUE(std::filesystem::exists(out / "smoke_bits@1_00000.jpg"));
  EXPECT_TRUE(std::filesystem::exists(out / "smoke_bits@2_00000.jpg"));
  std::filesystem::remove_all(out);
}

}  // namespace
}  // namespace aisle
