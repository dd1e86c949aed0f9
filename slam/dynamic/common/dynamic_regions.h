#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace aisle::slam {

/// One object that moves, as seen in the left image.
struct DynamicRegion {
  int id = 0;           ///< `robust`: stable over time; `paper`: index within the frame
  cv::Rect box;         ///< pixels of the left image, inside it
  double evidence = 0;  ///< larger is surer; `paper`: dynamic points, `robust`: log-odds
};

/// Where the left image shows something that moves in the world.
struct DynamicRegions {
  cv::Mat1b mask;  ///< 255 = dynamic, 0 = static; same size as the left image
  std::vector<DynamicRegion> regions;
};

}  // namespace aisle::slam
