#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/contract/run_limits.h"
#include "harness/contract/score.h"
#include "harness/score/scorecard.h"

namespace aisle {

/// What a report needs to know of one run; lives as result.json in the run's folder, written last.
struct RunRecord {
  RunSpec spec;
  std::string hall;  ///< where it ran: "cold_store"; empty: in the scene's own
  RunStatus status = RunStatus::kOk;
  std::string status_why;
  /// The limits of which one ended it (kTimeout); 0: that one did not, or results of before.
  double limit_s = 0, limit_mib = 0;
  std::size_t frames = 0;
  double rate_hz = 0;
  double wall_s = 0;
  int threads = 0;
  std::string content_hash;  ///< of all that decides the pixels, hexadecimal
  std::string inputs_hash;   ///< of all that decides the run: program, scene, system, seed
  std::string output_hash;   ///< of the trajectories it left; empty where it left none
  /// What made it and where: the runs of one night may come from several machines. Empty in results
  /// of before.
  std::string program, commit, cpu;  ///< hash of the program, its tree's commit, the processor
  std::string system_version;        ///< what a foreign system says it is; empty for ours
  std::string last_words;  ///< the last lines a foreign system, or one that failed, printed
  int attempts = 1;        ///< times the same inputs were tried; the first is what stands here
  /// The second attempt did not fail: what fails is not what the inputs are but when.
  bool flaky = false;
  Scorecard scores;
  std::vector<std::string> notes;
  std::map<std::string, std::string> artifacts;  ///< name -> path relative to the report's folder
};

/// A file name whatever a name holds: plain characters stay, a slash becomes a dot, all else an
/// underscore; no leading dot, at most 81 characters.
std::string SafeName(const std::string& name);

/// "scene/twin/system/seed" with the slashes of the scene as dots: "paper.scene2/live/oracle/1"; a
/// further drive over the same input ends in "1r2".
/// Names a run for `rerun`, and its folder under DIR/runs.
std::string RunId(const RunSpec& spec);

/// "ok", "lost", "crashed", "timeout", "invalid"; the inverse throws std::invalid_argument.
std::string Name(RunStatus status);
RunStatus RunStatusFromName(const std::string& name);

/// `score` is the run's own; `rate_hz` that of its frames.
RunRecord MakeRecord(const RunResult& run, const RunScore& score, double rate_hz);

std::string ToJson(const RunRecord& record);
/// Throws InputError when the text is no record.
RunRecord RecordFromJson(const std::string& text, const std::string& file);

/// Whether two runs were made by one program: by its hash, or, of programs built on two machines,
/// by the commit where that tells all. Of runs that do not say it is supposed.
bool SameProgram(const RunRecord& a, const RunRecord& b);

/// Writes trajectories, frames.csv and, last, result.json into `report_dir`/runs/ID. The record
/// that comes back names the artifacts and this program and machine as its makers.
RunRecord WriteRun(const RunResult& run, const RunScore& score, RunRecord record,
                   const std::filesystem::path& report_dir);

/// A run's result.json, if it is there and whole.
std::optional<RunRecord> ReadRun(const RunSpec& spec, const std::filesystem::path& report_dir);

/// The same, if it answers for these inputs, its trajectories still are what it left, and no limit
/// that ended it is larger now: a run that need not be made again.
std::optional<RunRecord> ReadFinishedRun(const RunSpec& spec, const std::string& inputs_hash,
                                         const RunLimits& limits,
                                         const std::filesystem::path& report_dir);

}  // namespace aisle
