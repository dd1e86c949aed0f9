#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/common/option_fields.h"
#include "slam/map/map.h"
#include "slam/map/two_views.h"

namespace aisle::slam {

/// How features without depth of their own find each other in two keyframes.
struct TriangulateOptions {
  int neighbours = 5;              ///< keyframes compared with, most covisible first; 0: none
  int descriptor_distance = 50;    ///< bits; no match beyond
  double descriptor_ratio = 0.8;   ///< best to second best on the epipolar line
  double worst_depth_ratio = 0.1;  ///< deviation over depth; what two views place worse is left out
};

/// Names every option with its range, unit and a sentence.
void Describe(OptionFields& fields, TriangulateOptions& options);

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
