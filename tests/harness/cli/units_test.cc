#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <random>
#include <sstream>

#include "harness/cli/dynamic_table.h"
#include "harness/cli/publish.h"
#include "harness/cli/score_masks.h"
#include "harness/cli/system_choice.h"
#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/plugs/systems.h"
#include "tests/harness/cli/exit.h"
#include "tests/harness/record/night.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

class Folders : public testing::Test {
 protected:
  Folders() { fs::remove_all(folder_); }
  ~Folders() override { fs::remove_all(folder_); }

  void Write(const char* side, int frame, const cv::Mat1b& mask) const {
    WriteImage(folder_ / side / fmt::format("{:06}.png", frame), mask);
  }
  Scorecard Score() const {
    return ScoreMaskFolders((folder_ / "truth").string(), (folder_ / "mine").string());
  }

  const fs::path folder_ = fs::temp_directory_path() / fmt::format("aisle_units_{}", ::getpid());
};

cv::Mat1b Blobs(std::mt19937* random) {
  cv::Mat1b mask(60, 80, std::uint8_t{0});
  for (int i = 0; i < 3; ++i) {
    const cv::Rect box(static_cast<int>((*random)() % 50), static_cast<int>((*random)() % 40), 25,
                       15);
    mask(box).setTo(255);
  }
  return mask;
}

/// Every pixel of every frame counts once: the pixels' scores are those of a count by hand.
TEST_F(Folders, PixelScoresAreThoseOfACountByHand) {
  std::mt19937 random(1);
  double hit = 0, wrong = 0, missed = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const cv::Mat1b truth = Blobs(&random), mine = Blobs(&random);
    Write("truth", frame, truth);
    if (frame != 5) Write("mine", frame, mine);  // one without an answer
    for (int y = 0; y < 60; ++y) {
      for (int x = 0; x < 80; ++x) {
        const bool is = truth(y, x) != 0, said = frame != 5 && mine(y, x) != 0;
        hit += is && said;
        wrong += !is && said;
        missed += is && !said;
      }
    }
  }
  testing::internal::CaptureStderr();
  const Scorecard scores = Score();
  EXPECT_NE(testing::internal::GetCapturedStderr().find("1 of 12 true masks have no counterpart"),
            std::string::npos)
      << "what is missing is counted, and said";
  EXPECT_NEAR(*scores.at("mask_precision").value, hit / (hit + wrong), 1e-12);
  EXPECT_NEAR(*scores.at("mask_recall").value, hit / (hit + missed), 1e-12);
  EXPECT_NEAR(*scores.at("mask_iou").value, hit / (hit + wrong + missed), 1e-12);
}

TEST_F(Folders, TruthItselfIsPerfectAndNothingFindsNothing) {
  std::mt19937 random(2);
  for (int frame = 0; frame < 5; ++frame) {
    const cv::Mat1b truth = Blobs(&random);
    Write("truth", frame, truth);
    Write("mine", frame, truth);
  }
  for (const char* score : {"mask_precision", "mask_recall", "mask_iou", "object_precision",
                            "object_recall", "mask_boundary_f"}) {
    EXPECT_EQ(Score().at(score).value, 1) << score;
  }
  for (int frame = 0; frame < 5; ++frame) Write("mine", frame, cv::Mat1b(60, 80, std::uint8_t{0}));
  EXPECT_EQ(Score().at("mask_recall").value, 0);
  EXPECT_EQ(Score().at("object_recall").value, 0);
}

TEST_F(Folders, WhatCannotBePairedIsRefused) {
  std::mt19937 random(3);
  Write("truth", 0, Blobs(&random));
  EXPECT_THROW(Score(), InputError) << "no masks at all";
  Write("mine", 0, cv::Mat1b(30, 40, std::uint8_t{0}));
  EXPECT_THROW(Score(), InputError) << "its size differs";
  Write("mine", 0, cv::Mat1b(60, 80, std::uint8_t{0}));
  EXPECT_NO_THROW(Score());
  Write("mine", 1, cv::Mat1b(60, 80, std::uint8_t{0}));
  EXPECT_THROW(Score(), InputError) << "a mask of no true one";
}

DynamicOfView Row(std::mt19937* random, const std::string& name) {
  DynamicOfView row;
  row.name = name;
  row.view = name + fmt::format(":{}", (*random)() % 100);
  row.stretches = 1;
  row.frames = 1 + static_cast<int>((*random)() % 50);
  row.has_truth = true;
  row.masks.true_positives = static_cast<std::int64_t>((*random)() % 900);
  row.masks.false_positives = static_cast<std::int64_t>((*random)() % 900);
  row.masks.objects_found = static_cast<int>((*random)() % 9);
  row.pixels = 1e5;
  row.rejected = 1e4;
  row.stage_ms["dynamic"] = 12;
  return row;
}

/// Nothing is lost and nothing counted twice when stretches become scenes.
TEST(ByScene, SumsTheStretchesOfEachSceneInTheirOrder) {
  std::mt19937 random(4);
  for (int round = 0; round < 50; ++round) {
    std::vector<DynamicOfView> stretches;
    std::vector<std::string> order;
    std::map<std::string, int> frames, found;
    for (int i = 0; i <= round % 9; ++i) {
      const std::string name = fmt::format("scene{}", random() % 4);
      stretches.push_back(Row(&random, name));
      if (!frames.contains(name)) order.push_back(name);
      frames[name] += stretches.back().frames;
      found[name] += stretches.back().masks.objects_found;
    }
    const std::vector<DynamicOfView> scenes = ByScene(stretches);
    ASSERT_EQ(scenes.size(), order.size());
    int parts = 0;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      EXPECT_EQ(scenes[i].name, order[i]);
      EXPECT_EQ(scenes[i].frames, frames[order[i]]);
      EXPECT_EQ(scenes[i].masks.objects_found, found[order[i]]);
      parts += scenes[i].stretches;
    }
    EXPECT_EQ(parts, static_cast<int>(stretches.size()));
    EXPECT_EQ(ByScene(scenes).size(), scenes.size());
  }
}

TEST(DynamicTable, HasARowForEachAndTheirSumAllOfOneWidth) {
  std::mt19937 random(5);
  for (int count = 1; count <= 5; ++count) {
    std::vector<DynamicOfView> rows;
    for (int i = 0; i < count; ++i) rows.push_back(Row(&random, fmt::format("s{}", i)));
    std::istringstream lines(DynamicTable(rows));
    std::vector<std::string> table;
    for (std::string line; std::getline(lines, line);) table.push_back(line);
    EXPECT_EQ(table.size(), static_cast<std::size_t>(2 + count + (count > 1)));
    for (const std::string& line : table) {
      EXPECT_EQ(std::ranges::count(line, '|'), std::ranges::count(table[0], '|')) << line;
      EXPECT_TRUE(line.starts_with('|') && line.ends_with('|')) << line;
    }
    std::vector<std::string> names;
    for (const DynamicOfView& row : rows) names.push_back(row.view);
    for (const std::size_t width : {0u, 80u, 140u}) {
      TextTable terminal = DynamicLines(names, width);
      std::istringstream shown(terminal.Heading() + terminal.Row(names[0], DynamicCells(rows[0])));
      std::size_t last = 0;
      for (std::string line; std::getline(shown, line); last = line.size()) {
        EXPECT_TRUE(width == 0 || line.size() <= width) << line;
      }
      std::istringstream heading(terminal.Heading());
      for (std::string line; std::getline(heading, line);) {
        EXPECT_TRUE(!line.ends_with("ms") || line.size() == last) << line;
      }
    }
  }
}

TEST(HistoryPath, IsBesideTheNightHoweverItsFolderIsNamed) {
  const fs::path beside = "/out/history.sqlite";
  for (const char* out : {"/out/2026-01-31", "/out/2026-01-31/", "/out/2026-01-31/.",
                          "/out/2026-01-30/../2026-01-31/"}) {
    EXPECT_EQ(HistoryPath(out), beside) << out;
  }
  EXPECT_EQ(HistoryPath("."), fs::current_path().parent_path() / "history.sqlite");
}

/// A page of last week's night must look as it did then.
TEST(WithHistory, APageKnowsOfItsOwnNightAndThoseBeforeAlone) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_nights_{}", ::getpid());
  fs::remove_all(folder);
  std::vector<Results> nights;
  for (int day = 1; day <= 3; ++day) {
    const fs::path out = folder / fmt::format("night{}", day);
    Results night = MakeNight({.scenes = 1, .frames = 30, .systems = {"oracle"}}, out);
    night.suite = "nightly";
    night.started = fmt::format("2026-01-0{}T02:00:00Z", day);
    EXPECT_EQ(HistoryPath(out), folder / "history.sqlite") << "beside the nights";
    AppendToHistory(HistoryPath(out), night, out);
    nights.push_back(night);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const ReportOptions options = WithHistory(nights[i], folder / fmt::format("night{}", i + 1));
    std::set<std::string> known;
    for (const TrendPoint& point : options.history) known.insert(point.started);
    EXPECT_EQ(known.size(), i + 1);
    EXPECT_EQ(*known.rbegin(), nights[i].started);
    EXPECT_EQ(options.systems.at("plain"), FindSystem("plain").description);
  }
  Results unfiled = nights[2];
  unfiled.started = "2026-01-02T12:00:00Z";
  EXPECT_TRUE(WithHistory(unfiled, folder / "other").history.empty()) << "that was not filed";
  EXPECT_EQ(WithHistory(unfiled, folder / "other").history_trouble, "");
  fs::remove_all(folder);
}

TEST(WithHistory, AFileThatIsDamagedIsToldByTheCommandAndThePage) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("aisle_damaged_{}", ::getpid());
  const fs::path out = folder / "night";
  Results night = MakeNight({.scenes = 1, .frames = 30, .systems = {"oracle"}}, out);
  night.suite = "nightly";
  night.started = "2026-01-01T02:00:00Z";
  WriteFileAtomically(out / "results.json", ToJson(night));
  WriteFileAtomically(HistoryPath(out), std::string(5000, 'x'));
  const std::string why = HistoryPath(out).string() + ": cannot write: file is not a database";
  std::string said;
  EXPECT_EQ(Exit({"report", out.string()}, &said), kAllPassed) << said;
  EXPECT_THAT(said,
              testing::HasSubstr("aisle: warning: the trends do not include this run: " + why +
                                 "; if the file is damaged, move it away to start a new one\n"));
  EXPECT_THAT(ReadFile(out / "index.html"),
              testing::HasSubstr("The trends do not include this run: " + why));
  WriteFileAtomically(HistoryPath(out), "");
  const std::string cut = HistoryPath(out).string() + ": damaged: the file is empty";
  EXPECT_EQ(Exit({"report", out.string()}, &said), kAllPassed) << said;
  EXPECT_THAT(said, testing::HasSubstr("the trends do not include this run: " + cut));
  EXPECT_THAT(ReadFile(out / "index.html"),
              testing::HasSubstr("The trends do not include this run: " + cut));
  fs::remove(HistoryPath(out));
  EXPECT_EQ(Exit({"report", out.string()}, &said), kAllPassed);
  EXPECT_THAT(said, testing::Not(testing::HasSubstr("trends")));
  EXPECT_THAT(ReadFile(out / "index.html"), testing::Not(testing::HasSubstr("do not include")));
  fs::remove_all(folder);
}

TEST(SystemChoice, IsABuiltInSystemWithTheOptionsThatAreNamed) {
  const SystemSpec spec = SpecOf({"robust", {"feature.features=800"}});
  EXPECT_EQ(spec.like, "robust");
  EXPECT_THAT(spec.options, testing::ElementsAre(testing::Pair("feature.features", "800")));
  EXPECT_EQ(SpecOf({"plain", {}}), BuiltIn("plain"));
  EXPECT_THROW(SpecOf({"nobody", {}}), InputError);
  EXPECT_THROW(SpecOf({"robust", {"no.such=1"}}), InputError);
}

}  // namespace
}  // namespace aisle
