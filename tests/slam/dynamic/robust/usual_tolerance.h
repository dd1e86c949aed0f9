#pragma once

#include "slam/dynamic/robust/disparity_tolerance.h"

namespace aisle::slam::dynamic::test {

/// As it is with the noise that is learned on rendered drives.
inline const DisparityTolerance kUsualTolerance({}, 0.16);

}  // namespace aisle::slam::dynamic::test
