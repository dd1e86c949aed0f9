#pragma once

#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/common/option_fields.h"
#include "slam/map/map.h"

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

/// Landmarks for features of keyframe `newest` that name none, placed by a free feature of one of
/// `neighbours` on the epipolar line instead of by disparity: far points, and those that only one
/// eye sees. Both views must agree with the point, with its disparity where there is one, and with
/// its size.
std::vector<Landmark> TriangulateLandmarks(const Map& map, KeyframeId newest,
                                           const std::vector<KeyframeId>& neighbours,
                                           const StereoCamera& camera,
                                           const TriangulateOptions& options);

}  // namespace aisle::slam
