#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "slam/camera/stereo_camera.h"

namespace aisle::slam {

struct DynamicStages;

/// One thing that moves in the left image, as the caller knows it.
struct MoverTruth {
  cv::Mat1b pixels;  ///< 255 = shows it; size of the image
  cv::Rect box;      ///< around them
};

/// For each of the movers the step of the method at which it was lost, given that it was not found:
/// the first of these, in the method's order, that holds. Of the paper's method
///
///   "few points"       fewer points followed on it than make a group
///   "no disparity"     enough of them, too few where disparity is known
///   "along its line"   too few leave their epipolar lines, and those of the true motion as well
///   "wrong lines"      too few leave their epipolar lines; enough leave those of the true motion
///   "not one group"    enough dynamic points on it, none of them in a group of the least size
///   "no outline"       grouped; the rays of its points met no occlusion boundaries
///   "in parts"         rectangles that fit it together and none alone
///   "outline too small", "outline too large"   rectangles that do not fit it even together
///
/// `T_now_before` is the true motion of the rig since the frame before; of one that stood or turned
/// on the spot, which has no epipolar lines, a point's line is the place where the rotation alone
/// puts it. Rectangles fit from an overlap (intersection over union) of one half on. Empty where
/// the stages are of a method that cannot tell, or where it had no past.
std::vector<std::string> FindLosses(const DynamicStages& stages, const StereoCamera& camera,
                                    const std::vector<MoverTruth>& movers,
                                    const Eigen::Isometry3d& T_now_before);

}  // namespace aisle::slam
