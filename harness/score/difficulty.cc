#include "harness/score/difficulty.h"

#include <opencv2/imgproc.hpp>

#include "harness/score/statistics.h"

namespace aisle {
namespace {

/// Least difference of grey levels within 5x5 pixels that gives a feature something to hold on to;
/// FAST's threshold in the front end is of this size.
constexpr int kTextureLevels = 16;

std::optional<double> StaticTextureShare(const cv::Mat1b& left, const cv::Mat1b& dynamic) {
  if (left.empty() || dynamic.size() != left.size()) return std::nullopt;
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {5, 5});
  cv::Mat1b contrast, textured, still;
  cv::morphologyEx(left, contrast, cv::MORPH_GRADIENT, window);
  cv::compare(contrast, kTextureLevels, textured, cv::CMP_GE);
  cv::compare(dynamic, 0, still, cv::CMP_EQ);
  cv::bitwise_and(textured, still, textured);
  return cv::countNonZero(textured) / static_cast<double>(left.total());
}

struct Motion {
  double flow_px = 0;
  double parallax_px = 0;
};

/// Where a surface point seen now stood in the picture before, with and without the turn between.
std::optional<Motion> MotionOf(const Eigen::Vector3d& p_now, const Eigen::Isometry3d& T_before_now,
                               const StereoCalibration& c) {
  const Eigen::Vector3d before = T_before_now * p_now, turned = T_before_now.linear() * p_now;
  if (before.z() <= 0 || turned.z() <= 0) return std::nullopt;
  const auto project = [&](const Eigen::Vector3d& p) {
    return Eigen::Vector2d(c.fx * p.x() / p.z(), c.fy * p.y() / p.z());
  };
  return Motion{(project(before) - project(p_now)).norm(),
                (project(before) - project(turned)).norm()};
}

}  // namespace

cv::Mat1f DepthGrid(const cv::Mat1f& depth) {
  cv::Mat1f grid((depth.rows + kDepthGridStep - 1) / kDepthGridStep,
                 (depth.cols + kDepthGridStep - 1) / kDepthGridStep);
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.cols; ++x) {
      grid(y, x) = depth(y * kDepthGridStep, x * kDepthGridStep);
    }
  }
  return grid;
}

Difficulty DifficultyOf(const cv::Mat1b& left, const FrameTruth& truth,
                        const StereoCalibration& calibration,
                        const std::optional<Eigen::Isometry3d>& T_world_previous, double frame_ms) {
  Difficulty difficulty;
  difficulty.static_texture_share = StaticTextureShare(left, truth.dynamic);
  const cv::Mat1f grid = truth.depth.empty() ? truth.depth_grid : DepthGrid(truth.depth);
  if (grid.empty() || !T_world_previous) return difficulty;
  const Eigen::Isometry3d T_before_now = T_world_previous->inverse() * truth.T_world_rig;
  std::vector<double> flow, parallax;
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.cols; ++x) {
      const double z = grid(y, x);
      const int v = y * kDepthGridStep, u = x * kDepthGridStep;
      if (!std::isfinite(z) || (!truth.dynamic.empty() && truth.dynamic(v, u) != 0)) continue;
      const Eigen::Vector3d p(z * (u - calibration.cx) / calibration.fx,
                              z * (v - calibration.cy) / calibration.fy, z);
      if (const std::optional<Motion> motion = MotionOf(p, T_before_now, calibration)) {
        flow.push_back(motion->flow_px);
        parallax.push_back(motion->parallax_px);
      }
    }
  }
  if (flow.empty()) return difficulty;
  difficulty.flow_px = Quantile(flow, 0.5);
  difficulty.blur_px = *difficulty.flow_px * truth.smear_ms / frame_ms;
  difficulty.parallax_px = Quantile(parallax, 0.5);
  return difficulty;
}

}  // namespace aisle
