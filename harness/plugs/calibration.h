#pragma once

#include <string>
#include <vector>

#include "harness/io/dataset.h"

namespace aisle {

/// A rig out of calibration files: Kalibr's camchain, OpenCV's, KITTI's calib.txt, or the left and
/// the right of EuRoC's sensor.yaml or ROS's camera_info. The body is the left camera. Throws
/// InputError.
StereoCameras ReadCalibration(const std::vector<std::string>& files);

}  // namespace aisle
