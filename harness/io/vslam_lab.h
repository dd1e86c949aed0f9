#pragma once

#include <filesystem>
#include <string>

#include "harness/contract/estimate.h"
#include "harness/contract/external.h"
#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

/// VSLAM-LAB's way of starting a system: a sequence folder with rgb_0/, rgb_1/, rgb.csv, imu_0.csv
/// and calibration.yaml, and arguments of the form key:value, or --key value for wrappers in
/// Python. A system that was wrapped for it runs here unchanged. It gets no groundtruth.csv.
struct VslamLabRun {
  std::filesystem::path dataset;  ///< a EuRoC export; the index files are put beside its images
  std::filesystem::path output;   ///< folder for what the system leaves
};

/// Writes rgb.csv, imu_0.csv and calibration.yaml for images that a EuRoC export holds.
void WriteVslamLabFiles(const std::filesystem::path& dataset, const StereoCalibration& calibration,
                        double rate_hz, const std::vector<FrameRequest>& frames,
                        const PathOfRig& path, const ExportOptions& options);

/// Makes rgb_0 and rgb_1 of a EuRoC export's image folders: links to them.
void LinkVslamLabImages(const std::filesystem::path& dataset);

/// "sequence_path:… calibration_yaml:… rgb_csv:… exp_folder:… exp_id:00000 mode:stereo", quoted for
/// the shell; in Python's style "--sequence_path … --exp_it 00000 --mode stereo".
std::string VslamLabArguments(const VslamLabRun& run, VslamLabStyle style);

/// What the trajectory is called that the system leaves in the output folder.
inline constexpr const char* kVslamLabTrajectory = "00000_KeyFrameTrajectory.csv";

/// Rows of stamp, tx, ty, tz, qx, qy, qz, qw, with commas or blanks, after any header. Stamps are
/// nanoseconds ("1600000005900000000", "1.6000000059e+18"), or seconds where they are too small to
/// be that; rows are sorted by them, as VSLAM-LAB does before it scores. Leaves the same as a .tum
/// file beside it, line by line. Throws InputError.
Trajectory ReadVslamLabTrajectory(const std::filesystem::path& file);

}  // namespace aisle
