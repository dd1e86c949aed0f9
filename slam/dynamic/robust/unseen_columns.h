#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust/label_field.h"
#include "slam/dynamic/robust/robust_options.h"

// The columns from the left on, a number per row of the half-size image, that the right camera does
// not see of something close by: its image ends before.

namespace aisle::slam::dynamic {

/// Rows that have none, with as many as most rows around: something close by that cannot be
/// matched in a few rows goes on in them.
std::vector<int> AsMostAround(const std::vector<int>& unseen);

/// Ties together what the `unseen` columns show of something close by, and to it, whatever is
/// printed on it: nothing can be told of them alone. Its outline is where, from the right on, most
/// rows around have their first link too weak for growth; what lies beyond is not tied to it.
void LinkUnseen(const cv::Mat1f& disparity, const std::vector<int>& unseen,
                const FieldOptions& options, Links* links);

}  // namespace aisle::slam::dynamic
