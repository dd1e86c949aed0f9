// Systems of others that crash, hang, flood their output or write nonsense: each gets its verdict
// and touches nothing else.
#include <gmock/gmock.h>

#include "harness/io/file.h"
#include "tests/system/program.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class ForeignSystemTest : public ProgramTest {
 protected:
  static const RunRecord& Find(const Results& results, const std::string& system) {
    for (const RunRecord& run : results.runs) {
      if (run.spec.system.name == system) return run;
    }
    throw std::runtime_error("no run of " + system);
  }
};

TEST_F(ForeignSystemTest, WhateverItDoesEndsAsItsOwnVerdict) {
  ASSERT_EQ(Run({"run", Suite("alone", "  - plain\n"), "--out", Out("alone")}).code, 0);
  const std::string systems =
      "  - {name: crashes, command: \"kill -SEGV $$ # {output}\"}\n"
      "  - {name: leaves, command: \"echo no camera >&2; exit 7 # {output}\"}\n"
      "  - {name: hangs, command: \"sleep 1000 & sleep 1000 # {output}\", timeout_s: 1}\n"
      "  - {name: floods, command: \"yes | head -c 300000000; true {output}\"}\n"
      "  - {name: nan, command: \"echo 0.0 nan 0 0 0 0 0 1 > {output}\"}\n"
      "  - {name: unordered, command: \"printf '2.0 0 0 0 0 0 0 1\\n1.0 0 0 0 0 0 0 1\\n' > "
      "{output}\"}\n"
      "  - {name: silent, command: \"true {output}\"}\n"
      "  - plain\n";
  const Said said = Run({"run", Suite("zoo", systems), "--out", Out("zoo"), "--jobs", "2"});
  EXPECT_EQ(said.code, 1) << said.text;  // verdicts failed: nothing of ours did
  const Results results = ResultsOf(Out("zoo"));
  ASSERT_EQ(results.runs.size(), 8u);
  const std::tuple<const char*, RunStatus, const char*> expected[] = {
      {"crashes", RunStatus::kCrashed, "signal 11"},
      {"leaves", RunStatus::kCrashed, "exit code 7"},
      {"hangs", RunStatus::kTimeout, "no end after 1 s: killed"},
      {"floods", RunStatus::kInvalid, "left no trajectory"},
      {"nan", RunStatus::kInvalid, "output.txt:1: "},
      {"unordered", RunStatus::kInvalid, "output.txt:2: "},
      {"silent", RunStatus::kInvalid, "left no trajectory"},
      {"plain", RunStatus::kOk, ""}};
  for (const auto& [system, status, why] : expected) {
    const RunRecord& run = Find(results, system);
    EXPECT_EQ(run.status, status) << system << ": " << run.status_why;
    EXPECT_THAT(run.status_why, HasSubstr(why)) << system;
    EXPECT_FALSE(run.flaky) << system;
  }
  const RunRecord& calm = Find(results, "plain");
  EXPECT_EQ(calm.output_hash, Find(ResultsOf(Out("alone")), "plain").output_hash);
  // What a flood leaves is its tail.
  EXPECT_LT(fs::file_size(fs::path(Out("zoo")) / "runs/short/live/floods/1/system.log"), 300000u);
}

TEST_F(ForeignSystemTest, ThatWasWrappedForVslamLabRunsUnchanged) {
  // A stand-in that keeps the contract: takes key:value arguments, leaves a key-frame trajectory.
  const std::string program = (folder_ / "wrapped.sh").string();
  WriteFileAtomically(program, R"(#!/bin/sh
for argument in "$@"; do
  case $argument in
    sequence_path:*) sequence=${argument#*:} ;;
    calibration_yaml:*) calibration=${argument#*:} ;;
    rgb_csv:*) images=${argument#*:} ;;
    exp_folder:*) folder=${argument#*:} ;;
    exp_id:*) id=${argument#*:} ;;
    mode:*) mode=${argument#*:} ;;
  esac
done
[ "$mode" = stereo ] && grep -q 'T_BS' "$calibration" || exit 5
first=$(sed -n 2p "$images" | cut -d, -f2)
[ -s "$sequence/$first" ] || exit 6
sed -n '1p;2~3p' "$sequence/groundtruth.csv" > "$folder/${id}_KeyFrameTrajectory.csv"
)");
  const std::string systems =
      fmt::format("  - {{name: wrapped, contract: vslam-lab, command: \"sh {}\"}}\n", program);
  const Said said = Run({"run", Suite("lab", systems), "--out", Out("lab")});
  EXPECT_EQ(said.code, 0) << said.text;
  const Results results = ResultsOf(Out("lab"));
  const RunRecord& run = results.runs.at(0);
  EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
  EXPECT_EQ(run.scores.at("ate_rmse_m").n, 4u);
  EXPECT_LT(*run.scores.at("ate_rmse_m").value, 1e-6);
}

TEST_F(ForeignSystemTest, AnImperfectNetworkRejectsLessThanThePerfectOne) {
  const std::string systems =
      "  - semantic\n"
      "  - {name: network, like: semantic, mask_errors: {boundary_px: 4, latency_frames: 3}}\n";
  const Said said = Run({"run", Suite("net", systems), "--out", Out("net")});
  EXPECT_EQ(said.code, 0) << said.text;
  const Results results = ResultsOf(Out("net"));
  const double perfect = *Find(results, "semantic").scores.at("mask_recall").value;
  EXPECT_LT(*Find(results, "network").scores.at("mask_recall").value, perfect);
}

TEST_F(ForeignSystemTest, ThatFailsOnceIsFlakyAndNotForgiven) {
  const std::string mark = Out("been_here");
  const std::string systems = fmt::format(
      "  - {{name: moody, command: \"test -e {0} && cp {{dataset}}/poses/00.txt {{output}} && "
      "exit 0; touch {0}; exit 3\", dataset: kitti, trajectory: kitti}}\n",
      mark);
  const Said said = Run({"run", Suite("moody", systems), "--out", Out("moody")});
  EXPECT_EQ(said.code, 1) << said.text;
  const Results results = ResultsOf(Out("moody"));
  const RunRecord& run = results.runs.at(0);
  EXPECT_EQ(run.status, RunStatus::kCrashed);
  EXPECT_TRUE(run.flaky);
  ASSERT_EQ(results.verdicts.size(), 1u);
  EXPECT_TRUE(results.verdicts[0].flaky);
  EXPECT_FALSE(results.verdicts[0].passed);
}

}  // namespace
}  // namespace aisle
