#include "slam/dynamic/dense_frame.h"

#include <tbb/parallel_for.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/disparity.h"

namespace aisle::slam::dynamic {
namespace {

void ForgetPadding(cv::Mat1f& disparity, int most_disparity, int border) {
  const int columns = std::min(disparity.cols, most_disparity + border);
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const float reach = static_cast<float>(x - border);
      if (disparity(y, x) > reach) disparity(y, x) = kNoDisparity;
    }
  }
}

void FillRow(float* row, int columns) {
  for (int x = 0; x < columns;) {
    if (row[x] >= 0) {
      ++x;
      continue;
    }
    int end = x;
    while (end < columns && row[end] < 0) ++end;
    const float left = x > 0 ? row[x - 1] : kNoDisparity;
    const float right = end < columns ? row[end] : kNoDisparity;
    const float fill = left < 0 ? right : right < 0 ? left : std::min(left, right);
    std::fill(row + x, row + end, std::max(fill, 0.0F));
    x = end;
  }
}

/// The least and the most of every pixel and the middles between it and its neighbours of the row.
void SpanHalfPixels(const cv::Mat1b& image, cv::Mat1b& low, cv::Mat1b& high) {
  low.create(image.size());
  high.create(image.size());
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const int at = image(y, x);
      const int left = (at + image(y, std::max(x - 1, 0))) / 2;
      const int right = (at + image(y, std::min(x + 1, image.cols - 1))) / 2;
      low(y, x) = static_cast<unsigned char>(std::min({at, left, right}));
      high(y, x) = static_cast<unsigned char>(std::max({at, left, right}));
    }
  }
}

struct StaticRow {
  float *place, *disparity, *per_disparity;
};

/// Everything first, without branches, so that it is vectorised; then what lies behind the camera.
void FindRow(const Eigen::Vector3f& start, const Eigen::Vector3f& step, const Eigen::Vector3f& t,
             const float* disparity, int columns, const StaticRow& row) {
  constexpr float kNearest = 0.05F, kNowhere = -1e4F;
  const float x0 = start.x(), y0 = start.y(), z0 = start.z();
  const float xs = step.x(), ys = step.y(), zs = step.z();
  const float tx = t.x(), ty = t.y(), tz = t.z();
  float *place = row.place, *there = row.disparity, *per = row.per_disparity;
#pragma GCC ivdep
  for (int x = 0; x < columns; ++x) {
    const float d = disparity[x], at = static_cast<float>(x);
    const float z = std::max(z0 + zs * at + tz * d, kNearest);
    const float u = (x0 + xs * at + tx * d) / z, v = (y0 + ys * at + ty * d) / z;
    place[2 * x] = u;
    place[2 * x + 1] = v;
    there[x] = d / z;
    per[2 * x] = (tx - u * tz) / z;
    per[2 * x + 1] = (ty - v * tz) / z;
  }
  for (int x = 0; x < columns; ++x) {
    if (z0 + zs * static_cast<float>(x) + tz * disparity[x] >= kNearest) continue;
    place[2 * x] = place[2 * x + 1] = kNowhere;
    there[x] = per[2 * x] = per[2 * x + 1] = 0;
  }
}

}  // namespace

StereoCamera HalfCamera(const StereoCamera& camera) {
  StereoCamera half = camera;
  half.width = camera.width / 2;
  half.height = camera.height / 2;
  half.fx = camera.fx / 2;
  half.fy = camera.fy / 2;
  half.cx = (camera.cx - 0.5) / 2;
  half.cy = (camera.cy - 0.5) / 2;
  return half;
}

cv::Mat1b HalfImage(const cv::Mat1b& image) {
  cv::Mat1b half;
  cv::resize(image, half, image.size() / 2, 0, 0, cv::INTER_AREA);
  return half;
}

cv::Mat1f FillRows(const cv::Mat1f& disparity) {
  cv::Mat1f filled = disparity.clone();
  for (int y = 0; y < filled.rows; ++y) FillRow(filled[y], filled.cols);
  return filled;
}

DenseFrame MakeDenseFrame(const cv::Mat1b& left, const cv::Mat1b& right,
                          const DisparityOptions& disparity, const SurfaceOptions& options) {
  DenseFrame frame;
  frame.image = HalfImage(left);
  const cv::Mat1b half_right = HalfImage(right);
  frame.disparity = ComputeDisparity(frame.image, half_right, disparity);
  SpanHalfPixels(half_right, frame.right_low, frame.right_high);
  ForgetPadding(frame.disparity, disparity.max_disparity_px, options.border_px);
  frame.filled = FillRows(frame.disparity);
  return frame;
}

cv::Mat1f DifferenceVariance(const cv::Mat1b& image, const SurfaceOptions& options) {
  cv::Mat1f variance;
  image.convertTo(variance, CV_32F, options.brightness_noise);
  variance = 2 * (variance.mul(variance) + options.grey_noise * options.grey_noise);
  return variance;
}

Texture MeasureTexture(const cv::Mat1b& image, const SurfaceOptions& options) {
  constexpr double kSobelGain = 1.0 / 8;
  constexpr float kNoiseGain = 0.1875F;  // variance of that gradient where each pixel's is one
  cv::Mat1f gx, gy;
  cv::Sobel(image, gx, CV_32F, 1, 0, 3, kSobelGain);
  cv::Sobel(image, gy, CV_32F, 0, 1, 3, kSobelGain);
  const cv::Mat1f variance = DifferenceVariance(image, options);
  const cv::Size window(options.window_px, options.window_px);
  const auto gather = [&](const cv::MatExpr& product) {
    cv::Mat1f sum;
    cv::boxFilter(product / variance, sum, -1, window, {-1, -1}, false);
    return sum;
  };
  Texture texture{gather(gx.mul(gx)), gather(gx.mul(gy)), gather(gy.mul(gy))};
  const float noise = kNoiseGain / 2 * static_cast<float>(window.area());
  texture.xx = cv::max(texture.xx - noise, 0.0F);
  texture.yy = cv::max(texture.yy - noise, 0.0F);
  for (int k = 0; k < static_cast<int>(texture.xy.total()); ++k) {
    const float most = std::sqrt(texture.xx(k) * texture.yy(k));  // of a positive matrix
    texture.xy(k) = std::clamp(texture.xy(k), -most, most);
  }
  return texture;
}

StaticField WhereStatic(const cv::Mat1f& filled, const Eigen::Isometry3d& T_then_now,
                        const StereoCamera& half) {
  Eigen::Matrix3d K;
  K << half.fx, 0, half.cx, 0, half.fy, half.cy, 0, 0, 1;
  // (x, y, disparity) goes to (A (x, y, 1) + t disparity) / w: linear in homogeneous coordinates.
  const Eigen::Matrix3f A = (K * T_then_now.linear() * K.inverse()).cast<float>();
  const Eigen::Vector3f t =
      (K * T_then_now.translation() / (half.fx * half.baseline_m)).cast<float>();
  StaticField field{cv::Mat2f(filled.size()), cv::Mat1f(filled.size()), cv::Mat2f(filled.size())};
  tbb::parallel_for(0, filled.rows, [&](int y) {
    const Eigen::Vector3f start = A.col(1) * static_cast<float>(y) + A.col(2);
    FindRow(start, A.col(0), t, filled[y], filled.cols,
            {field.place.ptr<float>(y), field.disparity[y], field.per_disparity.ptr<float>(y)});
  });
  return field;
}

}  // namespace aisle::slam::dynamic
