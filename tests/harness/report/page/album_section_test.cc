#include "harness/report/page/album_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aisle {
namespace {

using testing::HasSubstr;
using testing::Not;

RunRecord Shown(const std::string& system, std::uint64_t seed, double ate_m) {
  RunRecord run;
  run.spec = {.scene = "a/b", .scene_file = "", .system = BuiltIn(system), .seed = seed};
  run.scores["ate_rmse_m"].value = ate_m;
  run.artifacts["picture_0000"] = fmt::format("runs/{}/{}/frame_000012.jpg", system, seed);
  run.artifacts["picture_0001"] =
      fmt::format("runs/{}/{}/frame_000020_worst_error.jpg", system, seed);
  return run;
}

TEST(AlbumSectionTest, ShowsTheWorstSeedThatHasFrames) {
  const RunRecord calm = Shown("robust", 1, 0.1), bad = Shown("robust", 2, 0.5);
  RunRecord bare = Shown("robust", 3, 0.9);
  bare.artifacts.clear();
  const SceneRuns scene{"a/b", "live", {{"robust", 4, {&calm, &bad, &bare}}}};
  const std::string text = AlbumSection(scene, "/nowhere", "../");
  EXPECT_THAT(text, HasSubstr("its worst: seed 2"));
  EXPECT_THAT(text, HasSubstr("<img src=\"../runs/robust/2/frame_000012.jpg\""));
  EXPECT_THAT(text, HasSubstr("frame 20; worst error"));
  EXPECT_THAT(text, Not(HasSubstr("robust/1/")));
}

TEST(AlbumSectionTest, OnesOwnSystemComesFirst) {
  const RunRecord ours = Shown("robust", 1, 0.9);
  RunRecord mine = Shown("mine", 1, 0.1);
  mine.spec.system = {.name = "mine", .external = ExternalSystem{.command = "mine"}};
  const SceneRuns scene{"a/b", "live", {{"robust", 4, {&ours}}, {"mine", 7, {&mine}}}};
  const std::string text = AlbumSection(scene, "/nowhere", "");
  EXPECT_LT(text.find("data-system=\"mine\""), text.find("data-system=\"robust\""));
}

TEST(AlbumSectionTest, WithoutFramesThereIsNothing) {
  RunRecord bare = Shown("robust", 3, 0.9);
  bare.artifacts.clear();
  EXPECT_EQ(AlbumSection({"a/b", "live", {{"robust", 4, {&bare}}}}, "/nowhere", ""), "");
}

TEST(PictureOfTest, ReadsFrameAndLeadFromTheName) {
  EXPECT_EQ(PictureOf("runs/x/frame_000123.jpg")->frame, 123u);
  EXPECT_EQ(PictureOf("runs/x/frame_000123.jpg")->lead, "");
  EXPECT_EQ(PictureOf("frame_000007_worst_error_most_movers.jpg")->lead, "worst error most movers");
  EXPECT_FALSE(PictureOf("runs/x/film.mp4").has_value());
  EXPECT_FALSE(PictureOf("frame_x.jpg").has_value());
}

}  // namespace
}  // namespace aisle
