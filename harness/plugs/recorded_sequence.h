#pragma once

#include <memory>

#include "harness/bag/bag_recording.h"
#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

/// A recording as a sequence: images are rectified as the recording itself states it, else where
/// the calibration says they are distorted or not parallel (cv::stereoRectify, alpha 0). Where
/// truth is known within half a frame, it comes with the frame as pose only. Throws InputError for
/// cameras that differ in size or an image that does not fit its calibration. `source` is what
/// messages call the recording.
std::unique_ptr<Sequence> MakeRecordedSequence(StereoRecording recording, const std::string& source,
                                               const std::string& name);

/// A folder in one of the formats.
std::unique_ptr<Sequence> OpenRecording(const std::filesystem::path& folder, DatasetFormat format);

/// A bag of ROS 2.
std::unique_ptr<Sequence> OpenBagRecording(const std::filesystem::path& file,
                                           const BagRecordingOptions& options);

}  // namespace aisle
