// Systems of others that crash, hang, flood their output or write nonsense: each gets its verdict
// and touches nothing else.
#include <gmock/gmock.h>

#include <cstdlib>

#include "harness/campaign/sandbox.h"
#include "harness/io/file.h"
#include "tests/support/few_descriptors.h"
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

  /// A trajectory of the short scene that a stand-in may leave: that of our own SLAM, outside any
  /// report. Its stamps are the scene's.
  std::string KnownTrajectory() const {
    const fs::path known = folder_ / "known.txt";
    const Said said = Run({"run", Suite("known", "  - plain\n"), "--out", Out("known")});
    EXPECT_EQ(said.code, 0) << said.text;
    WriteFileAtomically(known,
                        ReadFile(fs::path(Out("known")) / "runs/short/live/plain/1/final.txt"));
    return known.string();
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
      {"hangs", RunStatus::kTimeout, "killed after 1 s without an end"},
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

/// A stand-in that keeps VSLAM-LAB's contract and writes its rows from the last to the first; the
/// arguments come as key:value, or as --key value in Python's style.
std::string WrappedSystem(const std::string& known) {
  return fmt::format(R"sh(#!/bin/sh
while [ $# -gt 0 ]; do
  case $1 in
    --*) key=${{1#--}} value=$2; shift 2 ;;
    *) key=${{1%%:*}} value=${{1#*:}}; shift ;;
  esac
  eval "$key=\$value"
done
[ "$mode" = stereo ] && grep -q 'T_BS' "$calibration_yaml" || exit 5
first=$(sed -n 2p "$rgb_csv" | cut -d, -f2)
case $first in rgb_0/*) ;; *) exit 6 ;; esac
[ -s "$sequence_path/$first" ] && [ -s "$sequence_path/rgb_1/${{first#rgb_0/}}" ] || exit 7
[ "$(wc -l <"$sequence_path/imu_0.csv")" -gt 100 ] || exit 8
[ ! -e "$sequence_path/groundtruth.csv" ] || exit 9
awk '!/#/ && NR % 3 == 1 {{ $1 = sprintf("%.0f", ($1 + 1600000000) * 1e9); print }}' '{}' |
  tac | tr ' ' , >"$exp_folder/${{exp_id:-$exp_it}}_KeyFrameTrajectory.csv"
)sh",
                     known);
}

TEST_F(ForeignSystemTest, ThatWasWrappedForVslamLabRunsUnchanged) {
  const std::string program = (folder_ / "wrapped.sh").string();
  WriteFileAtomically(program, WrappedSystem(KnownTrajectory()));
  const std::string systems = fmt::format(
      "  - {{name: wrapped, contract: vslam-lab, command: \"sh {0}\"}}\n"
      "  - {{name: python, contract: vslam-lab-python, command: \"sh {0}\"}}\n",
      program);
  const Said said = Run({"run", Suite("lab", systems), "--out", Out("lab")});
  EXPECT_EQ(said.code, 0) << said.text;
  const Results results = ResultsOf(Out("lab"));
  for (const char* name : {"wrapped", "python"}) {
    const RunRecord& run = Find(results, name);
    EXPECT_EQ(run.status, RunStatus::kOk) << name << ": " << run.status_why;
    EXPECT_EQ(run.scores.at("ate_rmse_m").n, 4u);
    EXPECT_LT(*run.scores.at("ate_rmse_m").value, 0.05);
  }
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
  const std::string mark = Out("mark");
  fs::create_directories(mark);
  const std::string systems = fmt::format(
      "  - {{name: moody, command: \"test -e {0}/been && cp {1} {{output}} && exit 0; touch "
      "{0}/been; exit 3\", dataset: kitti, may_write: [{0}]}}\n",
      mark, KnownTrajectory());
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

TEST_F(ForeignSystemTest, ThatFailedIsTriedOnceMoreByANightThatGoesOn) {
  const std::string known = KnownTrajectory();
  // The dataset's epoch is missing in what `lost` leaves the second time: no stamp is the scene's.
  std::string systems = fmt::format(
      "  - {{name: broken, command: \"exit 3 # {{output}}\", depends_on: [{}]}}\n", known);
  for (const auto& [name, dataset] : {std::pair("ok", "kitti"), std::pair("lost", "euroc")}) {
    // What it leaves to remember is a folder: a file that its command names would decide it.
    const std::string mark = Out(fmt::format("mark_{}", name));
    fs::create_directories(mark);
    systems += fmt::format(
        "  - {{name: {3}, command: \"test -d {0}/been && cp {1} {{output}} && exit 0; mkdir "
        "{0}/been; exit 3\", dataset: {2}, may_write: [{0}], depends_on: [{1}]}}\n",
        mark, known, dataset, name);
  }
  // As a night that is stopped before its second attempts leaves it.
  const std::vector<std::string> run{"run", Suite("stopped", systems), "--out", Out("stopped")};
  std::vector<std::string> first = run, resume = run;
  first.emplace_back("--no-retry");
  resume.emplace_back("--resume");
  EXPECT_EQ(Run(first).code, 1);
  for (const RunRecord& record : ResultsOf(Out("stopped")).runs) EXPECT_EQ(record.attempts, 1);

  const Said said = Run(resume);
  EXPECT_EQ(said.code, 1) << said.text;
  EXPECT_THAT(said.text, HasSubstr("3 of 3 runs are already done"));
  EXPECT_THAT(said.text, HasSubstr("3 failed; running again"));
  const Results results = ResultsOf(Out("stopped"));
  for (const RunRecord& record : results.runs) {
    EXPECT_EQ(record.status, RunStatus::kCrashed);
    EXPECT_EQ(record.attempts, 2);
    EXPECT_EQ(record.flaky, record.spec.system.name != "broken");
  }
  for (const std::string name : {"ok", "lost"}) {
    EXPECT_THAT(Find(results, name).status_why,
                testing::EndsWith("a second attempt with the same inputs ended " + name));
  }
  EXPECT_THAT(Run(resume).text, testing::Not(HasSubstr("running again")))
      << "two attempts are enough";
}

TEST_F(ForeignSystemTest, ThatTellsMoreIsShownWithIt) {
  const std::string systems = fmt::format(
      "  - name: tells\n"
      "    command: \"echo '@progress 3 40'; echo at work; cp {} {{output}}; cd $(dirname "
      "{{output}}); "
      "printf 'frame,u,v,used\\n0,10,20,1\\n0,700,400,0\\n' >features.csv\"\n"
      "    dataset: kitti\n    version: echo v7\n    repeats: 2\n",
      KnownTrajectory());
  const Said said = Run({"run", Suite("tells", systems), "--out", Out("tells")});
  EXPECT_EQ(said.code, 0) << said.text;
  const Results results = ResultsOf(Out("tells"));
  ASSERT_EQ(results.runs.size(), 2u);
  EXPECT_EQ(RunId(results.runs[1].spec), "short/live/tells/1r2");
  for (const RunRecord& run : results.runs) {
    EXPECT_EQ(run.status, RunStatus::kOk) << run.status_why;
    EXPECT_EQ(run.system_version, "v7");
    EXPECT_EQ(run.last_words, "at work\n");
    const Score& step = run.scores.at("ms_process_mean");
    EXPECT_GT(*step.value, 0);
    EXPECT_THAT(step.basis, HasSubstr("wall time"));
    EXPECT_EQ(run.scores.at("features_on_movers").n, 2u);
    EXPECT_GT(*run.scores.at("difficulty_movers_share").value, 0);
    for (const char* artifact : {"log", "features", "picture_0000", "frames"}) {
      EXPECT_TRUE(run.artifacts.contains(artifact)) << artifact;
    }
  }
  EXPECT_THAT(ReadFile(fs::path(Out("tells")) / "index.html"), HasSubstr("≈"));
}

TEST_F(ForeignSystemTest, SpoilsItsOwnDatasetAlone) {
  const std::string known = KnownTrajectory();
  const std::string whole =
      "test -s {dataset}/mav0/cam1/data.csv && grep -q png {dataset}/mav0/cam0/data.csv && ";
  const std::string systems = fmt::format(
      "  - {{name: spoils, command: \"echo 1,none >{{dataset}}/mav0/cam0/data.csv; rm -r "
      "{{dataset}}/mav0/cam1; chmod 0 {{dataset}}; cp {0} {{output}}\", trajectory: tum}}\n"
      "  - {{name: reads, command: \"{1}cp {0} {{output}}\"}}\n",
      known, whole);
  const Said said = Run({"run", Suite("spoilt", systems), "--out", Out("spoilt")});
  const Results results = ResultsOf(Out("spoilt"));
  // The stamps of what is known lack the dataset's epoch, which neither the one nor the other
  // minds.
  EXPECT_EQ(Find(results, "spoils").status, RunStatus::kLost) << said.text;
  EXPECT_EQ(Find(results, "reads").status, RunStatus::kLost) << said.text;
  EXPECT_FALSE(fs::exists(fs::path(Out("spoilt")) / "runs/short/live/spoils/1/guest"));
  // What somebody else spoils in the cache, or puts beside it, is noticed and made anew.
  for (const auto& entry : fs::recursive_directory_iterator(std::getenv("AISLE_CACHE"))) {
    if (entry.path().filename() == "data.csv" && entry.is_regular_file()) {
      WriteFileAtomically(entry.path(), "spoilt");
    }
  }
  ASSERT_NE(Run({"run", Suite("spoilt", systems), "--out", Out("again")}).code, 3);
  EXPECT_EQ(Find(ResultsOf(Out("again")), "reads").status, RunStatus::kLost);
}

TEST_F(ForeignSystemTest, ThatIsHostileFindsNothingAndHarmsNobody) {
  if (SandboxLevel() < 6) GTEST_SKIP() << DescribeSandbox();
  const std::string known = KnownTrajectory();
  ASSERT_EQ(Run({"run", Suite("first", "  - plain\n"), "--out", Out("first")}).code, 0);
  const std::string program = (folder_ / "hostile.sh").string();
  // Reads whatever may hold truth, writes wherever it can, and says what it managed to do.
  WriteFileAtomically(program, fmt::format(R"(#!/bin/sh
for file in $(find '{0}' '{1}' "$1" -type f ! -name '*.png' 2>/dev/null); do
  case $file in
    "$1"/*) case $file in *groundtruth*|*poses*|*aisle.json|*state_*) echo "truth: $file" ;; esac ;;
    *.sh|*/known.txt|*/suites/*|*/guest/*) ;;  # what it may see
    *) head -c 1 "$file" >/dev/null 2>&1 && echo "read: $file" ;;
  esac
done
for place in '{0}' '{1}' '{0}/first' . "$HOME" /tmp /var/tmp /etc; do
  touch "$place/aisle_was_here" 2>/dev/null && echo "wrote: $place"
done
env | grep AISLE && echo "environment"
cp '{2}' "$2"
)",
                                           folder_.string(), std::getenv("AISLE_CACHE"), known));
  const std::string systems = fmt::format(
      "  - {{name: hostile, command: \"sh {} {{dataset}} {{output}}\", dataset: kitti}}\n",
      program);
  const Said said = Run({"run", Suite("hostile", systems), "--out", Out("hostile")});
  EXPECT_EQ(said.code, 0) << said.text;
  const fs::path run = fs::path(Out("hostile")) / "runs/short/live/hostile/1";
  const std::string log = ReadFile(run / "system.log");
  for (const char* done : {"read: ", "truth: ", "wrote: ", "environment"}) {
    EXPECT_THAT(log, testing::Not(HasSubstr(std::string("\n") + done)));
  }
  EXPECT_EQ(Find(ResultsOf(Out("hostile")), "hostile").status, RunStatus::kOk);
  // Nor does it the second time, when its first attempt's folder, with truth, lies beside it.
  const std::string twice = fmt::format(
      "  - {{name: hostile, command: \"sh {} {{dataset}} {{output}}; exit 3\", dataset: kitti}}\n",
      program);
  EXPECT_EQ(Run({"run", Suite("twice", twice), "--out", Out("twice")}).code, 1);
  const std::string second =
      ReadFile(fs::path(Out("twice")) / "again/runs/short/live/hostile/1/system.log");
  EXPECT_THAT(second, testing::Not(HasSubstr("\nread: ")));
}

TEST_F(ForeignSystemTest, ThatBuriesItsOutputLeavesNothingForTheNextNight) {
  const std::string script = (folder_ / "bury.py").string();
  WriteFileAtomically(script, R"(import os, shutil, sys
shutil.copy(sys.argv[1], sys.argv[2])
os.chdir(os.path.dirname(sys.argv[2]))
for level in range(2000):
    os.mkdir("d")
    os.chdir("d")
)");
  const std::string suite =
      Suite("buried", fmt::format("  - {{name: buries, command: \"python3 '{}' '{}' {{output}}\", "
                                  "dataset: kitti}}\n",
                                  script, KnownTrajectory()));
  const FewDescriptors few(256);
  const Said first = Run({"run", suite, "--out", Out("buried"), "--no-retry"});
  EXPECT_EQ(first.code, 0) << first.text;
  const fs::path run = fs::path(Out("buried")) / "runs/short/live/buries/1";
  EXPECT_FALSE(fs::exists(run / "guest"));
}

TEST_F(ForeignSystemTest, ThatLocksOurFoldersLocksNobodyOut) {
  const std::string known = KnownTrajectory();
  const std::string systems = fmt::format(
      "  - {{name: locks, command: \"cp '{0}' {{output}}; chmod 0 '{2}/frames' '{2}' "
      "'{1}/runs/short/live/locks/1' '{1}/runs' '{1}'; exit 3\", dataset: kitti}}\n"
      "  - plain\n",
      known, Out("locked"), std::getenv("AISLE_CACHE"));
  const Said said = Run({"run", Suite("locked", systems), "--out", Out("locked")});
  EXPECT_EQ(said.code, 1) << said.text;  // its own failure, also of its second attempt
  EXPECT_EQ(Find(ResultsOf(Out("locked")), "locks").attempts, 2);
  EXPECT_EQ(Find(ResultsOf(Out("locked")), "plain").status, RunStatus::kOk);
  for (const fs::path& folder :
       {fs::path(Out("locked")), fs::path(Out("locked")) / "runs",
        fs::path(std::getenv("AISLE_CACHE")), fs::path(std::getenv("AISLE_CACHE")) / "frames"}) {
    EXPECT_EQ(fs::status(folder).permissions() & fs::perms::owner_all, fs::perms::owner_all)
        << folder;
  }
}

TEST_F(ForeignSystemTest, LeavesWhatNobodyShouldOpen) {
  const std::string systems =
      "  - {name: pipe, command: \"mkfifo {output}\"}\n"
      "  - {name: device, command: \"ln -s /dev/zero {output}\"}\n"
      "  - {name: sparse, command: \"truncate -s 60G {output}\"}\n"
      "  - {name: large, command: \"truncate -s 1100M {output}\"}\n"
      "  - {name: folder, command: \"mkdir {output}\"}\n"
      "  - {name: still, command: \"yes '5 0 0 0 0 0 0 1' | head -30000 >{output}\"}\n"
      "  - {name: shell, command: \"sh -c 'kill -SEGV $$'; exit $? # {output}\"}\n";
  const Said said =
      Run({"run", Suite("left", systems), "--out", Out("left"), "--no-retry", "--jobs", "2"});
  EXPECT_EQ(said.code, 1) << said.text;
  const Results results = ResultsOf(Out("left"));
  const std::pair<const char*, const char*> expected[] = {
      {"pipe", "not a regular file"},
      {"device", "is a link out of its folder"},
      {"sparse", ""},  // stopped while it was made
      {"large", "larger than the allowed"},
      {"folder", "not a regular file"},
      {"still", "is the first column the time?"},
      {"shell", "signal 11, SIGSEGV"}};
  for (const auto& [system, why] : expected) {
    const RunRecord& run = Find(results, system);
    EXPECT_TRUE(run.status == RunStatus::kInvalid || run.status == RunStatus::kCrashed) << system;
    EXPECT_THAT(run.status_why, HasSubstr(why)) << system;
  }
}

TEST_F(ForeignSystemTest, IsRunAnewWhenItsScriptHasChanged) {
  const std::string script = (folder_ / "slam.sh").string();
  const std::string model = (folder_ / "model.txt").string();
  const std::string known = KnownTrajectory();
  WriteFileAtomically(script, "cp " + known + " $1\n");
  WriteFileAtomically(model, "weights");
  const std::string suite = Suite(
      "resumed", fmt::format("  - {{name: mine, command: \"sh {} {{output}}\", dataset: kitti, "
                             "depends_on: [{}]}}\n",
                             script, model));
  const std::vector<std::string> resume{"run", suite, "--out", Out("resumed"), "--resume"};
  ASSERT_EQ(Run(resume).code, 0);
  EXPECT_THAT(Run(resume).text, HasSubstr("1 of 1 runs are already done"));
  WriteFileAtomically(script, "cp " + known + " $1 # another way\n");
  EXPECT_THAT(Run(resume).text, testing::Not(HasSubstr("already done")));
  WriteFileAtomically(model, "other weights");
  EXPECT_THAT(Run(resume).text, testing::Not(HasSubstr("already done")));
}

TEST_F(ForeignSystemTest, IsRunAnewWhereNobodyCanTellWhatItIs) {
  const std::string script = (folder_ / "my slam/run").string(), known = KnownTrajectory();
  WriteFileAtomically(script, "#!/bin/sh\ncp " + known + " $1\n");
  fs::permissions(script, fs::perms::owner_all);
  const auto resume = [&](const std::string& command, const std::string& more = "") {
    const std::string suite = Suite(
        "told",
        fmt::format("  - {{name: mine, command: \"{}\", dataset: kitti{}}}\n", command, more));
    return Run({"run", suite, "--out", Out("told"), "--resume"}).text;
  };
  // By a shell alone.
  const std::string asked = fmt::format("\\\"$(echo '{}')\\\" {{output}}", script);
  EXPECT_THAT(resume(asked), HasSubstr("--resume repeats the runs of mine"));
  EXPECT_THAT(resume(asked), testing::Not(HasSubstr("already done")));
  const std::string depends = fmt::format(", depends_on: ['{}']", script);
  EXPECT_THAT(resume(asked, depends), testing::Not(HasSubstr("--resume repeats the runs")));
  EXPECT_THAT(resume(asked, depends), HasSubstr("1 of 1 runs are already done"));
  // A path that must be quoted is no riddle.
  const std::string quoted = fmt::format("'{}' {{output}}", script);
  EXPECT_THAT(resume(quoted), testing::Not(HasSubstr("--resume repeats the runs")));
  EXPECT_THAT(resume(quoted), HasSubstr("1 of 1 runs are already done"));
  WriteFileAtomically(script, "#!/bin/sh\ncp " + known + " $1 # another way\n");
  fs::permissions(script, fs::perms::owner_all);
  EXPECT_THAT(resume(quoted), testing::Not(HasSubstr("already done")));
}

}  // namespace
}  // namespace aisle
