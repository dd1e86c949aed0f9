#pragma once

#include <map>
#include <string>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"
#include "slam/stereo_slam.h"

namespace aisle {

// The nouns of harness/contract and those of the SLAM, one as the other.

slam::StereoCamera CameraFrom(const StereoCalibration& calibration);

DynamicRegions RegionsFrom(const slam::DynamicRegions& found);

/// Sets all of them by path, the base first: the others differ from what it sets. What is wrong
/// with the first that cannot be set, or an empty string.
std::string SetSlamOptions(const std::map<std::string, std::string>& values,
                           slam::SlamOptions* options);

/// The defaults with these set. Throws InputError for one that cannot be.
slam::SlamOptions SlamOptionsFrom(const std::map<std::string, std::string>& values);

}  // namespace aisle
