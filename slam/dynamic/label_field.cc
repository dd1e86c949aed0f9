#include "slam/dynamic/label_field.h"

#include <opencv2/imgproc.hpp>

#include "slam/dynamic/dense_evidence.h"
#include "slam/dynamic/disparity.h"

namespace aisle::slam::dynamic {
namespace {

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

float Link(float d1, float d2, float g1, float g2, const FieldOptions& options) {
  // Half-size disparities are half as large as the pixels that the options speak of.
  const float step = std::abs(d1 - d2) * 2;
  const float scale = static_cast<float>(options.disparity_px) +
                      static_cast<float>(options.disparity_share) * (d1 + d2);
  const float disparity = step / scale;
  const float contrast = std::abs(g1 - g2) / static_cast<float>(options.contrast);
  return static_cast<float>(options.coupling) /
         ((1 + disparity * disparity * disparity * disparity) * (1 + contrast));
}

}  // namespace

cv::Mat1f NodeDisparity(const cv::Mat1f& half_disparity) {
  cv::Mat1f nodes(half_disparity.rows / kNodeHalfPixels, half_disparity.cols / kNodeHalfPixels);
  for (int y = 0; y < nodes.rows; ++y) {
    for (int x = 0; x < nodes.cols; ++x) {
      // Unknown pixels sort before the known ones: the median is that of the upper part.
      std::array<float, kNodeHalfPixels * kNodeHalfPixels> pixels{};
      std::size_t known = 0;
      for (int k = 0; k < kNodeHalfPixels * kNodeHalfPixels; ++k) {
        const float d = half_disparity(y * kNodeHalfPixels + k / kNodeHalfPixels,
                                       x * kNodeHalfPixels + k % kNodeHalfPixels);
        pixels[static_cast<std::size_t>(k)] = d;
        known += d >= 0 ? 1 : 0;
      }
      std::sort(pixels.begin(), pixels.end());
      nodes(y, x) = known > 0 ? pixels[pixels.size() - known + known / 2] : kNoDisparity;
    }
    FillRow(nodes[y], nodes.cols);
  }
  return nodes;
}

NodeLinks LinkNodes(const cv::Mat1f& node_disparity, const cv::Mat1b& half_image,
                    const FieldOptions& options) {
  cv::Mat1b grey;
  cv::resize(half_image, grey, node_disparity.size(), 0, 0, cv::INTER_AREA);
  NodeLinks links{cv::Mat1f(grey.size(), 0.0F), cv::Mat1f(grey.size(), 0.0F)};
  for (int y = 0; y < grey.rows; ++y) {
    for (int x = 0; x < grey.cols; ++x) {
      const float d = node_disparity(y, x);
      const float g = grey(y, x);
      if (x + 1 < grey.cols) {
        links.right(y, x) = Link(d, node_disparity(y, x + 1), g, grey(y, x + 1), options);
      }
      if (y + 1 < grey.rows) {
        links.down(y, x) = Link(d, node_disparity(y + 1, x), g, grey(y + 1, x), options);
      }
    }
  }
  return links;
}

cv::Mat1f SolveField(const cv::Mat1f& evidence, const NodeLinks& links,
                     const FieldOptions& options) {
  cv::Mat1f log_odds = evidence.clone();
  // x / (2 + |x|) stands in for tanh(x / 2): the same slope at zero and the same limits.
  const auto belief = [](float l) { return l / (2 + std::abs(l)); };
  const auto update = [&](int y, int x) {
    float sum = evidence(y, x);
    if (x > 0) sum += links.right(y, x - 1) * belief(log_odds(y, x - 1));
    if (y > 0) sum += links.down(y - 1, x) * belief(log_odds(y - 1, x));
    if (x + 1 < evidence.cols) sum += links.right(y, x) * belief(log_odds(y, x + 1));
    if (y + 1 < evidence.rows) sum += links.down(y, x) * belief(log_odds(y + 1, x));
    log_odds(y, x) = sum;
  };
  for (int sweep = 0; sweep < options.sweeps; ++sweep) {
    for (int k = 0; k < static_cast<int>(evidence.total()); ++k) {
      const int node = sweep % 2 == 0 ? k : static_cast<int>(evidence.total()) - 1 - k;
      update(node / evidence.cols, node % evidence.cols);
    }
  }
  return log_odds;
}

}  // namespace aisle::slam::dynamic
