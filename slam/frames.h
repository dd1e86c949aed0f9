#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>

/// The system's nouns, which its rooms hand to the face: what goes in, and what is known of a
/// drive.
namespace aisle::slam {

/// One instant of a rectified stereo rig, 8-bit grey. All that the system sees of the world.
struct StereoImages {
  std::int64_t id = 0;
  std::int64_t stamp_ns = 0;
  cv::Mat1b left, right;
};

/// Pixels somebody else has declared unusable: 255 = reject. An empty image rejects nothing.
struct ExternalMask {
  cv::Mat1b left, right;
  /// How far each left pixel is trusted, 0 to 1: the information of what is measured there is
  /// multiplied by it. An empty image trusts all.
  cv::Mat1f confidence;
};

enum class TrackingState {
  kInitializing,  ///< no map yet
  kTracking,
  kApart,     ///< tracking in a part of the map whose place in the world is not known (yet)
  kCoasting,  ///< too little of the map is seen: the pose is the one that was measured otherwise
  kLost,
};

struct StampedPose {
  std::int64_t stamp_ns = 0;
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
};

}  // namespace aisle::slam
