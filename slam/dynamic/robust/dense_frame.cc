#include "slam/dynamic/robust/dense_frame.h"

#include <opencv2/imgproc.hpp>

#include "slam/common/parallel.h"
#include "slam/dynamic/common/stereo_pair.h"
#include "slam/dynamic/robust/pixel_noise.h"
#include "slam/dynamic/robust/unseen_columns.h"
#include "slam/dynamic/robust/window_sums.h"
#include "slam/stereo/dense/semi_global.h"

namespace aisle::slam::dynamic {
namespace {

void ForgetPadding(cv::Mat1f& disparity, int most_disparity) {
  const int columns = std::min(disparity.cols, most_disparity + kMatchReach);
  for (int y = 0; y < disparity.rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const float reach = static_cast<float>(x - kMatchReach);
      if (disparity(y, x) > reach) disparity(y, x) = kNoDisparity;
    }
  }
}

/// Disparity of every pixel, without the columns where the matcher saw only padding.
cv::Mat1f Match(const cv::Mat1b& left, const cv::Mat1b& right, const SemiGlobalOptions& options) {
  cv::Mat1f disparity = MatchSemiGlobally(left, right, options);
  ForgetPadding(disparity, options.max_disparity_px);
  return disparity;
}

/// Takes over into a row what the coarse one has beyond its reach.
void AddNearer(const float* coarse, int columns, float reach, float* row) {
  for (int x = 0; x < columns; ++x) {
    const float found = 2 * coarse[x / 2];
    if (found > reach) row[x] = found;
  }
}

/// What looks like a match among unseen columns is one where both sizes have it.
void ForgetChanceMatches(const float* coarse, int unseen, float* row) {
  constexpr float kSame = 2;
  for (int x = 0; x < unseen; ++x) {
    const float other = coarse[x / 2];
    if (other < 0 || std::abs(row[x] - 2 * other) > kSame) row[x] = kNoDisparity;
  }
}

/// What is nearer than the search reaches has no disparity, or a wrong one: images of half that
/// size reach twice as near, for a quarter of the work.
void LookNearer(const cv::Mat1b& right, const SemiGlobalOptions& options, DenseFrame& frame) {
  const cv::Mat1f coarse = Match(HalfImage(frame.image), HalfImage(right), options);
  const auto reach = static_cast<float>(options.max_disparity_px - kMatchReach);
  frame.unseen = UnseenColumns(coarse, frame.image.rows);
  for (int y = 0; y < 2 * coarse.rows; ++y) {
    const float* found = coarse[y / 2];
    AddNearer(found, 2 * coarse.cols, reach, frame.disparity[y]);
    ForgetChanceMatches(found, frame.unseen[static_cast<std::size_t>(y)], frame.disparity[y]);
  }
}

void FillRow(float* row, int columns, int unseen) {
  for (int x = 0; x < columns;) {
    if (row[x] >= 0) {
      ++x;
      continue;
    }
    int end = x;
    while (end < columns && row[end] < 0) ++end;
    const float left = x > 0 ? row[x - 1] : kNoDisparity;
    const float right = end < columns ? row[end] : kNoDisparity;
    const float fill = left < 0 || end == unseen ? right : right < 0 ? left : std::min(left, right);
    std::fill(row + x, row + end, std::max(fill, 0.0F));
    x = end;
  }
}

/// The least and the most of every pixel and the middles between it and its neighbours of the row.
void SpanHalfPixels(const cv::Mat1b& image, cv::Mat1b& low, cv::Mat1b& high) {
  low.create(image.size());
  high.create(image.size());
  cv::Mat1b padded;
  cv::copyMakeBorder(image, padded, 0, 0, 1, 1, cv::BORDER_REPLICATE);
  for (int y = 0; y < image.rows; ++y) {
    const unsigned char* at = padded[y] + 1;
    unsigned char *lowest = low[y], *highest = high[y];
#pragma GCC ivdep
    for (int x = 0; x < image.cols; ++x) {
      const int left = (at[x] + at[x - 1]) / 2, right = (at[x] + at[x + 1]) / 2;
      const int here = at[x];
      lowest[x] = static_cast<unsigned char>(std::min(here, std::min(left, right)));
      highest[x] = static_cast<unsigned char>(std::max(here, std::max(left, right)));
    }
  }
}

/// The noise that the method counts with.
GreyVariance UsualVariance(const SurfaceOptions& options) {
  GreyVariance variance;
  for (std::size_t grey = 0; grey < variance.size(); ++grey) {
    const double growing = options.brightness_noise * static_cast<double>(grey);
    variance[grey] =
        static_cast<float>(growing * growing + options.grey_noise * options.grey_noise);
  }
  return variance;
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

struct TextureRow {
  float *xx, *xy, *yy;
};

void MultiplyRow(const short* gx, const short* gy, const float* variance, int columns,
                 const TextureRow& row) {
  constexpr float kSobelGain = 1.0F / 8;
  float *xx = row.xx, *xy = row.xy, *yy = row.yy;
#pragma GCC ivdep
  for (int x = 0; x < columns; ++x) {
    const float dx = kSobelGain * static_cast<float>(gx[x]);
    const float dy = kSobelGain * static_cast<float>(gy[x]);
    xx[x] = dx * dx / variance[x];
    xy[x] = dx * dy / variance[x];
    yy[x] = dy * dy / variance[x];
  }
}

void TakeNoiseOff(int pixels, int columns, const TextureRow& row) {
  constexpr float kNoiseGain = 0.1875F;  // variance of that gradient where each pixel's is one
  const float noise = kNoiseGain / 2 * static_cast<float>(pixels);
  float *xx = row.xx, *xy = row.xy, *yy = row.yy;
#pragma GCC ivdep
  for (int x = 0; x < columns; ++x) {
    xx[x] = std::max(xx[x] - noise, 0.0F);
    yy[x] = std::max(yy[x] - noise, 0.0F);
    const float most = std::sqrt(xx[x] * yy[x]);  // of a positive matrix
    xy[x] = std::min(std::max(xy[x], -most), most);
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
  const cv::Size size = image.size() / 2;
  cv::Mat1b half;
  cv::resize(image(cv::Rect({0, 0}, size * 2)), half, size, 0, 0, cv::INTER_AREA);
  return half;
}

cv::Mat1f FillRows(const cv::Mat1f& disparity, const std::vector<int>& unseen) {
  cv::Mat1f filled = disparity.clone();
  for (int y = 0; y < filled.rows; ++y) {
    FillRow(filled[y], filled.cols, unseen.empty() ? 0 : unseen[static_cast<std::size_t>(y)]);
  }
  return filled;
}

cv::Mat1b QuietHalfImage(const cv::Mat1b& image, const SurfaceOptions& options) {
  GreyVariance noise = MeasurePixelNoise(image);
  const GreyVariance usual = UsualVariance(options);
  for (std::size_t grey = 0; grey < noise.size(); ++grey) {
    noise[grey] = std::max(noise[grey] - usual[grey], 0.0F);
  }
  return WithoutNoise(HalfImage(image), noise);
}

DenseFrame MakeDenseFrame(const cv::Mat1b& left, const cv::Mat1b& right,
                          const SemiGlobalOptions& disparity) {
  DenseFrame frame;
  frame.image = left;
  frame.disparity = Match(left, right, disparity);
  LookNearer(right, disparity, frame);
  SpanHalfPixels(right, frame.right_low, frame.right_high);
  frame.filled = FillRows(frame.disparity, frame.unseen);
  return frame;
}

cv::Mat1f DifferenceVariance(const cv::Mat1b& image, const SurfaceOptions& options) {
  GreyVariance of_grey = UsualVariance(options);
  for (float& of_one : of_grey) of_one *= 2;
  cv::Mat1f variance;
  cv::LUT(image, cv::Mat1f(1, 256, of_grey.data()), variance);
  return variance;
}

Texture MeasureTexture(const cv::Mat1b& image, const SurfaceOptions& options) {
  cv::Mat1s gx, gy;
  cv::Sobel(image, gx, CV_16S, 1, 0);
  cv::Sobel(image, gy, CV_16S, 0, 1);
  const cv::Mat1f variance = DifferenceVariance(image, options);
  Texture products{cv::Mat1f(image.size()), cv::Mat1f(image.size()), cv::Mat1f(image.size())};
  ParallelFor(0, image.rows, [&](int y) {
    MultiplyRow(gx[y], gy[y], variance[y], image.cols,
                {products.xx[y], products.xy[y], products.yy[y]});
  });
  const int reach = options.window_px / 2;
  const cv::Mat1f xx = Reflected(products.xx, reach), xy = Reflected(products.xy, reach),
                  yy = Reflected(products.yy, reach);
  Texture texture = products;  // the same memory, which is of no more use
  ParallelFor(0, image.rows, [&](int y) {
    std::vector<float> scratch(static_cast<std::size_t>(xx.cols));
    const TextureRow row{texture.xx[y], texture.xy[y], texture.yy[y]};
    SumWindows<float>(xx, y, reach, scratch.data(), row.xx);
    SumWindows<float>(xy, y, reach, scratch.data(), row.xy);
    SumWindows<float>(yy, y, reach, scratch.data(), row.yy);
    TakeNoiseOff(options.window_px * options.window_px, image.cols, row);
  });
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
  ParallelFor(0, filled.rows, [&](int y) {
    const Eigen::Vector3f start = A.col(1) * static_cast<float>(y) + A.col(2);
    FindRow(start, A.col(0), t, filled[y], filled.cols,
            {field.place.ptr<float>(y), field.disparity[y], field.per_disparity.ptr<float>(y)});
  });
  return field;
}

}  // namespace aisle::slam::dynamic
