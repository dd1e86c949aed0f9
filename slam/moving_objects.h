#pragma once

// The second face of the SLAM system, for those who want the rejection of moving objects by itself
// (DynamicDetector) or to look into it: what its stages found, drawn (DrawStages), and where they
// lost a mover (FindLosses). slam/stereo_slam.h does not need it.
#include "slam/dynamic/dynamic_detector.h"  // IWYU pragma: export
#include "slam/dynamic/find_losses.h"       // IWYU pragma: export
#include "slam/picture/draw_stages.h"       // IWYU pragma: export
