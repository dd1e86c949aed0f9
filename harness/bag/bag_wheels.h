#pragma once

#include <string>

#include "harness/bag/bag.h"
#include "harness/contract/wheel_track.h"

namespace aisle {

/// What the wheels of a recorded vehicle measured: a topic of nav_msgs/Odometry, by header stamp.
/// The left camera stands where /tf_static has it: from the messages' child_frame_id to the frame
/// of the images on `left_topic`. A motion's covariance is that of the twists between, times the
/// squares of their times, where all of the messages give one (SaysCovariance). `file` is what
/// messages call the bag. Throws InputError: no such topic, a damaged message, poses without
/// stamps, covariances that no motion can have, frames that no static transform joins.
WheelTrack ReadBagWheels(const Bag& bag, const std::string& topic, const std::string& left_topic,
                         const std::string& file);

}  // namespace aisle
