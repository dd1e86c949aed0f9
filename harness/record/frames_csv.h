#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/record/record.h"

namespace aisle {

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

/// One row per frame of the run, with the errors and the alignment of its score.
std::vector<FrameRow> MakeFrameRows(const RunResult& run, const RunScore& score);

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

}  // namespace aisle
