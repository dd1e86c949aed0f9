#include "harness/report/picture/stage_sheets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

StagePicture Plain(const std::string& name, unsigned char grey, cv::Size size = {40, 30}) {
  return {name, cv::Mat3b(size, cv::Vec3b(grey, grey, grey))};
}

TEST(TileStages, StandInRowsInTheirOrder) {
  const cv::Mat3b sheet = TileStages(
      {Plain("a", 10), Plain("b", 20), Plain("c", 30), Plain("d", 40), Plain("e", 50)}, 3);
  ASSERT_EQ(sheet.size(), cv::Size(120, 60));
  EXPECT_EQ(sheet(15, 20)[0], 10);
  EXPECT_EQ(sheet(15, 60)[0], 20);
  EXPECT_EQ(sheet(15, 100)[0], 30);
  EXPECT_EQ(sheet(45, 20)[0], 40);
  EXPECT_EQ(sheet(45, 60)[0], 50);
  EXPECT_TRUE(TileStages({}).empty());
  EXPECT_THROW(TileStages({Plain("a", 10), Plain("b", 20, {41, 30})}), std::invalid_argument);
}

TEST(WorstFrames, AreTheLargestApartFromEachOtherAndNeverGoodOnes) {
  std::map<std::size_t, double> wrong;
  for (std::size_t k = 0; k < 100; ++k) wrong[k] = 0;
  wrong[20] = 9, wrong[21] = 10, wrong[22] = 8, wrong[60] = 3, wrong[70] = 5, wrong[90] = 1;
  EXPECT_THAT(WorstFrames(wrong, 6, 5), ElementsAre(21, 60, 70, 90));
  EXPECT_THAT(WorstFrames(wrong, 2, 5), ElementsAre(21, 70));
  EXPECT_THAT(WorstFrames(wrong, 6, 11), ElementsAre(21, 70, 90));
  EXPECT_THAT(WorstFrames({}, 6, 5), IsEmpty());
}

class StageSheetsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_sheets_{}", ::getpid());
  }
  void TearDown() override { fs::remove_all(folder_); }

  static FrameFacts Wrong(std::int64_t pixels) {
    FrameFacts facts;
    facts.mask.emplace();
    facts.mask->false_positives = pixels;
    return facts;
  }
  static FrameEstimate Drawn(const StageDrawer& drawer) {
    FrameEstimate estimate;
    estimate.draw_stages = drawer;
    return estimate;
  }

  fs::path folder_;
};

TEST_F(StageSheetsTest, LeaveASheetAFrameAndNameTheWorst) {
  StageSheets sheets({.folder = folder_, .film = false, .worst = 1, .apart = 1});
  const auto drawer = [](const FrameTruth*) { return std::vector{Plain("a", 10)}; };
  for (std::size_t k = 0; k < 3; ++k) {
    sheets.See(k, nullptr, Drawn(drawer), Wrong(k == 1 ? 50 : 10));
    EXPECT_TRUE(fs::exists(folder_ / StageSheetName(k)));
  }
  const auto shown = sheets.Finish();
  ASSERT_EQ(shown.size(), 1U);
  EXPECT_EQ(shown.at("stages_000001"), "stages/000001.jpg");
  EXPECT_EQ(sheets.trouble(), "");
}

TEST_F(StageSheetsTest, ADrawingThatFailsEndsTheDrawingAlone) {
  StageSheets sheets({.folder = folder_, .film = false});
  int drawn = 0;
  const auto drawer = [&](const FrameTruth*) -> std::vector<StagePicture> {
    if (++drawn == 2) throw std::runtime_error("no ink");
    return {Plain("a", 10)};
  };
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NO_THROW(sheets.See(k, nullptr, Drawn(drawer), Wrong(5)));
  }
  EXPECT_EQ(drawn, 2);
  EXPECT_THAT(sheets.trouble(), HasSubstr("frame 1 only: no ink"));
  EXPECT_TRUE(fs::exists(folder_ / StageSheetName(0)));
  EXPECT_EQ(sheets.Finish().count("stages_000000"), 1U);
}

TEST_F(StageSheetsTest, SystemsThatDrawNothingLeaveNothing) {
  StageSheets sheets({.folder = folder_, .film = true});
  sheets.See(0, nullptr, {}, Wrong(5));
  sheets.See(1, nullptr, Drawn([](const FrameTruth*) { return std::vector<StagePicture>{}; }),
             Wrong(5));
  EXPECT_THAT(sheets.Finish(), IsEmpty());
  EXPECT_FALSE(fs::exists(folder_));
}

}  // namespace
}  // namespace aisle
