#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/dynamic/moving_regions.h"
#include "slam/dynamic/point_tracks.h"

namespace aisle::slam::dynamic {

/// What is known of the nodes before the current frame has had its say.
struct LabelMemory {
  cv::Mat1f log_odds;  ///< per node, without the neighbours' share
  NodeRegions regions;
};

/// Median displacement (pixels) of the tracks that were in each region in the previous frame; zero
/// for regions without.
std::vector<cv::Point2f> RegionFlows(const NodeRegions& previous,
                                     const std::vector<PointTrack>& tracks);

/// Takes the memory of the previous frame to the current one: static surfaces by the rig's motion
/// (T_before_now) and their disparity now, regions by their own flow. Where neither reaches,
/// nothing is known (0).
LabelMemory CarryMemory(const LabelMemory& previous, const std::vector<cv::Point2f>& region_flows,
                        const cv::Mat1f& node_disparity, const Eigen::Isometry3d& T_before_now,
                        const StereoCamera& half);

}  // namespace aisle::slam::dynamic
