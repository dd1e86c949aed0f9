#include "slam/dynamic/paper/disparity.h"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "slam/common/median.h"

namespace aisle::slam::dynamic {
namespace {

/// In pixels of the images given.
cv::Mat1f Match(const cv::Mat1b& left, const cv::Mat1b& right, const DisparityOptions& options) {
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

/// Means of 2x2 pixels; an odd last column or row is left out.
cv::Mat1b Halved(const cv::Mat1b& image) {
  const cv::Size half(image.cols / 2, image.rows / 2);
  cv::Mat1b halved;
  cv::resize(image(cv::Rect({0, 0}, half * 2)), halved, half, 0, 0, cv::INTER_AREA);
  return halved;
}

/// The matcher rounds up how far it searches: Doubled drops what is too far. An island of n pixels
/// is one of 4 n in the whole image.
DisparityOptions Halved(DisparityOptions options) {
  options.max_disparity_px = (options.max_disparity_px / 2 + 15) / 16 * 16;
  options.speckle_px /= 4;
  if (options.left_right_px > 1) options.left_right_px /= 2;
  return options;
}

/// Every pixel takes the disparity of the half-size one it was part of, but for those that were not
/// to be searched.
cv::Mat1f Doubled(const cv::Mat1f& half, cv::Size size, int max_disparity_px) {
  const auto limit = static_cast<float>(max_disparity_px);
  cv::Mat1f doubled(size);
  for (int y = 0; y < size.height; ++y) {
    const float* from = half[std::min(y / 2, half.rows - 1)];
    for (int x = 0; x < size.width; ++x) {
      const float d = from[std::min(x / 2, half.cols - 1)];
      const bool known = d >= 0.0F && 2 * d < limit && 2 * d <= static_cast<float>(x);
      doubled(y, x) = known ? 2 * d : kNoDisparity;
    }
  }
  return doubled;
}

}  // namespace

cv::Mat1f ComputeDisparity(const cv::Mat1b& left, const cv::Mat1b& right,
                           const DisparityOptions& options) {
  CV_Assert(left.size() == right.size() && !left.empty());
  if (!options.half_size || left.cols < 2 || left.rows < 2) return Match(left, right, options);
  return Doubled(Match(Halved(left), Halved(right), Halved(options)), left.size(),
                 options.max_disparity_px);
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
  return Median(std::move(known));
}

}  // namespace aisle::slam::dynamic
