#include "harness/cli/bench_source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

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

TEST(ParseViewTest, ARecordingMayHaveAnyName) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::path(testing::TempDir()) / "names";
  for (const char* name : {"aisle@lab", "12:30", "12:30-31", "run@3:1-2"}) {
    const std::string path = (folder / name).string();
    fs::create_directories(path);
    const BenchView whole = ParseView(path), part = ParseView(path + ":3-5");
    EXPECT_EQ(whole.path, path);
    EXPECT_EQ(whole.from, 0);
    EXPECT_EQ(part.path, path);
    EXPECT_EQ(part.from, 3);
    EXPECT_EQ(part.to, 5);
    EXPECT_FALSE(part.seed);
    EXPECT_THROW(ParseView(path + ":5-3"), InputError);
    EXPECT_THROW(ParseView(path + "@2"), InputError);
  }
  fs::remove_all(folder);
}

TEST(ParseViewTest, WhatIsNoStretchIsRefused) {
  for (const char* text :
       {"paper/scene2:", "paper/scene2:5", "paper/scene2:9-3", "paper/scene2:-1-3",
        "paper/scene2:1-3x", "paper/scene2: 1-3", "paper/scene2:1-+3", "paper/scene2:1-99999999999",
        "paper/scene2@", "paper/scene2:1-3@x", "paper/scene2@1:1-3", "paper/scene22",
        "nowhere/at/all:1-2"}) {
    EXPECT_THROW(ParseView(text), InputError) << text;
  }
}

TEST(ParseViewTest, ASceneMayNameItsSeed) {
  const BenchView view = ParseView("paper/scene2:90-130@4");
  EXPECT_EQ(view.text, "paper/scene2:90-130@4");
  EXPECT_EQ(view.to, 130);
  EXPECT_EQ(view.seed, 4u);
  EXPECT_EQ(ParseView("paper/scene2@12").seed, 12u);
  EXPECT_FALSE(ParseView("paper/scene2").seed);
  EXPECT_THROW(ParseView(AISLE_SOURCE_DIR "/tests:3-5@2"), InputError);
}

TEST(ReadViewsTest, ReadsOneALineAndNamesTheLineThatIsWrong) {
  const std::string file = testing::TempDir() + "views.txt";
  std::ofstream(file) << "# two\n\npaper/scene2:1-3@2\npaper/scene3  \n";
  const std::vector<BenchView> views = ReadViews(file);
  ASSERT_EQ(views.size(), 2u);
  EXPECT_EQ(views[0].seed, 2u);
  EXPECT_EQ(views[1].text, "paper/scene3");
  std::ofstream(file) << "paper/scene2\npaper/scene2:9\n";
  try {
    ReadViews(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("views.txt:2: paper/scene2:9"), std::string::npos)
        << error.what();
  }
  std::ofstream(file) << "# nothing\n";
  EXPECT_THROW(ReadViews(file), InputError);
}

/// The last view of many is told before the first is measured.
TEST(ReadViewsTest, AStretchBeyondItsSceneIsToldWithItsLine) {
  const std::string file = testing::TempDir() + "beyond.txt";
  std::ofstream(file) << "paper/scene2:1-3\nsmoke/short:10-99\n";
  try {
    ReadViews(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("beyond.txt:2: smoke/short:10-99: it ends before"),
              std::string::npos)
        << error.what();
  }
  EXPECT_NO_THROW(ParseView("smoke/short:10-40"));
}

TEST(ReadViewsTest, EveryStretchOfTheTreeIsOne) {
  for (const auto& entry :
       std::filesystem::directory_iterator(AISLE_SOURCE_DIR "/scenes/stretches")) {
    EXPECT_NO_THROW(ReadViews(entry.path())) << entry.path();
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
