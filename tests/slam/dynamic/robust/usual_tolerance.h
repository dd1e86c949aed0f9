#pragma once

#include "slam/dynamic/robust/disparity_tolerance.h"

namespace aisle::slam::test {

/// As it is with the noise that is learned on rendered drives.
inline const dynamic::DisparityTolerance kUsualTolerance({.sigmas = 2, .share = 0.04}, 0.16);

}  // namespace aisle::slam::test
