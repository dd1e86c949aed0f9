#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/feature/features.h"

namespace aisle::slam {

/// Which keypoints lie near a pixel, without looking at all of them.
class FeatureGrid {
 public:
  FeatureGrid() = default;
  FeatureGrid(const std::vector<Keypoint>& keypoints, cv::Size image);

  /// Indices of the keypoints within `radius` pixels of `center` (in x and in y) whose level is in
  /// [lowest, highest]; in an order fixed by the keypoints alone.
  std::vector<int> Near(cv::Point2f center, float radius, int lowest, int highest) const;

 private:
  struct Entry {
    cv::Point2f pixel;
    int level, index;
  };
  int columns_ = 0, rows_ = 0;
  std::vector<int> begin_;  // of each cell in entries_, and one past the last
  std::vector<Entry> entries_;
};

}  // namespace aisle::slam
