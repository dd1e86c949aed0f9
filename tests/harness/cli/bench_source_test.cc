#include "harness/cli/bench_source.h"

#include <gtest/gtest.h>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

TEST(ParseViewTest, ASceneIsFoundByItsName) {
  const BenchView whole = ParseView("paper/scene2");
  EXPECT_TRUE(whole.path.ends_with("scenes/paper/scene2.yaml")) << whole.path;
  EXPECT_EQ(whole.scene, "paper/scene2");
  EXPECT_TRUE(whole.assets_dir.ends_with("assets")) << whole.assets_dir;
  EXPECT_EQ(whole.from, 0);
  EXPECT_EQ(whole.to, std::numeric_limits<int>::max());
}

TEST(ParseViewTest, AStretchHasItsFirstFrameAndTheOneAfterItsLast) {
  const BenchView view = ParseView("paper/scene2:90-130");
  EXPECT_EQ(view.text, "paper/scene2:90-130");
  EXPECT_EQ(view.scene, "paper/scene2");
  EXPECT_EQ(view.from, 90);
  EXPECT_EQ(view.to, 130);
}

TEST(ParseViewTest, AFolderIsARecording) {
  const BenchView view = ParseView(AISLE_SOURCE_DIR "/tests:3-5");
  EXPECT_EQ(view.path, AISLE_SOURCE_DIR "/tests");
  EXPECT_EQ(view.scene, "");
  EXPECT_EQ(view.to, 5);
}

TEST(ParseViewTest, WhatIsNoStretchIsRefused) {
  for (const char* text :
       {"paper/scene2:", "paper/scene2:5", "paper/scene2:9-3", "paper/scene2:-1-3",
        "paper/scene2:1-3x", "paper/scene22", "nowhere/at/all:1-2"}) {
    EXPECT_THROW(ParseView(text), InputError) << text;
  }
}

TEST(SourceOptionsTest, DefaultsAreTheBenchsAndArgumentsReplaceThem) {
  BenchSource source{.format = "kitti", .twin = "empty"};
  CLI::App app;
  AddSourceOptions(&app, &source);
  app.parse("--seed 7 --threads 2");
  EXPECT_EQ(source.format, "kitti");
  EXPECT_EQ(source.twin, "empty");
  EXPECT_EQ(source.seed, 7u);
  EXPECT_EQ(source.threads, 2);
  EXPECT_THROW(app.parse("--format tum"), CLI::ParseError);
}

}  // namespace
}  // namespace aisle
