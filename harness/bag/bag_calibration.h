#pragma once

#include <optional>

#include "harness/bag/bag.h"
#include "harness/bag/stereo_topics.h"
#include "harness/io/dataset.h"

namespace aisle {

/// What the camera_info beside two image topics says of the rig. `baseline_m` counts instead of
/// theirs. Throws InputError: none there, not calibrated, binned, numbers that no camera has, a
/// baseline that is missing or has the wrong sign, with what the bag's /tf_static says of it.
StereoCameras CamerasOfBag(const Bag& bag, const StereoTopics& topics,
                           std::optional<double> baseline_m, const std::string& file);

}  // namespace aisle
