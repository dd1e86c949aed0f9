#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/io/dataset.h"

namespace aisle {

/// A frame on its way into a dataset. `motion` may be null where the selection needs none.
struct FrameForExport {
  const SequenceFrame& frame;
  const FrameMotion* motion;
  std::int64_t number;    ///< in the dataset, from 0
  std::int64_t stamp_ns;  ///< as the dataset's images have it
};

/// A kind of truth file: its folder below truth/ and its ending, and how it is written.
struct TruthFile {
  const char* kind;
  const char* ending;
  std::function<void(const std::filesystem::path&, const FrameForExport&)> write;
};

/// All files of a frame's truth that the selection asks for.
std::vector<TruthFile> TruthFiles(const ExportOptions& options);

/// 16 numbers, row by row.
nlohmann::ordered_json PoseToJson(const Eigen::Isometry3d& pose);

/// labels.json: what the ids in the label images are.
std::string LabelsJson(const std::vector<LabelInfo>& labels);

/// README.md below truth/: formats, channels, units and frames of every kind, for a reader of the
/// folder who has nothing else at hand.
std::string TruthReadme(DatasetFormat format);

/// Metres times `per_metre` in 16 bits, 0 where there is nothing or it lies beyond the range.
cv::Mat1w DepthInSteps(const cv::Mat1f& depth, double per_metre);

}  // namespace aisle
