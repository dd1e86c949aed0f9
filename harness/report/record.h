#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/contract/score.h"
#include "harness/score/scorecard.h"

namespace aisle {

/// What a report needs to know of one run; lives as result.json in the run's folder, written last.
struct RunRecord {
  RunSpec spec;
  RunStatus status = RunStatus::kOk;
  std::string status_why;
  std::size_t frames = 0;
  double rate_hz = 0;
  double wall_s = 0;
  int threads = 0;
  std::string content_hash;  ///< of all that decides the pixels, hexadecimal
  std::string inputs_hash;   ///< of all that decides the run: program, scene, system, seed
  std::string output_hash;   ///< of the trajectories it left; empty where it left none
  /// The same inputs, tried again, ended well: what fails is not what they are but when.
  bool flaky = false;
  Scorecard scores;
  std::vector<std::string> notes;
  std::map<std::string, std::string> artifacts;  ///< name -> path relative to the report's folder
};

/// One frame of a run, as in frames.csv. Positions in the truth's world, the live track laid onto
/// the truth with the alignment of the scores.
struct FrameRow {
  std::int64_t id = 0, stamp_ns = 0;
  TrackingState state = TrackingState::kInitializing;
  Eigen::Vector3d truth_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> live_m = {}, final_m = {};
  std::optional<double> live_error_m = {}, final_error_m = {};
  double movers_share = 0, actors_share = 0;
  int features = 0, features_on_movers = 0, inliers_on_movers = 0;
  std::optional<double> mask_iou = {};
  std::optional<int> corners_rejected = {};  ///< image corners under the mask
  Difficulty difficulty = {};
  double render_ms = 0, process_ms = 0;
};

/// A file name whatever a name holds: plain characters stay, a slash becomes a dot, all else an
/// underscore; no leading dot, at most 81 characters.
std::string SafeName(const std::string& name);

/// "scene/twin/system/seed" with the slashes of the scene as dots: "paper.scene2/live/oracle/1".
/// Names a run for `rerun`, and its folder under DIR/runs.
std::string RunId(const RunSpec& spec);

/// "ok", "lost", "crashed", "timeout", "invalid"; the inverse throws std::invalid_argument.
std::string Name(RunStatus status);
RunStatus RunStatusFromName(const std::string& name);

RunRecord MakeRecord(const RunResult& run, double rate_hz, const ScoreOptions& options = {});
std::vector<FrameRow> MakeFrameRows(const RunResult& run, const ScoreOptions& options = {});

std::string ToJson(const RunRecord& record);
/// Throws InputError when the text is no record.
RunRecord RecordFromJson(const std::string& text, const std::string& file);

std::string ToCsv(const std::vector<FrameRow>& rows);
/// Columns are found by name: a file of another version may have more, or lack the optional ones.
/// Throws InputError where a required one is missing or a field is no number.
std::vector<FrameRow> FrameRowsFromCsv(const std::string& text, const std::string& file);

/// A run's frames.csv; empty where there is none (any more): the scores stand without it.
struct FrameFile {
  std::vector<FrameRow> rows;
  std::string trouble;  ///< why there are no rows, where the file is there
};
FrameFile ReadFrameFile(const RunRecord& run, const std::filesystem::path& report_dir);

/// Writes trajectories, frames.csv and, last, result.json into `report_dir`/runs/ID. The record
/// that comes back names the artifacts.
RunRecord WriteRun(const RunResult& run, RunRecord record, const std::filesystem::path& report_dir);

/// A run's result.json, if it is there and whole.
std::optional<RunRecord> ReadRun(const RunSpec& spec, const std::filesystem::path& report_dir);

/// The same, if it answers for these inputs and its trajectories still are what it left: a run
/// that need not be made again.
std::optional<RunRecord> ReadFinishedRun(const RunSpec& spec, const std::string& inputs_hash,
                                         const std::filesystem::path& report_dir);

/// Scores of two runs that differ and should not: all but times and memory, which belong to the
/// machine. One line each; empty for equal bits.
std::vector<std::string> DifferentBits(const RunRecord& a, const RunRecord& b);

}  // namespace aisle
