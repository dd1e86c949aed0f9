#include "slam/dynamic/paper/flow_tracks.h"

#include <opencv2/video.hpp>

#include "slam/common/median.h"

namespace aisle::slam::dynamic {
namespace {

using Pyramid = std::vector<cv::Mat>;

Pyramid BuildPyramid(const cv::Mat1b& image, const FlowOptions& options) {
  Pyramid pyramid;
  cv::buildOpticalFlowPyramid(image, pyramid, cv::Size(options.window_px, options.window_px),
                              options.pyramid_levels - 1, true);
  return pyramid;
}

struct Followed {
  std::vector<cv::Point2f> points;
  std::vector<unsigned char> found;
};

Followed Follow(const Pyramid& from, const Pyramid& to, const std::vector<cv::Point2f>& points,
                const std::vector<cv::Point2f>& guess, const FlowOptions& options) {
  Followed result{guess, {}};
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(
      from, to, points, result.points, result.found, error,
      cv::Size(options.window_px, options.window_px), options.pyramid_levels - 1,
      cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, options.iterations, 0.01),
      cv::OPTFLOW_USE_INITIAL_FLOW, 1e-3);
  return result;
}

}  // namespace

std::vector<std::optional<cv::Point2f>> FollowPoints(const cv::Mat1b& previous,
                                                     const cv::Mat1b& current,
                                                     const std::vector<cv::Point2f>& points,
                                                     const FlowOptions& options) {
  if (points.empty()) return {};
  const Pyramid before = BuildPyramid(previous, options), now = BuildPyramid(current, options);
  const Followed there = Follow(before, now, points, points, options);
  const bool check = options.forward_backward_px > 0;
  const Followed back =
      check ? Follow(now, before, there.points, points, options) : Followed{points, there.found};

  const cv::Rect2f image(0, 0, static_cast<float>(current.cols), static_cast<float>(current.rows));
  std::vector<std::optional<cv::Point2f>> followed(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (there.found[i] == 0 || back.found[i] == 0 || !image.contains(there.points[i])) continue;
    if (check && cv::norm(back.points[i] - points[i]) > options.forward_backward_px) continue;
    followed[i] = there.points[i];
  }
  return followed;
}

std::vector<Track> TrackPoints(const cv::Mat1b& previous, const cv::Mat1b& current,
                               const std::vector<cv::Point2f>& points, const FlowOptions& options) {
  const auto followed = FollowPoints(previous, current, points, options);
  std::vector<Track> tracks;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (followed[i]) tracks.push_back({points[i], *followed[i]});
  }
  return tracks;
}

double MedianFlow(const std::vector<Track>& tracks) {
  std::vector<double> lengths;
  for (const Track& track : tracks) lengths.push_back(cv::norm(track.current - track.previous));
  return Median(std::move(lengths));
}

}  // namespace aisle::slam::dynamic
