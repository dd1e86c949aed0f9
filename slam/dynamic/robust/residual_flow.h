#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust/dense_frame.h"
#include "slam/dynamic/robust/ego_motion.h"
#include "slam/dynamic/robust/label_memory.h"
#include "slam/dynamic/robust/robust_options.h"
#include "slam/flow/flow_pyramid.h"

namespace aisle::slam::dynamic {

/// Where every pixel of an image was in an earlier one, whatever moved (half-size pixels): the
/// earlier image is first brought to the view in which every pixel comes from its expected place,
/// so that only what that leaves unexplained has to be found. `pyramid` is that of the image.
cv::Mat2f FollowBack(const cv::Mat1b& now, const FlowPyramid& pyramid, const cv::Mat1b& then,
                     const cv::Mat2f& expected, const DenseFlowOptions& options);

/// The earlier image at the given places; the image's border is repeated outside.
cv::Mat1b SampleAt(const cv::Mat1b& image, const cv::Mat2f& places);

/// One pixel of each cell: where the texture holds best, by the smaller eigenvalue of the structure
/// tensor (Shi and Tomasi 1994), of those with a disparity.
std::vector<cv::Point> WellHeld(const Texture& texture, const cv::Mat1f& disparity, int cell_px);

/// Points measured in both frames; full pixels. Each is followed by itself from where the flow
/// leads and from where it is expected, whichever fits better: beside something large that moves,
/// the flow is not its own. What is known of the current pixels sets their weight: the log-odds of
/// moving, and that a region that moves has come there, in which none has more than
/// `trust_in_region`.
std::vector<StereoMatch> MatchesAlong(const std::vector<cv::Point>& points, const cv::Mat2f& flow,
                                      const cv::Mat2f& expected, const DenseFrame& now,
                                      const DenseFrame& then, const LabelMemory& memory,
                                      double trust_in_region);

}  // namespace aisle::slam::dynamic
