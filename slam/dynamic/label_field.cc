#include "slam/dynamic/label_field.h"

#include <tbb/parallel_for.h>

#include <opencv2/imgproc.hpp>

namespace aisle::slam::dynamic {
namespace {

struct Tie {
  float coupling, disparity, disparity_share, contrast, floor_link;

  float operator()(float d1, float d2, int g1, int g2, bool floor1, bool floor2) const {
    if (floor1 != floor2) return coupling * floor_link;
    const float step = (d1 - d2) / (disparity + disparity_share * (d1 + d2) / 2);
    const float steps = step * step;
    const float edge = static_cast<float>(std::abs(g1 - g2)) / contrast;
    return coupling / ((1 + steps * steps) * (1 + edge));
  }
};

constexpr int kMostRings = 60;

}  // namespace

Links LinkPixels(const cv::Mat1f& filled, const cv::Mat1b& image, const cv::Mat1b& floor,
                 const FieldOptions& options) {
  const Tie tie{static_cast<float>(options.coupling), static_cast<float>(options.disparity),
                static_cast<float>(options.disparity_share), static_cast<float>(options.contrast),
                static_cast<float>(options.floor_link)};
  Links links{cv::Mat1f(image.size(), 0.0F), cv::Mat1f(image.size(), 0.0F)};
  tbb::parallel_for(0, image.rows, [&](int y) {
    const auto between = [&](int x, int x2, int y2) {
      return tie(filled(y, x), filled(y2, x2), image(y, x), image(y2, x2), floor(y, x) != 0,
                 floor(y2, x2) != 0);
    };
    for (int x = 0; x < image.cols; ++x) {
      if (x + 1 < image.cols) links.right(y, x) = between(x, x + 1, y);
      if (y + 1 < image.rows) links.down(y, x) = between(x, x, y + 1);
    }
  });
  return links;
}

cv::Mat1f SolveField(const cv::Mat1f& evidence, const Links& links, const FieldOptions& options) {
  cv::Mat1f log_odds = evidence.clone();
  // 2 x / (2 + |x|) stands in for the neighbour's belief: a straight line at zero that saturates.
  cv::Mat1f belief(evidence.size());
  const auto believe = [](float l) { return 2 * l / (2 + std::abs(l)); };
  const int total = static_cast<int>(evidence.total());
  for (int k = 0; k < total; ++k) belief(k) = believe(evidence(k));
  const auto update = [&](int y, int x) {
    float sum = evidence(y, x);
    if (x > 0) sum += links.right(y, x - 1) * belief(y, x - 1);
    if (y > 0) sum += links.down(y - 1, x) * belief(y - 1, x);
    if (x + 1 < evidence.cols) sum += links.right(y, x) * belief(y, x + 1);
    if (y + 1 < evidence.rows) sum += links.down(y, x) * belief(y + 1, x);
    log_odds(y, x) = sum;
    belief(y, x) = believe(sum);
  };
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    for (int k = 0; k < total; ++k) {
      const int pixel = sweep % 2 == 0 ? k : total - 1 - k;
      update(pixel / evidence.cols, pixel % evidence.cols);
    }
  }
  return log_odds;
}

cv::Mat1b GrowMoving(const cv::Mat1f& field, const cv::Mat1f& evidence, const Links& links,
                     const cv::Mat1b& floor, const cv::Mat1f& farthest,
                     const FieldOptions& options) {
  cv::Mat1b moving;
  cv::compare(field, options.moving, moving, cv::CMP_GT);
  std::vector<cv::Point> front, next;
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x) {
      if (moving(y, x) != 0 && evidence(y, x) > static_cast<float>(options.grow_from)) {
        front.emplace_back(x, y);
      }
    }
  }
  const auto least_link = static_cast<float>(options.grow_link * options.coupling);
  const auto reach = [&](int x, int y, float link) {
    if (link < least_link || moving(y, x) != 0 || floor(y, x) != 0) return;
    if (evidence(y, x) < static_cast<float>(options.grow_to)) return;
    moving(y, x) = 255;
    next.emplace_back(x, y);
  };
  for (int ring = 0; ring < kMostRings && !front.empty(); ++ring) {
    next.clear();
    for (const cv::Point& p : front) {
      if (static_cast<float>(ring) >= farthest(p)) continue;
      if (p.x > 0) reach(p.x - 1, p.y, links.right(p.y, p.x - 1));
      if (p.x + 1 < field.cols) reach(p.x + 1, p.y, links.right(p.y, p.x));
      if (p.y > 0) reach(p.x, p.y - 1, links.down(p.y - 1, p.x));
      if (p.y + 1 < field.rows) reach(p.x, p.y + 1, links.down(p.y, p.x));
    }
    std::swap(front, next);
  }
  return moving;
}

}  // namespace aisle::slam::dynamic
