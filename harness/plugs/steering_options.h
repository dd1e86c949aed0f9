#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/contract/run.h"
#include "harness/contract/steering.h"
#include "harness/contract/system_option.h"

namespace aisle {

// How a system steers in scenes with a `drive` is told by options of its own: "drive.latency_ms"
// and the like, beside those of the SLAM.

using OptionTexts = std::map<std::string, std::string>;  ///< by path

/// "drive." and more.
bool IsSteeringOption(const std::string& path);

/// Every one of them with its value.
std::vector<SystemOption> DescribeSteering(const Steering& steering);

/// What is wrong with one and its value, or an empty string.
std::string CheckSteeringOption(const std::string& path, const std::string& value);

/// Those among the options. Throws InputError for one that is wrong.
Steering SteeringOf(const OptionTexts& options);

/// The options that are none of them.
OptionTexts WithoutSteering(const OptionTexts& options);

/// The run in which a system is taught its way (Steering::taught): nobody is there, and neither its
/// name nor how it will steer counts. Runs that are led alike are taught the same.
RunSpec AsLed(RunSpec spec);

}  // namespace aisle
