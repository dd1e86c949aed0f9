#include "harness/cli/search_axes.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "harness/io/input_error.h"

namespace aisle {
namespace {

std::string FileOf(const std::string& text) {
  const std::string file = testing::TempDir() + "axes.txt";
  std::ofstream(file) << text;
  return file;
}

TEST(ReadAxesTest, ALineIsAnOptionWithItsEnds) {
  const std::vector<SearchAxis> axes =
      ReadAxes(FileOf("# what is tried\n\ndynamic.paper.spread.points 300 1500 ratio\n"
                      "dynamic.paper.epipolar.beta 0 0.03\n"),
               "paper");
  ASSERT_EQ(axes.size(), 2u);
  EXPECT_EQ(axes[0].path, "dynamic.paper.spread.points");
  EXPECT_TRUE(axes[0].integer && axes[0].even_ratios);
  EXPECT_EQ(axes[0].high, 1500);
  EXPECT_FALSE(axes[1].integer || axes[1].even_ratios);
}

TEST(ReadAxesTest, WhatIsNoneIsRefusedWithItsLine) {
  for (const char* line :
       {"dynamic.paper.spread.points", "dynamic.paper.spread.points 300",
        "dynamic.paper.spread.points 300 200", "dynamic.paper.spread.points 1 200",
        "dynamic.paper.epipolar.beta 0 1 ratio", "dynamic.paper.epipolar.beta 0 1 steps",
        "dynamic.paper.epipolar.beta 0 1 ratio 3", "no.such.option 0 1",
        "dynamic.robust.field.memory 0 1", "dynamic.method 0 1"}) {
    try {
      ReadAxes(FileOf(std::string("# one\n") + line + "\n"), "paper");
      FAIL() << line;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("axes.txt:2: "), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(ReadAxes(FileOf("# nothing\n"), "paper"), InputError);
  const std::string twice = "dynamic.paper.epipolar.beta 0 1\n";
  EXPECT_THROW(ReadAxes(FileOf(twice + twice), "paper"), InputError);
}

TEST(ReadAxesTest, EverySearchOfTheTreeIsOne) {
  int files = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(AISLE_SOURCE_DIR "/scenes/searches")) {
    EXPECT_FALSE(ReadAxes(entry.path(), "paper").empty()) << entry.path();
    ++files;
  }
  EXPECT_GT(files, 0);
}

TEST(ParseNamedSetTest, ANameAndItsOptions) {
  const NamedSet set = ParseNamedSet(
      "strict:dynamic.paper.fundamental.standing_flow_px=0,dynamic.paper.mark.min_rays=3", "paper");
  EXPECT_EQ(set.name, "strict");
  EXPECT_EQ(set.options.size(), 2u);
  EXPECT_EQ(set.options.at("dynamic.paper.mark.min_rays"), "3");
  EXPECT_TRUE(ParseNamedSet("as_it_is:", "paper").options.empty());
  for (const char* text : {"strict", ":a=1", "strict:dynamic.paper.mark.min_rays",
                           "strict:dynamic.paper.mark.min_rays=9", "strict:nothing=1"}) {
    EXPECT_THROW(ParseNamedSet(text, "paper"), InputError) << text;
  }
}

}  // namespace
}  // namespace aisle
