#pragma once

#include <cstdint>

#include "harness/contract/drive_log.h"
#include "harness/contract/steering.h"
#include "harness/loop/localiser.h"
#include "harness/loop/scanner.h"

namespace aisle {

struct LoopOptions {
  Steering steering;
  std::uint64_t seed = 1;             ///< of the odometry and the latency profile
  std::int64_t tick_ns = 10'000'000;  ///< of control
  ScannerOptions scanner = {};
  double stands_still_s = 30;  ///< without progress for so long, pauses aside: the end
  double times_planned = 3;    ///< the end after so many times the planned time,
  double and_s = 60;           ///< and so much more
};

/// What is wrong with how a system steers, or an empty string.
std::string Validate(const Steering& steering);

/// Drives the vehicle through the course, steered by what the localiser says: in ticks of control,
/// plant, traffic, wheels and camera in one thread, in a time that no clock decides. Of `steering`,
/// `steered_by_truth` shows the frames to `localiser` and steers by their true pose.
DriveTrack DriveClosed(const DriveScene& scene, Localiser* localiser, const LoopOptions& options);

/// What a log says of a course and how it was driven; tracks left aside.
DriveLog LogOf(const Course& course, const Steering& steering);

}  // namespace aisle
