#pragma once

#include <filesystem>
#include <string>

#include "harness/contract/estimate.h"
#include "harness/contract/sequence.h"

namespace aisle {

/// VSLAM-LAB's way of starting a system: a sequence folder with rgb.csv and calibration.yaml, and
/// arguments of the form key:value. A system that was wrapped for it runs here unchanged.
struct VslamLabRun {
  std::filesystem::path dataset;  ///< a EuRoC export; the index files are put beside its images
  std::filesystem::path output;   ///< folder for what the system leaves
};

/// Writes rgb.csv, calibration.yaml and groundtruth.csv for images that a EuRoC export holds.
void WriteVslamLabFiles(const std::filesystem::path& dataset, const StereoCalibration& calibration,
                        double rate_hz, const std::vector<FrameRequest>& frames,
                        std::int64_t epoch_ns);

/// "sequence_path:… calibration_yaml:… rgb_csv:… exp_folder:… exp_id:00000 … mode:stereo", quoted
/// for the shell.
std::string VslamLabArguments(const VslamLabRun& run);

/// Where the system leaves its trajectory: 00000_KeyFrameTrajectory.csv in the output folder.
std::filesystem::path VslamLabTrajectoryPath(const VslamLabRun& run);

/// Rows of stamp, tx, ty, tz, qx, qy, qz, qw, with commas or blanks, after any header. Stamps are
/// nanoseconds, or seconds where they are too small to be that. Leaves the same as a .tum file
/// beside it, line by line. Throws InputError.
Trajectory ReadVslamLabTrajectory(const std::filesystem::path& file);

}  // namespace aisle
