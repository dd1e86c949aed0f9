#include "harness/record/record.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "harness/io/input_error.h"
#include "harness/record/frames_csv.h"
#include "harness/record/units.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class RecordTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / fmt::format("aisle_record_{}", ::getpid());
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(RecordTest, ResultsReadBackAsTheyWere) {
  Results results = MakeNight({.scenes = 1, .systems = {"oracle"}}, folder_);
  results.verdicts = {{.name = "a", .passed = true, .value = 0.01, .limit = 0.02, .why = "less"},
                      {.name = "b", .flaky = true, .why = "none", .scene = "s"}};
  const Results read = ResultsFromJson(ToJson(results), "x");
  EXPECT_EQ(ToJson(read), ToJson(results));
  const auto record = ReadRun(results.runs[0].spec, folder_);
  ASSERT_TRUE(record);
  EXPECT_EQ(ToJson(*record), ToJson(results.runs[0]));
}

TEST_F(RecordTest, AUnitThatIsNotTheScoresOwnIsAnError) {
  Results results = MakeNight({.scenes = 1, .systems = {"oracle"}}, folder_);
  EXPECT_NO_THROW(CheckUnits(results, "x"));
  Score& score = results.runs[0].scores.at("ate_rmse_m");
  score.unit = "mm";
  try {
    CheckUnits(results, "x");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("x: ate_rmse_m of the run "));
    EXPECT_THAT(error.what(), testing::HasSubstr("has the unit 'mm', which cannot be compared: "
                                                 "expected 'm'"));
  }
  score.value = {};
  EXPECT_NO_THROW(CheckUnits(results, "x")) << "nothing is held against anything";
}

TEST_F(RecordTest, ACountThatIsNoneIsSaidWithItsRunAndKey) {
  const std::string whole = ToJson(MakeNight({.scenes = 1, .systems = {"oracle"}}, folder_));
  const auto said = [&](const std::string& key, const std::string& value) {
    nlohmann::ordered_json json = nlohmann::ordered_json::parse(whole);
    json["runs"][0][key] = nlohmann::ordered_json::parse(value);
    try {
      ResultsFromJson(json.dump(), "x");
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const char* value : {"-1", "1.5", "1e300", "\"1\"", "[1]"}) {
    EXPECT_EQ(said("seed", value), fmt::format("x: not a results file: run 1: seed is {}, not a "
                                               "whole number in range",
                                               nlohmann::json::parse(value).dump()));
    EXPECT_NE(said("frames", value), "") << value;
  }
  EXPECT_NE(said("threads", "4294967297"), "");
  EXPECT_EQ(said("seed", "18446744073709551615"), "");
}

TEST_F(RecordTest, FramesReadBackAsTheyWere) {
  const RunResult run = MakeRun("a", "oracle", 1, 0.01);
  const std::vector<FrameRow> rows = MakeFrameRows(run, ScoreRun(run));
  EXPECT_EQ(ToCsv(FrameRowsFromCsv(ToCsv(rows), "x")), ToCsv(rows));
}

TEST_F(RecordTest, FramesOfAnotherVersionAreReadByTheirColumns) {
  const std::string shuffled =
      "process_ms,render_ms,frame,stamp_ns,state,movers_share,actors_share,features,"
      "features_on_movers,inliers_on_movers,of_tomorrow\n"
      "20.5,3,7,350000000,tracking,0.25,0.5,1200,3,1,x\n";
  const std::vector<FrameRow> rows = FrameRowsFromCsv(shuffled, "x");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].id, 7);
  EXPECT_EQ(rows[0].state, TrackingState::kTracking);
  EXPECT_EQ(rows[0].movers_share, 0.25);
  EXPECT_EQ(rows[0].process_ms, 20.5);
  EXPECT_FALSE(rows[0].difficulty.parallax_px);
  EXPECT_FALSE(rows[0].live_m);
}

TEST_F(RecordTest, ACountOfAFrameThatIsNoneIsSaidWithItsLine) {
  const RunResult run = MakeRun("a", "oracle", 1, 0.01);
  std::vector<FrameRow> rows = MakeFrameRows(run, ScoreRun(run));
  rows.resize(1);
  rows[0].corners_rejected = 123456789;
  std::string text = ToCsv(rows);
  text.insert(text.find("123456789"), "9e");  // 9e123456789, and no int holds the next
  EXPECT_THROW(FrameRowsFromCsv(text, "x"), InputError);
  text.replace(text.find("9e"), 2, "99");
  try {
    FrameRowsFromCsv(text, "x");
    ADD_FAILURE() << "read";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(),
                testing::HasSubstr("x:2: corners_rejected is '99123456789', expected a count"));
  }
}

}  // namespace
}  // namespace aisle
