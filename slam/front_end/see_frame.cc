#include "slam/front_end/see_frame.h"

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "slam/common/parallel.h"
#include "slam/common/stopwatch.h"
#include "slam/stereo/match_stereo.h"

namespace aisle::slam {
namespace {

Measurement Measure(const Keypoint& keypoint, const Disparity& disparity, double sigma_px,
                    bool equal_columns, const cv::Mat1f& confidence) {
  constexpr float kLeast = 1e-4F;  // a pixel worth nothing belongs under a mask
  const float trust = confidence.empty() ? 1.0F : confidence(cv::Point(keypoint.pixel));
  const double widen = 1 / std::sqrt(std::clamp(trust, kLeast, 1.0F));
  Measurement measurement{{keypoint.pixel.x, keypoint.pixel.y, disparity.value},
                          widen * sigma_px,
                          widen * disparity.sigma};
  if (equal_columns && measurement.has_depth()) {
    measurement.sigma_d = measurement.sigma_px;
    measurement.u_in_d = 1;
  }
  return measurement;
}

/// The frame of a camera's features, without patches.
Frame FrameOf(const StereoImages& images, Features features, std::vector<Measurement> measurements,
              double scale) {
  Frame frame;
  frame.id = images.id;
  frame.stamp_ns = images.stamp_ns;
  frame.scale = scale;
  frame.measurements = std::move(measurements);
  frame.grid = FeatureGrid(features.keypoints, images.left.size());
  frame.features = std::move(features);
  return frame;
}

double SigmaPx(const ImageFeatures& seen, const Keypoint& keypoint, const SlamOptions& options) {
  return seen.pyramid.scales[static_cast<std::size_t>(keypoint.level)] * options.keypoint_noise_px;
}

/// The left camera's features, and what they measure with the disparities found of them.
Frame LeftFrameOf(const StereoImages& images, ImageFeatures left,
                  const std::vector<Disparity>& disparities, const cv::Mat1f& confidence,
                  const SlamOptions& options) {
  std::vector<Measurement> measurements;
  for (std::size_t i = 0; i < disparities.size(); ++i) {
    const Keypoint& keypoint = left.features.keypoints[i];
    measurements.push_back(Measure(keypoint, disparities[i], SigmaPx(left, keypoint, options),
                                   options.equal_columns, confidence));
  }
  const bool aligns = options.base == Base::kPlain && options.track.patch.radius_px > 0;
  std::vector<FeaturePatch> patches;
  if (aligns) patches = CutPatches(left);
  Frame frame =
      FrameOf(images, std::move(left.features), std::move(measurements), options.feature.scale);
  frame.patches = std::move(patches);
  return frame;
}

/// The right camera's features, and what they measure by themselves.
Frame RightFrameOf(const StereoImages& images, ImageFeatures right, const SlamOptions& options) {
  std::vector<Measurement> measurements;
  for (const Keypoint& keypoint : right.features.keypoints) {
    measurements.push_back({.uvd = {keypoint.pixel.x, keypoint.pixel.y, 0},
                            .sigma_px = SigmaPx(right, keypoint, options),
                            .right = true});
  }
  return FrameOf(images, std::move(right.features), std::move(measurements), options.feature.scale);
}

}  // namespace

void CheckImages(const StereoImages& images, const ExternalMask& mask, const StereoCamera& camera) {
  const cv::Size size(camera.width, camera.height);
  const auto check = [&](const cv::Mat& image, const char* name, bool may_be_empty) {
    if (image.size() == size || (may_be_empty && image.empty())) return;
    throw std::invalid_argument(fmt::format("frame {}: {} is {}x{}, the camera {}x{} pixels",
                                            images.id, name, image.cols, image.rows, size.width,
                                            size.height));
  };
  check(images.left, "the left image", false);
  check(images.right, "the right image", false);
  check(mask.left, "the left mask", true);
  check(mask.right, "the right mask", true);
  check(mask.confidence, "the confidence", true);
  cv::Point at;
  if (mask.confidence.empty() || cv::checkRange(mask.confidence, true, &at)) return;
  throw std::invalid_argument(
      fmt::format("frame {}: the confidence at pixel ({}, {}) is {}; it must be 0 to 1", images.id,
                  at.x, at.y, mask.confidence(at)));
}

void CheckMotion(const MeasuredMotion& motion) {
  const Matrix6d& covariance = motion.covariance;
  if (!motion.T_now_before.matrix().allFinite() || !covariance.allFinite()) {
    throw std::invalid_argument("the measured motion or its covariance is not finite");
  }
  const double asymmetry = (covariance - covariance.transpose()).cwiseAbs().maxCoeff();
  const bool definite = Eigen::LLT<Matrix6d>(covariance).info() == Eigen::Success;
  if (!definite || asymmetry > 1e-9 * covariance.norm()) {
    throw std::invalid_argument(
        "the covariance of the measured motion is not symmetric and positive definite: every "
        "direction needs some uncertainty");
  }
}

bool TellsOfBoth(const ExternalMask& mask) {
  return mask.confidence.empty() && (mask.left.empty() || !mask.right.empty());
}

cv::Mat1b Union(const cv::Mat1b& a, const cv::Mat1b& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  cv::Mat1b both;
  cv::bitwise_or(a, b, both);
  return both;
}

StereoCorners FindStereoCorners(const StereoImages& images, const FeatureOptions& options) {
  StereoCorners corners;
  ParallelInvoke([&] { corners.left = FindCorners(images.left, options); },
                 [&] { corners.right = FindCorners(images.right, options); });
  return corners;
}

Frame SeeLeft(const StereoImages& images, ImageCorners corners, const ExternalMask& mask,
              const SlamOptions& options) {
  ImageFeatures left = ChooseFeatures(std::move(corners), mask.left, options.feature);
  const std::vector<Disparity> unknown(left.features.keypoints.size());
  return LeftFrameOf(images, std::move(left), unknown, mask.confidence, options);
}

StereoSight SeeFrame(const StereoImages& images, StereoCorners corners, const ExternalMask& mask,
                     const StereoCamera& camera, const SlamOptions& options,
                     std::map<std::string, double>& stage_ms) {
  ImageFeatures left, right;
  {
    Stopwatch time(stage_ms["extract"]);
    ParallelInvoke(
        [&] { left = ChooseFeatures(std::move(corners.left), mask.left, options.feature); },
        [&] { right = ChooseFeatures(std::move(corners.right), mask.right, options.feature); });
  }
  Stopwatch time(stage_ms["stereo"]);
  const std::vector<Disparity> disparities = MatchStereo(left, right, camera, options.stereo);
  StereoSight sight{std::make_shared<const Frame>(
      LeftFrameOf(images, std::move(left), disparities, mask.confidence, options))};
  if (options.base == Base::kPlain)
    sight.right = std::make_shared<const Frame>(RightFrameOf(images, std::move(right), options));
  return sight;
}

}  // namespace aisle::slam
