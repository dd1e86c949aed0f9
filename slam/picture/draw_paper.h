#pragma once

#include "slam/dynamic/dynamic_stages.h"
#include "slam/picture/canvas.h"
#include "slam/picture/draw_stages.h"

namespace aisle::slam::picture {

/// The colour in which boundaries of this type are drawn.
Colour ColourOf(dynamic::BoundaryType type);

/// The paper's stages but for the last, numbered from 1: points and tracks, disparity, epipolar
/// distances, groups and regions of interest, superpixels, disparity planes, boundary types, rays.
std::vector<StagePicture> DrawPaper(const cv::Mat1b& left, const PaperTrace& trace,
                                    const std::vector<DynamicRegion>& regions);

}  // namespace aisle::slam::picture
