#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/robust_options.h"

namespace aisle::slam::dynamic {

/// How strongly each node is tied to the next one: large within a surface, next to nothing across a
/// step of disparity, in log-odds.
struct NodeLinks {
  cv::Mat1f right, down;
};

/// Disparity of every node (half-size pixels): the median of its known pixels, holes filled from
/// the farther of the known neighbours in the row, as holes are mostly what a nearer surface hides.
cv::Mat1f NodeDisparity(const cv::Mat1f& half_disparity);

/// Links from node disparities and the half-size image.
NodeLinks LinkNodes(const cv::Mat1f& node_disparity, const cv::Mat1b& half_image,
                    const FieldOptions& options);

/// Log-odds of every node given its own evidence and its neighbours': a mean-field approximation of
/// a pairwise random field, solved by sweeps in a fixed order.
cv::Mat1f SolveField(const cv::Mat1f& evidence, const NodeLinks& links,
                     const FieldOptions& options);

}  // namespace aisle::slam::dynamic
