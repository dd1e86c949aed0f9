#pragma once

#include <opencv2/core.hpp>

#include "slam/dynamic/robust/disparity_tolerance.h"

namespace aisle::slam::dynamic {

/// How strongly each pixel is tied to the next one of its row and to the one below, in log-odds.
struct Links {
  cv::Mat1f right, down;
};

/// Ties within a surface, as the contrast-sensitive ones of Boykov and Jolly (2001): weak across a
/// step of disparity (halved by the tolerance, and soon none) or of grey, and none between the
/// floor and what stands on it.
Links LinkPixels(const cv::Mat1f& filled, const cv::Mat1b& image, const cv::Mat1b& floor,
                 const DisparityTolerance& tolerance, const FieldOptions& options);

/// Sweeps over the image, there and back twice: what more of them change is not seen in any mask.
inline constexpr int kSweeps = 4;

/// Log-odds of moving per pixel given its own evidence and its neighbours': mean-field sweeps in
/// alternating raster order, with a belief that is linear around zero and saturates.
cv::Mat1f SolveField(const cv::Mat1f& evidence, const Links& links);

/// 255 for the pixels that move: those of the field above `moving`, and what can be reached from
/// the surer ones along strong links through pixels whose own evidence does not speak against it,
/// in steps up to `farthest` (per pixel). So plain cloth joins the seams that were seen to move.
cv::Mat1b GrowMoving(const cv::Mat1f& field, const cv::Mat1f& evidence, const Links& links,
                     const cv::Mat1b& floor, const cv::Mat1f& farthest,
                     const FieldOptions& options);

}  // namespace aisle::slam::dynamic
