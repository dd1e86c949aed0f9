#include "simulator/proof/picture_change.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace aisle::sim {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr int kWindow = 9;           // px
constexpr int kShadowReach = 12;     // px
constexpr int kOutline = 2;          // px
constexpr float kSameDepth = 0.02f;  // share
/// Three quarters of what is Gaussian with a deviation of 1 lie within this of its mean.
constexpr double kGaussQuartile = 1.1503;

/// 255 where all pixels within kOutline show one thing without a jump in depth.
cv::Mat1b AwayFromOutlines(const PictureWithFlow& picture) {
  const cv::Mat kernel =
      cv::getStructuringElement(cv::MORPH_RECT, {2 * kOutline + 1, 2 * kOutline + 1});
  cv::Mat1w low, high;
  cv::erode(picture.instance, low, kernel);
  cv::dilate(picture.instance, high, kernel);
  // A plane's depth is smooth however steeply it runs away, so jumps are looked for between
  // neighbours.
  cv::Mat1b smooth(picture.depth.size(), std::uint8_t{255});
  for (int y = 0; y < smooth.rows; ++y) {
    for (int x = 0; x < smooth.cols; ++x) {
      const float z = picture.depth(y, x);
      const auto jumps = [&](int qx, int qy) {
        return qx < smooth.cols && qy < smooth.rows &&
               !(std::abs(picture.depth(qy, qx) - z) <= kSameDepth * z);
      };
      if (jumps(x + 1, y) || jumps(x, y + 1)) smooth(y, x) = 0;
    }
  }
  cv::erode(smooth, smooth, kernel);
  smooth.setTo(0, low != high);
  return smooth;
}

/// Bilinear value at a place inside the image; NaN if any of the four is.
float Sample(const cv::Mat1f& image, float x, float y) {
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  if (x0 < 0 || y0 < 0 || x0 + 1 >= image.cols || y0 + 1 >= image.rows) return kNan;
  const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
  return (1 - fy) * ((1 - fx) * image(y0, x0) + fx * image(y0, x0 + 1)) +
         fy * ((1 - fx) * image(y0 + 1, x0) + fx * image(y0 + 1, x0 + 1));
}

/// Means over windows; NaN unless all pixels of the window are known and of the wanted kind.
cv::Mat1f WindowMeans(const cv::Mat1f& change, const cv::Mat1b& wanted) {
  cv::Mat1b known(change.size(), std::uint8_t{0});
  cv::Mat1f value(change.size(), 0.0f);
  for (int y = 0; y < change.rows; ++y) {
    for (int x = 0; x < change.cols; ++x) {
      if (!wanted(y, x) || std::isnan(change(y, x))) continue;
      known(y, x) = 255;
      value(y, x) = change(y, x);
    }
  }
  cv::Mat1f mean;
  cv::boxFilter(value, mean, CV_32F, {kWindow, kWindow}, {-1, -1}, true, cv::BORDER_CONSTANT);
  cv::erode(known, known, cv::Mat1b::ones(kWindow, kWindow), {-1, -1}, 1, cv::BORDER_CONSTANT,
            cv::Scalar(0));
  mean.setTo(kNan, ~known);
  return mean;
}

double UpperQuartile(std::vector<double>* values) {
  const auto at = values->begin() + static_cast<std::ptrdiff_t>(values->size() * 3 / 4);
  std::ranges::nth_element(*values, at);
  return *at;
}

PictureChange Summarize(const cv::Mat1f& change, const cv::Mat1f& change_next,
                        const cv::Mat2f& flow, const cv::Mat1b& wanted) {
  const cv::Mat1f first = WindowMeans(change, wanted);
  PictureChange result;
  double squares = 0;
  std::vector<double> curvature;
  for (int y = 0; y < first.rows; ++y) {
    for (int x = 0; x < first.cols; ++x) {
      if (std::isnan(first(y, x))) continue;
      const cv::Vec2f& f = flow(y, x);
      const float second =
          Sample(change_next, static_cast<float>(x) + f[0], static_cast<float>(y) + f[1]);
      if (std::isnan(second)) continue;
      squares += first(y, x) * first(y, x);
      curvature.push_back(std::abs(second - first(y, x)));
      ++result.compared;
    }
  }
  if (result.compared == 0) return result;
  result.rms = std::sqrt(squares / result.compared);
  result.flicker = UpperQuartile(&curvature) / kGaussQuartile / std::sqrt(3.0);
  return result;
}

}  // namespace

cv::Mat1f ChangeAlongFlow(const PictureWithFlow& now, const PictureWithFlow& next) {
  const cv::Mat1b inner = AwayFromOutlines(now), inner_next = AwayFromOutlines(next);
  cv::Mat1f change(now.grey.size(), kNan);
  for (int y = 0; y < change.rows; ++y) {
    for (int x = 0; x < change.cols; ++x) {
      const cv::Vec2f& f = now.flow(y, x);
      if (!inner(y, x) || std::isnan(f[0])) continue;
      const float qx = static_cast<float>(x) + f[0], qy = static_cast<float>(y) + f[1];
      const int nx = static_cast<int>(std::lround(qx)), ny = static_cast<int>(std::lround(qy));
      if (nx < 0 || ny < 0 || nx >= change.cols || ny >= change.rows) continue;
      if (!inner_next(ny, nx) || next.instance(ny, nx) != now.instance(y, x)) continue;
      const float z = now.z_next(y, x);
      if (!(std::abs(next.depth(ny, nx) - z) <= kSameDepth * z)) continue;
      change(y, x) = Sample(next.grey, qx, qy) - now.grey(y, x);
    }
  }
  return change;
}

PictureChanges CompareInTime(const PictureWithFlow& first, const PictureWithFlow& second,
                             const PictureWithFlow& third) {
  const cv::Mat1f change = ChangeAlongFlow(first, second);
  const cv::Mat1f later = ChangeAlongFlow(second, third);
  const cv::Mat1b all(change.size(), std::uint8_t{255});
  const cv::Mat1f change_next = WindowMeans(later, all);
  // Where a shadow is now or is about to be; the camera moves a few pixels meanwhile.
  cv::Mat1b near_shadow, resting, shadow;
  cv::bitwise_or(first.shadow, second.shadow, near_shadow);
  cv::bitwise_or(near_shadow, third.shadow, near_shadow);
  cv::dilate(near_shadow, near_shadow, cv::Mat1b::ones(2 * kShadowReach + 1, 2 * kShadowReach + 1));
  cv::bitwise_or(near_shadow, first.mover, resting);
  cv::bitwise_not(resting, resting);
  cv::bitwise_not(first.mover, shadow);
  cv::bitwise_and(shadow, first.shadow, shadow);
  return {.statics = Summarize(change, change_next, first.flow, resting),
          .movers = Summarize(change, change_next, first.flow, first.mover),
          .shadows = Summarize(change, change_next, first.flow, shadow)};
}

std::string FailureOf(const PictureChanges& changes) {
  constexpr double kMostAtRest = 2.5, kMostFlicker = 2;  // grey levels
  constexpr int kFewWindows = 500;  // a waist that the arm swings past has some two hundred
  const auto& [statics, movers, shadows] = changes;
  if (statics.compared >= kFewWindows && statics.rms > kMostAtRest) {
    return fmt::format(
        "things at rest change by {:.2f} grey levels rms to the next frame along their flow",
        statics.rms);
  }
  if (movers.compared >= kFewWindows && movers.flicker > kMostFlicker) {
    return fmt::format("movers flicker by {:.2f} grey levels rms along their flow", movers.flicker);
  }
  if (shadows.compared >= kFewWindows && shadows.flicker > kMostFlicker) {
    return fmt::format("moving shadows flicker by {:.2f} grey levels rms", shadows.flicker);
  }
  return "";
}

}  // namespace aisle::sim
