#include "slam/dynamic/dynamic_detector.h"

#include <opencv2/imgproc.hpp>

#include "slam/common/parallel.h"
#include "slam/common/standalone.h"
#include "slam/dynamic/dynamic_stages.h"
#include "slam/dynamic/paper/paper_method.h"
#include "slam/dynamic/robust/robust_method.h"

namespace aisle::slam {
namespace {

using Eigen::Isometry3d;

/// The motion since the last frame, of the one since the last frame that showed something new, by
/// which the method goes; `unseen` lies between the two, was only expected, and its error is that
/// of the difference too.
MeasuredMotion SinceLastFrame(const MeasuredMotion& since_kept,
                              const std::optional<MeasuredMotion>& unseen) {
  if (!unseen) return since_kept;
  const Isometry3d T_now_last = since_kept.T_now_before * unseen->T_now_before.inverse();
  const Matrix6d carry = Adjoint(T_now_last);
  return {T_now_last, since_kept.covariance + carry * unseen->covariance * carry.transpose()};
}

}  // namespace

struct DynamicDetector::Impl {
  StereoCamera camera;
  DynamicOptions options;
  dynamic::StereoPair previous;  // of the paper's method
  dynamic::RobustState state;    // of the robust one

  DynamicOutput DetectByPaper(const DynamicInput& input);
  DynamicOutput DetectRobustly(const DynamicInput& input);
  void Keep(DynamicStages stages, DynamicOutput& output) const;
};

/// Hands out the stages with the regions they led to, if anybody asked for them.
void DynamicDetector::Impl::Keep(DynamicStages stages, DynamicOutput& output) const {
  if (!options.keep_stages) return;
  stages.left = stages.left.clone();  // the caller may use its images again
  stages.regions = output.regions;
  output.stages = std::make_shared<const DynamicStages>(std::move(stages));
}

DynamicOutput DynamicDetector::Impl::DetectByPaper(const DynamicInput& input) {
  const dynamic::StereoPair current{input.left, input.right};
  DynamicOutput output;
  DynamicStages stages{.left = input.left};
  if (!previous.left.empty()) {
    dynamic::PaperResult result = dynamic::DetectDynamicRegions(previous, current, options.paper);
    output.mask_right = ShiftMaskToRight(result.dynamic.mask, result.disparity);
    output.regions = std::move(result.dynamic);
    output.stage_ms = result.stages.stage_ms;
    stages.paper = PaperTrace{options.paper, std::move(result.stages)};
  }
  Keep(std::move(stages), output);
  previous = {current.left.clone(), current.right.clone()};  // the caller may use its images again
  return output;
}

DynamicOutput DynamicDetector::Impl::DetectRobustly(const DynamicInput& input) {
  dynamic::RobustResult result =
      dynamic::StepRobust(state, {input.left, input.right}, input.stamp_ns,
                          {input.expected, input.measured}, camera, options.robust);
  DynamicStages stages{.left = input.left};
  if (options.keep_stages) stages.robust = TraceOf(state, result, camera);
  DynamicOutput output;
  output.mask_right = ShiftMaskToRight(result.dynamic.mask, result.half_disparity);
  output.regions = std::move(result.dynamic);
  output.probability = std::move(result.probability);
  if (const auto& motion = result.motion) {
    output.rig_motion =
        SinceLastFrame({motion->T_now_before, motion->covariance}, state.unseen_way);
  }
  output.stage_ms = std::move(result.stages.stage_ms);
  state = std::move(result.state);
  Keep(std::move(stages), output);
  return output;
}

DynamicDetector::DynamicDetector(const StereoCamera& camera, const DynamicOptions& options)
    : impl_(std::make_unique<Impl>(Impl{camera, options, {}, {}})) {}
DynamicDetector::DynamicDetector(DynamicDetector&&) noexcept = default;
DynamicDetector& DynamicDetector::operator=(DynamicDetector&&) noexcept = default;
DynamicDetector::~DynamicDetector() = default;

DynamicOutput DynamicDetector::Detect(const DynamicInput& input) {
  DynamicInput standalone = input;
  standalone.left = Standalone(input.left);
  standalone.right = Standalone(input.right);
  switch (impl_->options.method) {
    case DynamicMethod::kPaper:
      return impl_->DetectByPaper(standalone);
    case DynamicMethod::kRobust:
      return impl_->DetectRobustly(standalone);
    case DynamicMethod::kNone:
      break;
  }
  return {};
}

cv::Mat1b ShiftMaskToRight(const cv::Mat1b& mask, const cv::Mat1f& disparity) {
  CV_Assert(!disparity.empty());
  const int factor = std::max(1, mask.cols / disparity.cols);
  cv::Mat1b right(mask.size(), static_cast<unsigned char>(0));
  ParallelFor(0, mask.rows, [&](int y) {
    const unsigned char* moves = mask[y];
    unsigned char* to_right = right[y];
    const float* known = disparity[std::min(y / factor, disparity.rows - 1)];
    for (int x = 0; x < mask.cols; ++x) {
      if (moves[x] == 0) continue;
      const float d = known[std::min(x / factor, disparity.cols - 1)];
      const int to = x - cvRound(d * static_cast<float>(factor));
      if (d >= 0 && to >= 0) to_right[to] = 255;
    }
  });
  const cv::Mat window = cv::getStructuringElement(cv::MORPH_RECT, {9, 5});
  cv::morphologyEx(right, right, cv::MORPH_CLOSE, window);
  return right;
}

}  // namespace aisle::slam
