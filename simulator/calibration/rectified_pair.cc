#include <opencv2/calib3d.hpp>
#include <opencv2/core/eigen.hpp>
#include <stdexcept>

#include "simulator/calibration/stereo_model.h"

namespace aisle::sim {
namespace {

cv::Matx33d MatrixOf(const CameraModel& camera) {
  return {camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1};
}

}  // namespace

RectifiedPair Rectified(const StereoModel& model) {
  RectifiedPair pair{.width = model.left.width, .height = model.left.height};
  if (model.stated) {
    const auto& [left, right] = *model.stated;
    pair.fx = left.projection(0, 0);
    pair.fy = left.projection(1, 1);
    pair.cx = left.projection(0, 2);
    pair.cy = left.projection(1, 2);
    pair.baseline_m = -right.projection(0, 3) / right.projection(0, 0);
    return pair;
  }
  cv::Matx33d rotation, left_turn, right_turn;
  cv::Vec3d translation;
  cv::eigen2cv(Eigen::Matrix3d(model.T_right_left.linear()), rotation);
  cv::eigen2cv(Eigen::Vector3d(model.T_right_left.translation()), translation);
  cv::Matx34d left, right;
  cv::Matx44d to_depth;
  const cv::Size size(pair.width, pair.height);
  try {
    if (model.left.equidistant) {
      cv::fisheye::stereoRectify(MatrixOf(model.left), model.left.distortion, MatrixOf(model.right),
                                 model.right.distortion, size, rotation, translation, left_turn,
                                 right_turn, left, right, to_depth, cv::CALIB_ZERO_DISPARITY, size);
    } else {
      cv::stereoRectify(MatrixOf(model.left), model.left.distortion, MatrixOf(model.right),
                        model.right.distortion, size, rotation, translation, left_turn, right_turn,
                        left, right, to_depth, cv::CALIB_ZERO_DISPARITY, 0);
    }
  } catch (const cv::Exception& error) {  // of numbers that no rig has
    throw std::runtime_error("its cameras cannot be rectified: " + error.err);
  }
  pair.fx = left(0, 0);
  pair.fy = left(1, 1);
  pair.cx = left(0, 2);
  pair.cy = left(1, 2);
  pair.baseline_m = -right(0, 3) / right(0, 0);
  return pair;
}

}  // namespace aisle::sim
