#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust/label_field.h"
#include "slam/dynamic/robust/robust_options.h"
#include "slam/stereo/dense/semi_global.h"

// The columns from the left on, a number per row of the half-size image, that the right camera does
// not see: its image ends before. What is close by is cut far from the edge of the left image.

namespace aisle::slam::dynamic {

/// How far from its left edge, in half-size pixels, the right image must show something for it to
/// have a disparity for sure: the reach of the matcher on images of half that size.
inline constexpr int kEdgeReach = 2 * kMatchReach;

/// Of each of `rows` rows, by disparities of half their size, in pixels of that: the columns of the
/// nearest thing that the left edge of the right image cuts; 0 where none is known.
std::vector<int> UnseenColumns(const cv::Mat1f& coarse, int rows);

/// Rows that have none, with as many as most rows around: what is cut and cannot be matched in a
/// few rows goes on in them.
std::vector<int> AsMostAround(const std::vector<int>& unseen);

/// Ties together what the `unseen` columns show of the thing that is cut, and to it, whatever is
/// printed on it: nothing can be told of them alone. Its outline is where, from the right on, most
/// rows around have their first link too weak for growth; what lies beyond is not tied to it.
void LinkUnseen(const cv::Mat1f& disparity, const std::vector<int>& unseen,
                const FieldOptions& options, Links* links);

}  // namespace aisle::slam::dynamic
