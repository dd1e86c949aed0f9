#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/feature/descriptor.h"

namespace aisle::slam {

/// A corner of the image pyramid.
struct Keypoint {
  cv::Point2f pixel;    ///< in the full image, sub-pixel
  int level = 0;        ///< of the pyramid, 0 is the full image
  float angle_deg = 0;  ///< of the brightness centroid, [0, 360), from x towards y
  float response = 0;   ///< FAST score, grey levels
};

/// Parallel lists: descriptors[i] belongs to keypoints[i].
struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<Descriptor> descriptors;

  int size() const { return static_cast<int>(keypoints.size()); }
};

}  // namespace aisle::slam
