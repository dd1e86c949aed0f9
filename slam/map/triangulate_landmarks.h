#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/map/map.h"
#include "slam/map/map_options.h"
#include "slam/map/two_views.h"

namespace aisle::slam {

/// Where feature `i` of keyframe here and `j` of keyframe there put the point that both show
/// (metres, rig here); nothing where they cannot.
using PlacePoint = std::function<std::optional<Eigen::Vector3d>(const TwoViews& views,
                                                                std::size_t i, std::size_t j)>;

/// Where their two rays meet, if those place it well enough.
PlacePoint PlaceByRays(double worst_depth_ratio);

/// Landmarks for features of keyframe `newest` that name none, placed by `place` with a free
/// feature of one of `neighbours` on the epipolar line. Both views must agree with the point, with
/// its disparity where there is one, and with its size.
std::vector<Landmark> TriangulateLandmarks(const Map& map, KeyframeId newest,
                                           const std::vector<KeyframeId>& neighbours,
                                           const StereoCamera& camera,
                                           const TriangulateOptions& options,
                                           const PlacePoint& place);

/// The same, placed by rays instead of by disparity: far points, and those that only one camera
/// sees.
std::vector<Landmark> TriangulateLandmarks(const Map& map, KeyframeId newest,
                                           const std::vector<KeyframeId>& neighbours,
                                           const StereoCamera& camera,
                                           const TriangulateOptions& options);

}  // namespace aisle::slam
