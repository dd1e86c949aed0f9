#pragma once

#include <optional>

#include "harness/bag/bag.h"
#include "harness/io/dataset.h"

namespace aisle {

struct BagRecordingOptions {
  /// Left and right image, as the bag calls them; empty: found by their types and names.
  std::vector<std::string> topics = {};
  std::optional<double> baseline_m = {};  ///< instead of what camera_info says
  std::string odometry = {};              ///< topic of what the wheels measured; empty: none
  /// Instead of camera_info, for bags without: both cameras as a calibration file states them.
  std::optional<StereoCameras> cameras = {};
};

/// A stereo recording in a bag. Images by type (Image, CompressedImage), left and right by their
/// names, paired by header stamp within 1 ms. Each eye's camera_info is its topic's sibling: on a
/// rectified topic (a word of its name is "rect" or "rectified", or no distortion and no turn) `p`
/// alone counts, on a raw one k, d, r and p say how it is rectified. The baseline is -p[3] / p[0]
/// of the right camera. Truth is /truth/pose where the bag is one of ours. Throws InputError naming
/// topics, what is wrong and its cure.
StereoRecording ReadBagRecording(const std::filesystem::path& file,
                                 const BagRecordingOptions& options);

}  // namespace aisle
