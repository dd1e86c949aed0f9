#include "harness/report/page/stage_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;

TEST(StageSection, ShowsTheSheetsOfTheRunThatHasThem) {
  RunRecord plain;
  plain.spec = {.scene = "a/b", .scene_file = "", .system = BuiltIn("paper"), .seed = 1};
  RunRecord drawn = plain;
  drawn.spec.seed = 2;
  drawn.artifacts = {{"stages_000031", "runs/x/stages/000031.jpg"},
                     {"stages_film", "runs/x/stages.mp4"}};
  const SceneRuns without{"a/b", "live", {{"paper", 2, {&plain}}}};
  const SceneRuns with{"a/b", "live", {{"paper", 2, {&plain, &drawn}}}};
  EXPECT_EQ(StageSection(without, "/nowhere", ""), "");
  const std::string text = StageSection(with, "/nowhere", "../");
  EXPECT_THAT(text, HasSubstr("<img src=\"../runs/x/stages/000031.jpg\""));
  EXPECT_THAT(text, HasSubstr("href=\"../runs/x/stages.mp4\""));
  EXPECT_THAT(text, HasSubstr("Frame 31"));
  EXPECT_THAT(text, HasSubstr("Seed 2"));
}

TEST(IsStageSheet, TellsSheetsFromFilmsAndPictures) {
  EXPECT_TRUE(IsStageSheet("stages_000123"));
  EXPECT_FALSE(IsStageSheet("stages_film"));
  EXPECT_FALSE(IsStageSheet("stages_"));
  EXPECT_FALSE(IsStageSheet("picture_01"));
}

}  // namespace
}  // namespace aisle
