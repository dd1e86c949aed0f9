#include "slam/dynamic/dense_evidence.h"

#include <tbb/parallel_for.h>

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/disparity.h"
#include "slam/dynamic/median.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kLocalMean = 9;       // side of the window of the local mean, half-size pixels
constexpr double kPixelLow = -1.5;  // limits of one pixel's log-odds
constexpr double kPixelHigh = 2.0;
constexpr double kChi2Median = 0.4549;  // of one degree of freedom
constexpr int kLeastForNoise = 200;
constexpr double kEdgeStep = 1.5;  // half-size pixels of disparity across five pixels

/// Takes (x, y, disparity) of one frame to another: linear in homogeneous coordinates.
struct DisparityWarp {
  Eigen::Matrix3f A;  // of (x, y, 1)
  Eigen::Vector3f t;  // of the disparity

  DisparityWarp(const Eigen::Isometry3d& T, const StereoCamera& camera) {
    Eigen::Matrix3d K;
    K << camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1;
    A = (K * T.linear() * K.inverse()).cast<float>();
    t = (K * T.translation() / (camera.fx * camera.baseline_m)).cast<float>();
  }
};

enum class Earlier { kOutside, kUnknown, kSame, kNearer, kFarther };

/// What the earlier frame saw around a place, compared with the expected disparity.
Earlier Classify(const cv::Mat1f& disparity, float x, float y, float expected, float tolerance) {
  const int cx = static_cast<int>(x + 0.5F), cy = static_cast<int>(y + 0.5F);
  if (cx < 1 || cy < 1 || cx + 1 >= disparity.cols || cy + 1 >= disparity.rows) {
    return Earlier::kOutside;
  }
  bool nearer = false, farther = false;
  for (int j = -1; j <= 1; ++j) {
    const float* row = disparity[cy + j] + cx;
    for (int i = -1; i <= 1; ++i) {
      if (row[i] < 0) continue;
      const float difference = row[i] - expected;
      if (std::abs(difference) <= tolerance) return Earlier::kSame;
      (difference > 0 ? nearer : farther) = true;
    }
  }
  if (nearer == farther) return Earlier::kUnknown;  // nothing known, or an edge between the two
  return nearer ? Earlier::kNearer : Earlier::kFarther;
}

float Bilinear(const cv::Mat1f& image, float x, float y) {
  const int left = static_cast<int>(x), top = static_cast<int>(y);
  const float a = x - static_cast<float>(left), b = y - static_cast<float>(top);
  const float* upper = image[top] + left;
  const float* lower = image[top + 1] + left;
  return (1 - b) * ((1 - a) * upper[0] + a * upper[1]) + b * ((1 - a) * lower[0] + a * lower[1]);
}

struct Comparison {
  const DenseFrame& now;
  const DenseFrame& then;
  DisparityWarp warp;
  cv::Mat1f contrast;     // local variance of the detail
  cv::Mat1f row_texture;  // local mean of the squared gradient along the row
  float disparity_variance = 0;

  float static_variance, warp_noise, noise_per_displacement, tolerance, free_space;
};

struct PixelVerdict {
  float log_odds = 0;
  float normalized = -1;       // squared error in units of the static variance; < 0: not compared
  float disparity_error = -1;  // half-size pixels; < 0: not compared
};

PixelVerdict ComparePixel(const Comparison& c, int x, int y) {
  const float d = c.now.disparity(y, x);
  if (d <= 0 || c.now.edge(y, x) != 0) return {};
  const auto fx = static_cast<float>(x), fy = static_cast<float>(y);
  const float w = c.warp.A(2, 0) * fx + c.warp.A(2, 1) * fy + c.warp.A(2, 2) + c.warp.t[2] * d;
  if (w <= 0.05F) return {};
  const float u =
      (c.warp.A(0, 0) * fx + c.warp.A(0, 1) * fy + c.warp.A(0, 2) + c.warp.t[0] * d) / w;
  const float v =
      (c.warp.A(1, 0) * fx + c.warp.A(1, 1) * fy + c.warp.A(1, 2) + c.warp.t[1] * d) / w;
  const float expected = d / w;
  const Earlier earlier = Classify(c.then.disparity, u, v, expected, c.tolerance);
  if (earlier != Earlier::kSame && earlier != Earlier::kFarther) return {};
  const int x0 = std::max(x - 1, 0), x1 = std::min(x + 1, c.now.detail.cols - 1);
  const int y0 = std::max(y - 1, 0), y1 = std::min(y + 1, c.now.detail.rows - 1);
  const float gx = (c.now.detail(y, x1) - c.now.detail(y, x0)) / 2;
  const float gy = (c.now.detail(y1, x) - c.now.detail(y0, x)) / 2;
  const float warp =
      c.warp_noise + c.noise_per_displacement * (std::abs(u - fx) + std::abs(v - fy));
  // An error of the disparity moves the place along (t - (u, v) t_z): known only as well as there
  // is texture along the row to match.
  const float slope =
      (gx * (c.warp.t[0] - u * c.warp.t[2]) + gy * (c.warp.t[1] - v * c.warp.t[2])) / w;
  const float disparity_variance =
      c.disparity_variance + c.static_variance / (c.row_texture(y, x) + 1.0F);
  const float static_variance =
      c.static_variance + warp * warp * (gx * gx + gy * gy) + slope * slope * disparity_variance;
  const float dynamic_variance = static_variance + 2 * c.contrast(y, x);
  const float error = c.now.detail(y, x) - Bilinear(c.then.detail, u, v);
  const float square = error * error;
  const float log_odds = 0.5F * (square / static_variance - square / dynamic_variance -
                                 std::log(dynamic_variance / static_variance));
  if (earlier == Earlier::kFarther) {
    // Disparity alone errs by a period of a pattern: the picture must have changed there too.
    return {std::clamp(log_odds, 0.0F, c.free_space), -1, -1};
  }
  const float there = c.then.disparity(static_cast<int>(v + 0.5F), static_cast<int>(u + 0.5F));
  return {std::clamp(log_odds, static_cast<float>(kPixelLow), static_cast<float>(kPixelHigh)),
          square / static_variance, there >= 0 ? std::abs(there - expected) : -1};
}

cv::Mat1b DisparityEdges(const cv::Mat1f& disparity, double step) {
  const cv::Mat window = cv::Mat::ones(5, 5, CV_8U);
  cv::Mat1f low, high, range;
  cv::erode(disparity, low, window);
  cv::dilate(disparity, high, window);
  cv::subtract(high, low, range);
  cv::Mat1b edges;
  cv::compare(range, step, edges, cv::CMP_GT);
  return edges;
}

struct RowSamples {
  std::vector<float> normalized, disparity;
};

void Append(std::vector<float>& all, const std::vector<float>& some) {
  all.insert(all.end(), some.begin(), some.end());
}

void MeasureNoise(const std::vector<RowSamples>& rows, const DenseNoise& used,
                  DenseEvidence& evidence) {
  std::vector<float> normalized, disparity;
  for (const RowSamples& row : rows) {
    Append(normalized, row.normalized);
    Append(disparity, row.disparity);
  }
  evidence.noise_known =
      std::ssize(normalized) >= kLeastForNoise && std::ssize(disparity) >= kLeastForNoise;
  if (!evidence.noise_known) return;
  evidence.measured.intensity =
      used.intensity * std::sqrt(Median(std::move(normalized)) / kChi2Median);
  evidence.measured.disparity_px = 1.4826 * Median(std::move(disparity)) / std::sqrt(2.0);
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

DenseFrame MakeDenseFrame(const cv::Mat1b& half_image, const cv::Mat1f& half_disparity) {
  DenseFrame frame;
  frame.image = half_image;
  frame.disparity = half_disparity;
  cv::Mat1f mean;
  half_image.convertTo(frame.detail, CV_32F);
  cv::boxFilter(frame.detail, mean, -1, cv::Size(kLocalMean, kLocalMean));
  frame.detail -= mean;
  frame.edge = DisparityEdges(half_disparity, kEdgeStep);
  return frame;
}

DenseEvidence CompareWithEarlier(const DenseFrame& now, const DenseFrame& then,
                                 const Eigen::Isometry3d& T_then_now, const StereoCamera& half,
                                 const DenseNoise& noise, const EvidenceOptions& options) {
  const auto squared = [](double x) { return static_cast<float>(x * x); };
  Comparison c{now, then, DisparityWarp(T_then_now, half), {}, {}, 0, 0, 0, 0, 0, 0};
  cv::boxFilter(now.detail.mul(now.detail), c.contrast, -1, cv::Size(7, 7));
  cv::Mat1f along_row;
  cv::Sobel(now.detail, along_row, CV_32F, 1, 0, 1, 0.5);
  cv::boxFilter(along_row.mul(along_row), c.row_texture, -1, cv::Size(5, 5));
  c.disparity_variance = squared(noise.disparity_px);
  c.static_variance = 2 * squared(noise.intensity);
  c.warp_noise = static_cast<float>(options.warp_noise_px);
  c.noise_per_displacement = static_cast<float>(options.noise_per_displacement);
  c.tolerance = static_cast<float>(std::max(0.75, 4.2 * noise.disparity_px));
  c.free_space = static_cast<float>(options.free_space);

  DenseEvidence evidence;
  evidence.log_odds.create(now.image.rows / kNodeHalfPixels, now.image.cols / kNodeHalfPixels);
  std::vector<RowSamples> samples(static_cast<std::size_t>(evidence.log_odds.rows));
  tbb::parallel_for(0, evidence.log_odds.rows, [&](int row) {
    RowSamples& kept = samples[static_cast<std::size_t>(row)];
    for (int column = 0; column < evidence.log_odds.cols; ++column) {
      float sum = 0;
      for (int k = 0; k < kNodeHalfPixels * kNodeHalfPixels; ++k) {
        const PixelVerdict verdict = ComparePixel(c, column * kNodeHalfPixels + k % kNodeHalfPixels,
                                                  row * kNodeHalfPixels + k / kNodeHalfPixels);
        sum += verdict.log_odds;
        if (k != 0 || column % 2 != row % 2) continue;  // every eighth pixel tells the noise
        if (verdict.normalized >= 0) kept.normalized.push_back(verdict.normalized);
        if (verdict.disparity_error >= 0) kept.disparity.push_back(verdict.disparity_error);
      }
      evidence.log_odds(row, column) = sum * static_cast<float>(options.dense_weight);
    }
  });
  MeasureNoise(samples, noise, evidence);
  return evidence;
}

}  // namespace aisle::slam::dynamic
