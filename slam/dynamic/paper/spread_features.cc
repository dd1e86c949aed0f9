#include "slam/dynamic/paper/spread_features.h"

#include "slam/feature/quadtree.h"

namespace aisle::slam::dynamic {

std::vector<cv::Point2f> SpreadFeatures(const cv::Mat1b& image, const SpreadOptions& options) {
  FeatureOptions feature;
  feature.fast_threshold = options.fast_threshold;
  feature.fast_threshold_low = options.fast_threshold_low;
  feature.cell_px = options.cell_px;
  feature.least_corner_ratio = 0;  // as the published system takes them
  feature.border_px = options.border_px;
  std::vector<cv::Point2f> points;
  for (const Corner& corner : DistributeCorners(DetectCorners(image, feature), options.points)) {
    points.emplace_back(static_cast<float>(corner.x), static_cast<float>(corner.y));
  }
  return points;
}

}  // namespace aisle::slam::dynamic
