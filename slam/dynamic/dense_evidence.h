#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/robust_options.h"

namespace aisle::slam::dynamic {

/// Half-size pixels along the side of a node of the label field.
inline constexpr int kNodeHalfPixels = 2;

/// What one frame leaves behind for the dense comparison, all of half size.
struct DenseFrame {
  cv::Mat1b image;
  cv::Mat1f detail;     ///< grey values less their local mean: exposure and soft shadows drop out
  cv::Mat1f disparity;  ///< half-size pixels, kNoDisparity where unknown
  cv::Mat1b edge;  ///< 255 near a step of disparity: half of what is seen there is another surface
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
};

/// Measured noise of the comparison.
struct DenseNoise {
  double intensity = 2.5;     ///< grey levels, one pixel of detail
  double disparity_px = 0.3;  ///< half-size pixels
};

/// The camera whose pixels are 2x2 of the given one's.
StereoCamera HalfCamera(const StereoCamera& camera);

/// Image and detail from a half-size image; disparity is given.
DenseFrame MakeDenseFrame(const cv::Mat1b& half_image, const cv::Mat1f& half_disparity);

struct DenseEvidence {
  cv::Mat1f log_odds;   ///< of moving, per node, before any limit; 0 where nothing is known
  DenseNoise measured;  ///< the noise that this comparison would call for
  bool noise_known = false;
};

/// Compares every pixel with what an earlier frame shows of the same surface, were it static: its
/// surface is taken back by the rig's motion; where that frame saw the same depth, the details must
/// agree within noise, else they are two independent samples of the local texture; where it looked
/// through to something farther, the surface has come since; where something nearer stood before
/// it, nothing is known.
DenseEvidence CompareWithEarlier(const DenseFrame& now, const DenseFrame& then,
                                 const Eigen::Isometry3d& T_then_now, const StereoCamera& half,
                                 const DenseNoise& noise, const EvidenceOptions& options);

}  // namespace aisle::slam::dynamic
