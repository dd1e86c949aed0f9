#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/feature/feature_options.h"

namespace aisle::slam {

/// A FAST corner of one pyramid level.
struct Corner {
  int x = 0, y = 0;    ///< pixels of the level
  float response = 0;  ///< FAST score, grey levels
};

/// FAST-9 corners (Rosten and Drummond 2006) with non-maximum suppression, by rising (y, x). Where
/// a cell of the options' grid has none at the first threshold, it is searched again at the low
/// one. None that lies on a straight edge: noise makes corners of it anywhere along, which all look
/// alike and go with a rig that drives along it.
std::vector<Corner> DetectCorners(const cv::Mat1b& level, const FeatureOptions& options);

}  // namespace aisle::slam
