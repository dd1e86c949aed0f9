#pragma once

#include <memory>

#include "harness/contract/sequence.h"
#include "harness/io/dataset.h"

namespace aisle {

/// A recording as a sequence: images are rectified where the calibration says they are distorted or
/// not parallel (cv::stereoRectify, alpha 0). Where truth is known within half a frame, it comes
/// with the frame as pose only. Throws InputError for cameras that differ in size or an image that
/// does not fit its calibration.
std::unique_ptr<Sequence> OpenRecording(const std::filesystem::path& folder, DatasetFormat format);

}  // namespace aisle
