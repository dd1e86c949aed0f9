#include "slam/dynamic/paper/disparity.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace aisle::slam::dynamic {

cv::Mat1f ComputeDisparity(const cv::Mat1b& left, const cv::Mat1b& right,
                           const DisparityOptions& options) {
  CV_Assert(left.size() == right.size() && !left.empty());
  const int pad = options.max_disparity_px;
  cv::Mat1b padded_left, padded_right;
  cv::copyMakeBorder(left, padded_left, 0, 0, pad, 0, cv::BORDER_REPLICATE);
  cv::copyMakeBorder(right, padded_right, 0, 0, pad, 0, cv::BORDER_REPLICATE);

  const int area = options.block_px * options.block_px;
  const auto matcher = cv::StereoSGBM::create(0, options.max_disparity_px, options.block_px,
                                              8 * area, 32 * area, options.left_right_px, 31,
                                              options.uniqueness_percent, options.speckle_px, 2);
  cv::Mat1s sixteenths;
  matcher->compute(padded_left, padded_right, sixteenths);

  cv::Mat1f disparity(left.size());
  for (int y = 0; y < left.rows; ++y) {
    const short* from = sixteenths[y] + pad;
    float* to = disparity[y];
    for (int x = 0; x < left.cols; ++x) {
      const float d = static_cast<float>(from[x]) / 16.0F;
      // A match beyond the right image's edge saw only padding.
      to[x] = d >= 0.0F && d <= static_cast<float>(x) ? d : kNoDisparity;
    }
  }
  return disparity;
}

float DisparityNear(const cv::Mat1f& disparity, const cv::Point2f& point, int radius) {
  const cv::Point centre(cvRound(point.x), cvRound(point.y));
  const cv::Rect window =
      cv::Rect(centre.x - radius, centre.y - radius, 2 * radius + 1, 2 * radius + 1) &
      cv::Rect({0, 0}, disparity.size());
  std::vector<float> known;
  for (int y = window.y; y < window.y + window.height; ++y) {
    for (int x = window.x; x < window.x + window.width; ++x) {
      if (disparity(y, x) >= 0.0F) known.push_back(disparity(y, x));
    }
  }
  if (known.empty()) return kNoDisparity;
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  return *middle;
}

}  // namespace aisle::slam::dynamic
