#pragma once

#include "slam/dynamic/dynamic_stages.h"
#include "slam/picture/draw_stages.h"

namespace aisle::slam::picture {

/// The robust method's stages but for the last, numbered from 1: disparity and floor, flow, what
/// the static world leaves of it, evidence of each gap, evidence together, memory, field,
/// probability with the regions' outlines and ids.
std::vector<StagePicture> DrawRobust(const cv::Mat1b& left, const RobustTrace& trace,
                                     const DynamicRegions& regions);

}  // namespace aisle::slam::picture
