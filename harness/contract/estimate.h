#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <map>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace aisle {

struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
};
using Trajectory = std::vector<StampedPose>;  ///< stamps do not fall

/// What an estimator rejected as moving in one frame.
struct DynamicRegion {
  int id = 0;  ///< stable over time where the system can tell
  cv::Rect2d box;
  double evidence = 0;  ///< larger is surer; each system's own scale
};
struct DynamicRegions {
  cv::Mat1b mask;  ///< 255 = rejected; empty: the system makes no masks
  std::vector<DynamicRegion> regions;
};

/// One stage of how a system found what it rejects: title, legend and numbers are in the picture.
struct StagePicture {
  std::string name;
  cv::Mat3b image;  ///< BGR; all pictures of a frame have one size
};
struct FrameTruth;
/// Draws the stages of one frame in their order, beside truth where it is known (else null). May
/// come back empty: in the first frame there is nothing to see yet.
using StageDrawer = std::function<std::vector<StagePicture>(const FrameTruth*)>;

enum class TrackingState { kInitializing, kTracking, kLost };

/// What a system said at a frame, causally.
struct FrameEstimate {
  std::int64_t id = 0;
  std::int64_t stamp_ns = 0;
  TrackingState state = TrackingState::kInitializing;
  std::optional<Eigen::Isometry3d> T_world_rig;
  DynamicRegions regions;
  std::map<std::string, int> counts;       ///< features, matched, inliers, …
  std::map<std::string, double> stage_ms;  ///< wall time by stage
  std::vector<cv::Point2f> keypoints;      ///< left image
  std::vector<bool> keypoint_is_inlier;    ///< per keypoint: took part in the pose
  StageDrawer draw_stages;                 ///< empty unless the system was asked for it
};

/// Two tracks, never mixed: as known at each frame, and after all optimisation.
struct TrajectoryEstimate {
  Trajectory live;
  Trajectory final;
};

}  // namespace aisle
