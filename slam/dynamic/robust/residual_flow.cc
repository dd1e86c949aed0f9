#include "slam/dynamic/robust/residual_flow.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "slam/common/parallel.h"
#include "slam/flow/patch_flow.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kFollowWindow = 9;    // half-size pixels, odd
constexpr float kLeastTexture = 4;  // of the weaker direction: half a pixel of deviation

/// The smaller eigenvalue of the pixels of a row; 0 where the disparity is not known.
void HoldRow(const Texture& texture, const cv::Mat1f& disparity, int y, float* held) {
  const float *xx = texture.xx[y], *xy = texture.xy[y], *yy = texture.yy[y], *d = disparity[y];
  const int columns = disparity.cols;
#pragma GCC ivdep
  for (int x = 0; x < columns; ++x) {
    const float half = (xx[x] + yy[x]) / 2, difference = (xx[x] - yy[x]) / 2;
    const float least = half - std::sqrt(difference * difference + xy[x] * xy[x]);
    held[x] = d[x] > 0 ? least : 0.0F;
  }
}

double FullPixel(double half) { return 2 * half + 0.5; }

/// The best of each cell of some rows, the first of equals, where it holds at all.
std::vector<cv::Point> BestOfRows(const Texture& texture, const cv::Mat1f& disparity, int top,
                                  int cell_px) {
  const int columns = disparity.cols, bottom = std::min(top + cell_px, disparity.rows);
  const auto cells = static_cast<std::size_t>((columns + cell_px - 1) / cell_px);
  std::vector<float> best(cells, kLeastTexture), held(static_cast<std::size_t>(columns));
  std::vector<cv::Point> at(cells, {-1, -1});
  for (int y = top; y < bottom; ++y) {
    HoldRow(texture, disparity, y, held.data());
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const int left = static_cast<int>(cell) * cell_px, right = std::min(left + cell_px, columns);
      for (int x = left; x < right; ++x) {
        const float here = held[static_cast<std::size_t>(x)];
        if (here <= best[cell]) continue;
        best[cell] = here;
        at[cell] = {x, y};
      }
    }
  }
  std::erase_if(at, [](const cv::Point& point) { return point.x < 0; });
  return at;
}

/// Lucas-Kanade from given places; far outside the image where a point was lost.
struct Followed {
  std::vector<cv::Point2f> places;
  std::vector<float> errors;
};
Followed Follow(const std::vector<cv::Point2f>& from, std::vector<cv::Point2f> guesses,
                const std::vector<cv::Mat>& now, const cv::Mat1b& then) {
  Followed followed{std::move(guesses), {}};
  std::vector<unsigned char> found;
  const cv::TermCriteria enough(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 15, 0.01);
  cv::calcOpticalFlowPyrLK(now, then, from, followed.places, found, followed.errors,
                           {kFollowWindow, kFollowWindow}, 0, enough, cv::OPTFLOW_USE_INITIAL_FLOW);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] != 0) continue;
    followed.places[i] = {-1e4F, -1e4F};
    followed.errors[i] = std::numeric_limits<float>::max();
  }
  return followed;
}

/// Where each point was in the earlier image, by itself.
std::vector<cv::Point2f> FollowPoints(const std::vector<cv::Point>& points, const DenseFrame& now,
                                      const DenseFrame& then, const cv::Mat2f& flow,
                                      const cv::Mat2f& expected) {
  if (points.empty()) return {};
  std::vector<cv::Point2f> from, guesses;  // all by the flow, then all by expectation
  for (const cv::Mat2f* places : {&flow, &expected}) {
    for (const cv::Point& at : points) {
      from.emplace_back(at);
      guesses.emplace_back((*places)(at));
    }
  }
  std::vector<cv::Mat> pyramid;  // of one level, with derivatives
  cv::buildOpticalFlowPyramid(now.image, pyramid, {kFollowWindow, kFollowWindow}, 0);
  Followed followed = Follow(from, std::move(guesses), pyramid, then.image);
  for (std::size_t i = 0, other = points.size(); i < points.size(); ++i, ++other) {
    if (followed.errors[other] < followed.errors[i]) followed.places[i] = followed.places[other];
  }
  followed.places.resize(points.size());
  return followed.places;
}

/// The probability that a pixel stands still; hardly any within a region that moves, whatever its
/// own evidence: plain cloth shows little.
double TrustIn(const LabelMemory& memory, cv::Point at, double in_region) {
  const double trust = 1 / (1 + std::exp(static_cast<double>(memory.log_odds(at))));
  return memory.regions.labels(at) > 0 ? std::min(trust, in_region) : trust;
}

}  // namespace

cv::Mat1b SampleAt(const cv::Mat1b& image, const cv::Mat2f& places) {
  cv::Mat1b sampled;
  cv::remap(image, sampled, places, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return sampled;
}

cv::Mat2f FollowBack(const cv::Mat1b& now, const FlowPyramid& pyramid, const cv::Mat1b& then,
                     const cv::Mat2f& expected, const DenseFlowOptions& options) {
  cv::Mat1b view = now.clone();  // stays where the earlier image did not reach
  cv::remap(then, view, expected, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
  cv::Mat2f residual = FlowTo(view, pyramid, options);
  // What is seen at x + residual of the view came from the place expected of that pixel.
  for (int y = 0; y < residual.rows; ++y) {
    float* row = residual.ptr<float>(y);
    for (int x = 0; x < residual.cols; ++x) {
      row[2 * x] += static_cast<float>(x);
      row[2 * x + 1] += static_cast<float>(y);
    }
  }
  cv::Mat2f places;
  cv::remap(expected, places, residual, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return places;
}

std::vector<cv::Point> WellHeld(const Texture& texture, const cv::Mat1f& disparity, int cell_px) {
  std::vector<std::vector<cv::Point>> rows(
      static_cast<std::size_t>((disparity.rows + cell_px - 1) / cell_px));
  ParallelFor(std::size_t{0}, rows.size(), [&](std::size_t row) {
    rows[row] = BestOfRows(texture, disparity, static_cast<int>(row) * cell_px, cell_px);
  });
  std::vector<cv::Point> points;
  for (const auto& row : rows) points.insert(points.end(), row.begin(), row.end());
  return points;
}

std::vector<StereoMatch> MatchesAlong(const std::vector<cv::Point>& points, const cv::Mat2f& flow,
                                      const cv::Mat2f& expected, const DenseFrame& now,
                                      const DenseFrame& then, const LabelMemory& memory,
                                      double trust_in_region) {
  const std::vector<cv::Point2f> places = FollowPoints(points, now, then, flow, expected);
  std::vector<StereoMatch> matches;
  const cv::Rect image({0, 0}, flow.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cv::Point at = points[i], near(cvRound(places[i].x), cvRound(places[i].y));
    if (!image.contains(near) || !(then.disparity(near) > 0)) continue;
    StereoMatch match;
    match.now = {FullPixel(at.x), FullPixel(at.y), 2.0 * now.disparity(at)};
    match.before = {FullPixel(places[i].x), FullPixel(places[i].y), 2.0 * then.disparity(near)};
    match.weight = TrustIn(memory, at, trust_in_region);
    matches.push_back(match);
  }
  return matches;
}

}  // namespace aisle::slam::dynamic
