#include "slam/dynamic/paper/mark_regions.h"

#include <opencv2/imgproc.hpp>

namespace aisle::slam::dynamic {

std::vector<cv::Point> SearchOcclusions(const cv::Point& from, const cv::Mat1i& labels,
                                        const std::map<BoundaryKey, BoundaryType>& boundaries) {
  const cv::Rect area({0, 0}, labels.size());
  std::vector<cv::Point> found;
  for (const cv::Point step : {cv::Point(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
    for (cv::Point p = from; area.contains(p) && area.contains(p + step); p += step) {
      if (labels(p) != labels(p + step) && IsOcclusion(boundaries, labels(p), labels(p + step))) {
        found.push_back(p);
        break;
      }
    }
  }
  return found;
}

std::optional<cv::Rect> MarkRegion(const std::vector<cv::Point>& points, const cv::Mat1i& labels,
                                   const std::map<BoundaryKey, BoundaryType>& boundaries,
                                   const MarkOptions& options) {
  std::vector<cv::Point> outline;
  for (const cv::Point& point : points) {
    const std::vector<cv::Point> found = SearchOcclusions(point, labels, boundaries);
    if (static_cast<int>(found.size()) < options.min_rays) continue;
    outline.insert(outline.end(), found.begin(), found.end());
  }
  if (outline.empty()) return std::nullopt;
  return cv::boundingRect(outline);
}

}  // namespace aisle::slam::dynamic
