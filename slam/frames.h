#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>

/// The system's nouns, which its rooms hand to the face: what goes in, and what is known of a
/// drive. Poses are in metres; the rig's frame is that of the left rectified camera: x right, y
/// down, z forward. Pixels count from the centre of the upper left one, x to the right, y down.
namespace aisle::slam {

/// One instant of a rectified stereo rig, 8-bit grey. All that the system sees of the world. Both
/// images are of the camera's size (StereoCamera) and row-aligned: a point has the same v in both,
/// and its u in the right one is smaller by the disparity.
struct StereoImages {
  std::int64_t id = 0;        ///< the caller's own; handed back in TrackedFrame
  std::int64_t stamp_ns = 0;  ///< when the exposure was taken, any epoch; rises from frame to frame
  cv::Mat1b left, right;      ///< the caller may write to them again after the call
};

/// Pixels that are not to be used: 255 = reject. Each image is empty, which rejects nothing, or of
/// the camera's size.
struct ExternalMask {
  cv::Mat1b left, right;
  /// How far each left pixel is trusted, 0 to 1: the information of what is measured there is
  /// multiplied by it. An empty image trusts all. Of the camera's size.
  cv::Mat1f confidence;
};

/// Whether, and by what, the rig's pose in the world is known.
enum class TrackingState {
  kInitializing,  ///< no map yet
  kTracking,
  kApart,     ///< tracking in a part of the map whose place in the world is not known (yet)
  kCoasting,  ///< too little of the map is seen: the pose is the one that was measured otherwise
  kLost,
};

/// Where the rig was at a stamp.
struct StampedPose {
  std::int64_t stamp_ns = 0;
  /// Maps rig coordinates to world coordinates.
  Eigen::Isometry3d T_world_rig = Eigen::Isometry3d::Identity();
};

}  // namespace aisle::slam
