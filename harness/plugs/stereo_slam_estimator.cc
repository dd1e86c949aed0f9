#include "harness/plugs/stereo_slam_estimator.h"

#include "harness/contract/map_id.h"
#include "harness/io/input_error.h"
#include "harness/plugs/slam_values.h"
#include "harness/score/masks.h"
#include "slam/moving_objects.h"

namespace aisle {
namespace {

TrackingState Convert(slam::TrackingState state) {
  switch (state) {
    case slam::TrackingState::kInitializing:
      return TrackingState::kInitializing;
    case slam::TrackingState::kTracking:
    case slam::TrackingState::kCoasting:  // it stands by its pose
      return TrackingState::kTracking;
    case slam::TrackingState::kApart:  // it cannot say where it is
    case slam::TrackingState::kLost:
      break;
  }
  return TrackingState::kLost;
}

SystemOption::Kind Convert(slam::OptionDescription::Kind kind) {
  using Kind = slam::OptionDescription::Kind;
  switch (kind) {
    case Kind::kNumber:
      return SystemOption::Kind::kNumber;
    case Kind::kInteger:
      return SystemOption::Kind::kInteger;
    case Kind::kFlag:
      return SystemOption::Kind::kFlag;
    case Kind::kChoice:
      return SystemOption::Kind::kChoice;
    case Kind::kText:
      return SystemOption::Kind::kText;
  }
  return SystemOption::Kind::kText;
}

slam::StageTruth Convert(const FrameTruth& truth) {
  slam::StageTruth converted{.moving = truth.dynamic};
  for (const MovingObject& object : MovingObjects(truth, {})) {
    converted.boxes.push_back(object.box);
  }
  return converted;
}

/// Draws what is kept of the frame; nothing to draw where nothing was.
StageDrawer DrawerOf(const std::shared_ptr<const slam::DynamicStages>& stages) {
  if (!stages) return {};
  return [stages](const FrameTruth* truth) {
    std::vector<StagePicture> pictures;
    for (slam::StagePicture& drawn :
         slam::DrawStages(*stages, truth == nullptr ? slam::StageTruth{} : Convert(*truth))) {
      pictures.push_back({std::move(drawn.name), std::move(drawn.image)});
    }
    return pictures;
  };
}

FrameEstimate Convert(const slam::TrackedFrame& frame) {
  FrameEstimate estimate;
  estimate.id = frame.id;
  estimate.stamp_ns = frame.stamp_ns;
  estimate.state = Convert(frame.state);
  estimate.T_world_rig = frame.T_world_rig;
  estimate.regions = RegionsFrom(frame.dynamic);
  estimate.counts = {{"features", frame.features},
                     {"stereo_points", frame.stereo_points},
                     {"matched", frame.matched_points},
                     {"inliers", frame.inliers},
                     {"keyframe", frame.is_keyframe ? 1 : 0},
                     {"map_keyframes", frame.map_keyframes},
                     {"map_landmarks", frame.map_landmarks},
                     {"loop_closed", frame.loop_closed ? 1 : 0},
                     {"coasting", frame.state == slam::TrackingState::kCoasting ? 1 : 0},
                     {kMapId, frame.map_id}};
  estimate.stage_ms = frame.stage_ms;
  estimate.keypoints = frame.keypoints;
  estimate.keypoint_is_inlier = frame.keypoint_is_inlier;
  estimate.draw_stages = DrawerOf(frame.dynamic_stages);
  return estimate;
}

/// 0 to 255 as 0 to 1.
cv::Mat1f Share(const cv::Mat1b& confidence) {
  cv::Mat1f share;
  if (!confidence.empty()) confidence.convertTo(share, CV_32F, 1.0 / 255);
  return share;
}

class StereoSlamEstimator : public Estimator {
 public:
  StereoSlamEstimator(const slam::StereoCamera& camera, const slam::SlamOptions& options)
      : slam_(camera, options) {}

  FrameEstimate Process(const StereoFrame& frame, const ExternalMask& mask) override {
    std::optional<slam::MeasuredMotion> motion;
    if (frame.motion) motion = {frame.motion->T_now_before, frame.motion->covariance};
    return Convert(slam_.Track({frame.id, frame.stamp_ns, frame.left, frame.right},
                               {mask.left, mask.right, Share(mask.confidence)}, motion));
  }

  Trajectory Finish() override {
    Trajectory trajectory;
    for (const slam::StampedPose& pose : slam_.Finish()) {
      trajectory.push_back({pose.stamp_ns, pose.T_world_rig});
    }
    return trajectory;
  }

  void SaveMap(const std::filesystem::path& file) override { slam_.SaveMap(file.string()); }

 private:
  slam::StereoSlam slam_;
};

}  // namespace

std::vector<SystemOption> DescribeSlamOptions(const std::map<std::string, std::string>& values) {
  std::vector<SystemOption> described;
  const slam::SlamOptions options = SlamOptionsFrom(values);
  for (const slam::OptionDescription& option : slam::DescribeOptions(options)) {
    if (!slam::WhyWithoutEffect(option.path, options).empty()) continue;
    described.push_back({option.path, Convert(option.kind), option.value, option.unit, option.help,
                         option.low, option.high, option.choices});
  }
  return described;
}

std::string CheckSlamOption(const std::string& path, const std::string& value) {
  slam::SlamOptions options;
  return slam::SetOption(path, value, &options);
}

std::string CheckSlamOptions(const std::map<std::string, std::string>& values) {
  slam::SlamOptions options;
  if (!SetSlamOptions(values, &options).empty()) return {};  // said of the option itself
  for (const auto& [path, value] : values) {
    const std::string idle = slam::WhyWithoutEffect(path, options);
    if (!idle.empty()) return idle;
  }
  return slam::Validate(options);
}

std::unique_ptr<Estimator> MakeStereoSlamEstimator(const StereoCalibration& calibration,
                                                   const StereoSlamEstimatorOptions& options) {
  slam::SlamOptions slam_options = SlamOptionsFrom(options.options);
  slam_options.threads = options.threads;
  slam_options.vocabulary_file = options.vocabulary_file.string();
  slam_options.map_file = options.load_map.string();
  slam_options.localise_only = options.localise_only;
  slam_options.schedule.free_running = options.free_running;
  slam_options.dynamic.keep_stages = options.draw_stages;
  return std::make_unique<StereoSlamEstimator>(CameraFrom(calibration), slam_options);
}

}  // namespace aisle
