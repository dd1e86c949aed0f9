#pragma once

#include <string>
#include <vector>

#include "harness/contract/drive_log.h"

namespace aisle {

/// One system's closed drive in the charts of a scene.
struct DriveSeries {
  std::string name;  ///< and of which seed
  int color = 0;     ///< style of StylesOf
  const DriveLog* log = nullptr;
};

/// The floor from above, equal scales: what stands, the planned route dashed, each vehicle's true
/// way, thinner the way that it believed, its footprint where it was farthest off and where it
/// ended, a cross where it touched something. Empty where there is no drive.
std::string DrivePlanChart(const std::vector<DriveSeries>& series);

/// How far the true vehicle was from its route over time, left positive; bands where it had no pose
/// to steer by or was held, crosses where it touched something.
std::string DriveErrorChart(const std::vector<DriveSeries>& series);

/// The sample in which the true vehicle was farthest from its route; null where there is none.
const DriveSample* WorstSample(const DriveTrack& track);

}  // namespace aisle
