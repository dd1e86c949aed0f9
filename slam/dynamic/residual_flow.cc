#include "slam/dynamic/residual_flow.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace aisle::slam::dynamic {
namespace {

constexpr float kLeastTexture = 4;  // of the weaker direction: half a pixel of deviation

/// The smaller eigenvalue.
float HeldBy(const Texture& texture, int y, int x) {
  const float half = (texture.xx(y, x) + texture.yy(y, x)) / 2;
  const float difference = (texture.xx(y, x) - texture.yy(y, x)) / 2;
  return half - std::sqrt(difference * difference + texture.xy(y, x) * texture.xy(y, x));
}

double FullPixel(double half) { return 2 * half + 0.5; }

cv::Point BestIn(const cv::Rect& cell, const Texture& texture, const cv::Mat1f& disparity) {
  float best = kLeastTexture;
  cv::Point at(-1, -1);
  for (int y = cell.y; y < cell.y + cell.height; ++y) {
    for (int x = cell.x; x < cell.x + cell.width; ++x) {
      if (!(disparity(y, x) > 0)) continue;
      const float held = HeldBy(texture, y, x);
      if (held <= best) continue;
      best = held;
      at = {x, y};
    }
  }
  return at;
}

}  // namespace

cv::Mat1b SampleAt(const cv::Mat1b& image, const cv::Mat2f& places) {
  cv::Mat1b sampled;
  cv::remap(image, sampled, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return sampled;
}

cv::Mat2f FollowBack(const cv::Mat1b& now, const cv::Mat1b& then, const cv::Mat2f& expected,
                     const ResidualFlowOptions& options) {
  cv::Mat1b view = now.clone();  // stays where the earlier image did not reach
  cv::remap(then, view, expected, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
  const auto flow = cv::DISOpticalFlow::create(cv::DISOpticalFlow::PRESET_FAST);
  flow->setFinestScale(options.finest_scale);
  flow->setGradientDescentIterations(options.descents);
  flow->setVariationalRefinementIterations(options.refinements);
  flow->setUseSpatialPropagation(false);  // it would stop where one thread's stripe ends
  cv::Mat2f residual;
  flow->calc(now, view, residual);
  // What is seen at x + residual of the view came from the place expected of that pixel.
  for (int y = 0; y < residual.rows; ++y) {
    for (int x = 0; x < residual.cols; ++x) {
      residual(y, x) += cv::Vec2f(static_cast<float>(x), static_cast<float>(y));
    }
  }
  cv::Mat2f places;
  cv::remap(expected, places, residual, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return places;
}

std::vector<StereoMatch> MatchesAlong(const cv::Mat2f& flow, const DenseFrame& now,
                                      const DenseFrame& then, const Texture& texture,
                                      const cv::Mat1f& log_odds, int cell_px) {
  std::vector<StereoMatch> matches;
  const cv::Rect image({0, 0}, flow.size());
  for (int top = 0; top < flow.rows; top += cell_px) {
    for (int left = 0; left < flow.cols; left += cell_px) {
      const cv::Point at =
          BestIn(cv::Rect(left, top, cell_px, cell_px) & image, texture, now.disparity);
      if (at.x < 0) continue;
      const cv::Vec2f& to = flow(at);
      const cv::Point near(cvRound(to[0]), cvRound(to[1]));
      if (!image.contains(near) || !(then.disparity(near) > 0)) continue;
      StereoMatch match;
      match.now = {FullPixel(at.x), FullPixel(at.y), 2.0 * now.disparity(at)};
      match.before = {FullPixel(to[0]), FullPixel(to[1]), 2.0 * then.disparity(near)};
      match.weight = log_odds.empty() ? 0.5 : 1 / (1 + std::exp(log_odds(at)));
      matches.push_back(match);
    }
  }
  return matches;
}

}  // namespace aisle::slam::dynamic
