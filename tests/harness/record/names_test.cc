#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <random>

#include "harness/io/file.h"
#include "harness/io/input_error.h"
#include "harness/record/frames_csv.h"
#include "harness/record/record.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::string RandomText(std::mt19937* random, std::size_t size) {
  std::string text;
  while (text.size() < size) text += static_cast<char>((*random)() % 256);
  return text;
}

/// Whatever a name holds, it becomes one component of a path that hides nothing and leads nowhere.
TEST(SafeName, IsAPlainFileNameWhateverANameHolds) {
  std::mt19937 random(1);
  std::vector<std::string> names = {"", ".", "..", "../../etc", "a/b", ".hidden", "paper/scene2"};
  for (std::size_t i = 0; i < 300; ++i) names.push_back(RandomText(&random, i % 120));
  for (const std::string& name : names) {
    const std::string safe = SafeName(name);
    EXPECT_LE(safe.size(), 81u);
    EXPECT_FALSE(safe.starts_with('.'));
    EXPECT_EQ(
        safe.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-"),
        std::string::npos);
    EXPECT_EQ(SafeName(safe), safe) << "what is safe stays";
  }
  EXPECT_EQ(SafeName("paper/scene2"), "paper.scene2");
}

TEST(RunId, TellsRunsApartThatDifferInAnyPart) {
  std::set<std::string> ids;
  for (const char* scene : {"paper/scene1", "paper/scene2"}) {
    for (const char* twin : {"live", "empty"}) {
      for (const char* system : {"plain", "robust"}) {
        for (const std::uint64_t seed : {1, 2, 12}) {
          for (const int repeat : {1, 2, 3}) {
            RunSpec spec{.scene = scene, .scene_file = "", .twin = twin, .system = BuiltIn(system)};
            spec.seed = seed;
            spec.repeat = repeat;
            const std::string id = RunId(spec);
            EXPECT_TRUE(ids.insert(id).second) << id;
            spec.scene_file = "elsewhere.yaml";
            EXPECT_EQ(RunId(spec), id) << "where the file lies does not matter";
          }
        }
      }
    }
  }
}

TEST(RunStatus, NamesAreReadBackAndOthersRefused) {
  std::set<std::string> names;
  for (int i = 0; i < 5; ++i) {
    const auto status = static_cast<RunStatus>(i);
    names.insert(Name(status));
    EXPECT_EQ(RunStatusFromName(Name(status)), status);
  }
  EXPECT_EQ(names.size(), 5u);
  EXPECT_THROW(RunStatusFromName("fine"), std::invalid_argument);
}

/// Scores with and without values, and numbers that JSON has none for.
TEST(RunRecordJson, ComesBackWithEveryScoreOrTheReasonForItsAbsence) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1e3, 1e3);
  for (int round = 0; round < 100; ++round) {
    RunRecord record;
    record.spec = {.scene = "a\"b", .scene_file = "f", .twin = "live", .system = BuiltIn("robust")};
    record.spec.seed = (std::uint64_t{random()} << 32) | random();
    record.status = static_cast<RunStatus>(round % 5);
    record.limit_s = round % 3;
    record.limit_mib = round % 2 ? 0.1 : 0;
    record.status_why = round % 2 ? "why <&>\n\xC3\xA4" : "";
    record.frames = random() % 1000;
    record.flaky = round % 3 == 0;
    record.notes = {"one", "two\ttabs"};
    record.artifacts = {{"frames", "runs/a/frames.csv"}};
    for (int i = 0; i < 5; ++i) {
      Score score{.value = number(random),
                  .unit = "m",
                  .alignment = "se3",
                  .n = random() % 99,
                  .absent = ""};
      if (i == 1) score.value = std::numeric_limits<double>::quiet_NaN();
      if (i == 2) score = {.value = {}, .unit = "1", .alignment = "", .n = 0, .absent = "no masks"};
      if (i == 3) score.value = 1e-300 * number(random);
      record.scores[fmt::format("score_{}", i)] = score;
    }
    const RunRecord read = RecordFromJson(ToJson(record), "x");
    EXPECT_EQ(read.spec, record.spec);
    EXPECT_EQ(read.status, record.status);
    EXPECT_EQ(read.status_why, record.status_why);
    EXPECT_EQ(read.limit_s, record.limit_s);
    EXPECT_EQ(read.limit_mib, record.limit_mib);
    EXPECT_EQ(read.frames, record.frames);
    EXPECT_EQ(read.flaky, record.flaky);
    EXPECT_EQ(read.notes, record.notes);
    EXPECT_EQ(read.artifacts, record.artifacts);
    ASSERT_EQ(read.scores.size(), 5u);
    EXPECT_EQ(read.scores.at("score_0").value, record.scores.at("score_0").value) << "to the bit";
    EXPECT_FALSE(read.scores.at("score_1").value) << "not a number is null, never 0";
    EXPECT_EQ(read.scores.at("score_2").absent, "no masks");
    EXPECT_EQ(read.scores.at("score_3").value, record.scores.at("score_3").value);
  }
  EXPECT_THROW(RecordFromJson("{\"scene\": 3}", "x"), InputError);
}

class KeptRun : public testing::Test {
 protected:
  KeptRun() { fs::remove_all(folder_); }
  ~KeptRun() override { fs::remove_all(folder_); }

  RunRecord Write() {
    const RunResult run = MakeRun("hall", "plain", 3, 0.05, 60);
    const RunScore score = ScoreRun(run);
    RunRecord record = MakeRecord(run, score, 20);
    record.inputs_hash = "abc";
    return WriteRun(run, score, record, folder_);
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_kept_{}", ::getpid());
};

/// A run is not made again where it answers for the same inputs and all it left is what it left.
TEST_F(KeptRun, IsTakenOnlyWhileItsInputsAndTracksAreTheSame) {
  const RunRecord record = Write();
  EXPECT_TRUE(ReadFinishedRun(record.spec, "abc", {}, folder_));
  EXPECT_FALSE(ReadFinishedRun(record.spec, "abd", {}, folder_)) << "other inputs";
  RunSpec other = record.spec;
  other.seed = 4;
  EXPECT_FALSE(ReadFinishedRun(other, "abc", {}, folder_)) << "another run";
  const fs::path run = folder_ / "runs" / RunId(record.spec);
  for (const char* track : {"live.txt", "final.txt", "truth.txt"}) {
    const std::string whole = ReadFile(run / track);
    std::string changed = whole;
    char& byte = changed[changed.size() / 2];
    byte = byte == '1' ? '2' : '1';
    std::ofstream(run / track) << changed;
    EXPECT_FALSE(ReadFinishedRun(record.spec, "abc", {}, folder_)) << track << " is other";
    fs::remove(run / track);
    EXPECT_FALSE(ReadFinishedRun(record.spec, "abc", {}, folder_)) << track << " is gone";
    std::ofstream(run / track) << whole;
    EXPECT_TRUE(ReadFinishedRun(record.spec, "abc", {}, folder_));
  }
  const std::string json = ReadFile(run / "result.json");
  std::ofstream(run / "result.json") << json.substr(0, json.size() / 2);
  EXPECT_FALSE(ReadFinishedRun(record.spec, "abc", {}, folder_));
}

/// What ran out of time or memory would run out again, unless it is given more.
TEST_F(KeptRun, IsMadeAgainWhereALimitThatEndedItIsLargerNow) {
  RunRecord record = Write();
  const auto kept = [&](const RunLimits& limits) {
    return ReadFinishedRun(record.spec, "abc", limits, folder_).has_value();
  };
  const auto write = [&] {
    std::ofstream(folder_ / "runs" / RunId(record.spec) / "result.json") << ToJson(record);
  };
  record.status = RunStatus::kTimeout;
  write();
  EXPECT_TRUE(kept({.wall_s = 1e6, .memory_mib = 1e6})) << "of before: nobody knows the limit";
  for (const std::string& left : {record.output_hash, std::string()}) {
    record.output_hash = left;  // a command's own, or the whole run's
    record.limit_s = 60;
    record.limit_mib = 0;
    write();
    EXPECT_TRUE(kept({.wall_s = 60, .memory_mib = 1e6}));
    EXPECT_TRUE(kept({.wall_s = 30}));
    EXPECT_FALSE(kept({.wall_s = 61}));
    EXPECT_FALSE(kept({})) << "an hour";
    record.limit_s = 0;
    record.limit_mib = 100;
    write();
    EXPECT_TRUE(kept({.wall_s = 1e6, .memory_mib = 100}));
    EXPECT_FALSE(kept({.memory_mib = 101}));
  }
}

/// Every frame's numbers come back from the table, the absent ones absent.
TEST(FramesCsv, RandomRowsComeBackToTheFiguresOfTheFile) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto maybe = [&]() -> std::optional<double> {
    return random() % 3 ? std::optional(unit(random)) : std::nullopt;
  };
  std::vector<FrameRow> rows(200);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    FrameRow& row = rows[i];
    row.id = static_cast<std::int64_t>(i);
    row.stamp_ns = static_cast<std::int64_t>(random()) * 1000;
    row.state = static_cast<TrackingState>(random() % 3);
    row.truth_m = {40 * unit(random) - 20, unit(random), unit(random)};
    if (random() % 2) row.live_m = row.truth_m + Eigen::Vector3d(unit(random), 0, 0);
    if (random() % 2) row.final_m = row.truth_m;
    row.live_error_m = maybe();
    row.movers_share = unit(random);
    row.features = static_cast<int>(random() % 3000);
    row.mask_iou = maybe();
    if (random() % 2) row.corners_rejected = static_cast<int>(random() % 999);
    row.difficulty.flow_px = maybe();
    row.process_ms = 100 * unit(random);
  }
  const std::vector<FrameRow> read = FrameRowsFromCsv(ToCsv(rows), "x");
  ASSERT_EQ(read.size(), rows.size());
  const auto same = [](const std::optional<double>& a, const std::optional<double>& b) {
    return a.has_value() == b.has_value() && (!a || std::abs(*a - *b) < 1e-4);
  };
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const FrameRow &a = read[i], &b = rows[i];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.stamp_ns, b.stamp_ns);
    EXPECT_EQ(a.state, b.state);
    EXPECT_LT((a.truth_m - b.truth_m).norm(), 1e-4);
    ASSERT_EQ(a.live_m.has_value(), b.live_m.has_value());
    ASSERT_EQ(a.final_m.has_value(), b.final_m.has_value());
    if (a.live_m) {
      EXPECT_LT((*a.live_m - *b.live_m).norm(), 1e-4);
    }
    EXPECT_TRUE(same(a.live_error_m, b.live_error_m));
    EXPECT_TRUE(same(a.mask_iou, b.mask_iou));
    EXPECT_TRUE(same(a.difficulty.flow_px, b.difficulty.flow_px));
    EXPECT_EQ(a.corners_rejected, b.corners_rejected);
    EXPECT_EQ(a.features, b.features);
    EXPECT_NEAR(a.process_ms, b.process_ms, 0.01);
  }
}

}  // namespace
}  // namespace aisle
