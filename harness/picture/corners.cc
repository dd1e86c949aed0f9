#include "harness/picture/corners.h"

#include <opencv2/features2d.hpp>

namespace aisle {

CornerDensity CountCorners(const cv::Mat1b& image) {
  constexpr int kThreshold = 20, kCell = 32;
  std::vector<cv::KeyPoint> corners;
  cv::FAST(image, corners, kThreshold, true);
  cv::Mat1b taken(image.rows / kCell, image.cols / kCell, std::uint8_t{0});
  for (const cv::KeyPoint& corner : corners) {
    const cv::Point cell(static_cast<int>(corner.pt.x) / kCell,
                         static_cast<int>(corner.pt.y) / kCell);
    if (cell.x < taken.cols && cell.y < taken.rows) taken(cell) = 1;
  }
  CornerDensity density;
  density.per_megapixel =
      1e6 * static_cast<double>(corners.size()) / static_cast<double>(image.total());
  if (!taken.empty()) {
    density.cells_share =
        static_cast<double>(cv::countNonZero(taken)) / static_cast<double>(taken.total());
  }
  return density;
}

}  // namespace aisle
