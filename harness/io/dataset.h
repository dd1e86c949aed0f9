#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/contract/sequence.h"
#include "harness/io/trajectory.h"

namespace aisle {

enum class DatasetFormat {
  kEuroc,  ///< ASL: mav0/{cam0, cam1, imu0, state_groundtruth_estimate0}
  kKitti,  ///< odometry: sequences/00/{image_0, image_1}, poses/00.txt
  kTum,    ///< RGB-D folder with the right eye beside: rgb, right, depth
};
/// "euroc", "kitti", "tum"; throws InputError naming the choices.
DatasetFormat DatasetFormatFromName(const std::string& name);

/// Which truth is written beside the images, below truth/.
struct TruthSelection {
  bool depth = false;    ///< PFM, float metres, inf where nothing was hit
  bool labels = false;   ///< instance ids, 16-bit PNG
  bool dynamic = false;  ///< what moves now and every actor, 8-bit PNG, 255 = yes
  bool boxes = false;    ///< boxes.json: per frame and object 2-D boxes, centre, velocity
};
/// "depth,labels,dynamic,boxes" in any order, or "all"; throws InputError.
TruthSelection TruthSelectionFromNames(const std::vector<std::string>& names);

struct ExportOptions {
  DatasetFormat format = DatasetFormat::kEuroc;
  TruthSelection truth = {};
  /// Added to every stamp of EuRoC and TUM: readers treat 0 as missing. 2020-09-13T12:26:40Z.
  std::int64_t epoch_ns = 1'600'000'000'000'000'000;
  double imu_rate_hz = 200;
};

/// Pose of the rig between frames, for the ideal IMU: T_world_rig at a time from the start.
using PathOfRig = std::function<Eigen::Isometry3d(std::int64_t stamp_ns)>;

/// Writes frames as they come; every image is whole or absent, and one that is there already is
/// kept. The index files are written by Finish, last: without them the folder is no dataset yet.
class DatasetWriter {
 public:
  DatasetWriter(std::filesystem::path folder, const StereoCalibration& calibration, double rate_hz,
                const ExportOptions& options);

  /// All files of this frame are already there.
  bool Has(const FrameRequest& request) const;
  /// Needs truth; throws std::invalid_argument without, or without depth where depth was asked for.
  void Add(const SequenceFrame& frame);
  /// `frames` are all frames of the dataset in order, kept ones included.
  void Finish(const std::vector<FrameRequest>& frames, const PathOfRig& path) const;

 private:
  std::vector<std::filesystem::path> ImagePaths(const FrameRequest& request) const;
  void AddTruth(const SequenceFrame& frame);

  const std::filesystem::path folder_;
  const StereoCalibration calibration_;
  const double rate_hz_;
  const ExportOptions options_;
};

/// Where a system finds the true trajectory and the calibration of an exported dataset.
std::filesystem::path CalibrationPath(const std::filesystem::path& folder, DatasetFormat format);

// --- Reading
// --------------------------------------------------------------------------------------

/// One eye of a recording as its calibration file states it.
struct EyeCalibration {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::vector<double> distortion;  ///< radial-tangential k1 k2 p1 p2; empty: none
  Eigen::Isometry3d T_body_eye = Eigen::Isometry3d::Identity();
};

struct StereoRecording {
  EyeCalibration left, right;
  struct Pair {
    std::int64_t stamp_ns = 0;
    std::filesystem::path left, right;
  };
  std::vector<Pair> pairs;
  Trajectory truth;  ///< empty where the dataset has none
};

/// EuRoC (the folder that holds mav0, or mav0 itself) or KITTI odometry (a sequence's folder, or
/// the one that holds sequences/NN with a single sequence). Pairs images by stamp, not by position.
/// Throws InputError with file, line and what is missing.
StereoRecording ReadRecording(const std::filesystem::path& folder, DatasetFormat format);

}  // namespace aisle
