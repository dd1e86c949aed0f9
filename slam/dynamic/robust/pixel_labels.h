#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/common/dynamic_regions.h"
#include "slam/dynamic/robust/moving_regions.h"
#include "slam/dynamic/robust/step.h"

namespace aisle::slam::dynamic {

/// Which pixels move, and what they make up.
struct PixelLabels {
  cv::Mat1f field;         ///< log-odds of moving per half-size pixel, with the neighbours' share
  PixelRegions regions;    ///< half-size pixels
  DynamicRegions dynamic;  ///< the same, full size, parts of one mover joined
  cv::Mat1f probability;   ///< of moving, per pixel of the left image
};

/// Labels pixels by their log-odds of moving, known so far, and by how they hang together: a Markov
/// random field over `layout.links` (SolveField), grown into what says nothing (GrowMoving), and
/// parted into regions (FindRegions). `previous` are the regions of the frame before, carried to
/// this one.
PixelLabels LabelPixels(const Step& step, const Layout& layout, const cv::Mat1f& log_odds,
                        const PixelRegions& previous);

}  // namespace aisle::slam::dynamic
