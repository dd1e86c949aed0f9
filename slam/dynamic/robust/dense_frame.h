#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/robust/robust_options.h"
#include "slam/stereo/dense/semi_global_options.h"

namespace aisle::slam::dynamic {

/// What one frame leaves behind for comparison, all of half size.
struct DenseFrame {
  cv::Mat1b image;
  /// What the right image shows within half a pixel of each of its own, along the row.
  cv::Mat1b right_low, right_high;
  cv::Mat1f disparity;  ///< half-size pixels, kNoDisparity where unknown
  cv::Mat1f filled;     ///< the same without gaps: the farther side of each gap of a row
  /// Of each row, the columns from the left on that the right camera does not see, see
  /// UnseenColumns.
  std::vector<int> unseen;
  std::int64_t stamp_ns = 0;
  int number = 0;  ///< counts frames since the way back was lost
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();  ///< by the motions found
};

/// The structure tensor (Foerstner and Guelch 1987), per pixel: information on where a window is,
/// the sum of gradient products over the variance of the difference of two images, in 1 / squared
/// pixels, less what noise alone would give.
struct Texture {
  cv::Mat1f xx, xy, yy;
};

/// The camera whose pixels are 2x2 of the given one's.
StereoCamera HalfCamera(const StereoCamera& camera);

/// The means of 2x2 pixels; an odd last column or row is left out.
cv::Mat1b HalfImage(const cv::Mat1b& image);

/// The same, less the noise that the image itself shows and the method does not count with: in
/// usual light nothing, as what is fainter than usual noise may be the texture of a floor.
cv::Mat1b QuietHalfImage(const cv::Mat1b& image, const SurfaceOptions& options);

/// Disparity of images that are of half size already, without the columns where the matcher saw
/// only padding.
DenseFrame MakeDenseFrame(const cv::Mat1b& left, const cv::Mat1b& right,
                          const SemiGlobalOptions& disparity);

/// Variance of the difference of two measurements of each grey value.
cv::Mat1f DifferenceVariance(const cv::Mat1b& image, const SurfaceOptions& options);

Texture MeasureTexture(const cv::Mat1b& image, const SurfaceOptions& options);

/// Each gap of a row gets the lower of the values on its two sides: what the matcher could not see
/// lies behind, but for what goes on into its row's `unseen` columns. 0 where a row holds nothing.
cv::Mat1f FillRows(const cv::Mat1f& disparity, const std::vector<int>& unseen = {});

/// Where the pixels of a frame were in an earlier one, and their disparity there, were they static.
struct StaticField {
  cv::Mat2f place;          ///< half-size pixels of the earlier frame
  cv::Mat1f disparity;      ///< <= 0 behind the camera
  cv::Mat2f per_disparity;  ///< derivative of the place by the disparity, now
};
StaticField WhereStatic(const cv::Mat1f& filled, const Eigen::Isometry3d& T_then_now,
                        const StereoCamera& half);

}  // namespace aisle::slam::dynamic
