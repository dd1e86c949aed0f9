#pragma once

namespace aisle::slam {

/// A rectified stereo rig as the SLAM sees it. Camera frame: x right, y down, z forward; the rig
/// frame is the left camera's. The centre of pixel (0, 0) is u = 0, v = 0.
struct StereoCamera {
  int width = 752, height = 480;                          ///< pixels
  double fx = 435.2, fy = 435.2, cx = 367.2, cy = 252.2;  ///< pixels
  double baseline_m = 0.12;  ///< the right camera stands at (+baseline, 0, 0) of the left
};

}  // namespace aisle::slam
