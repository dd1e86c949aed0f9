#include "slam/feature/feature_grid.h"

#include <algorithm>
#include <cmath>

namespace aisle::slam {
namespace {

constexpr float kCell = 16;  // pixels: near the usual search radius

int CellOf(float pixel, int cells) {
  // Clamped before it is an integer: a wide search reaches further than those count.
  return static_cast<int>(
      std::clamp(std::floor(pixel / kCell), 0.0F, static_cast<float>(cells - 1)));
}

}  // namespace

FeatureGrid::FeatureGrid(const std::vector<Keypoint>& keypoints, cv::Size image)
    : columns_(static_cast<int>(std::ceil(static_cast<float>(image.width) / kCell))),
      rows_(static_cast<int>(std::ceil(static_cast<float>(image.height) / kCell))),
      begin_(static_cast<std::size_t>(columns_ * rows_) + 1, 0),
      entries_(keypoints.size()) {
  const auto cell = [&](const Keypoint& keypoint) {
    return static_cast<std::size_t>(CellOf(keypoint.pixel.y, rows_) * columns_ +
                                    CellOf(keypoint.pixel.x, columns_));
  };
  for (const Keypoint& keypoint : keypoints) ++begin_[cell(keypoint) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  std::vector<int> next = begin_;
  for (std::size_t i = 0; i < keypoints.size(); ++i) {
    const int slot = next[cell(keypoints[i])]++;
    entries_[static_cast<std::size_t>(slot)] = {keypoints[i].pixel, keypoints[i].level,
                                                static_cast<int>(i)};
  }
}

std::vector<int> FeatureGrid::Near(cv::Point2f center, float radius, int lowest,
                                   int highest) const {
  std::vector<int> near;
  if (entries_.empty()) return near;
  const int first_column = CellOf(center.x - radius, columns_);
  const int last_column = CellOf(center.x + radius, columns_);
  for (int row = CellOf(center.y - radius, rows_); row <= CellOf(center.y + radius, rows_); ++row) {
    const int first = begin_[static_cast<std::size_t>(row * columns_ + first_column)];
    const int last = begin_[static_cast<std::size_t>(row * columns_ + last_column) + 1];
    for (int i = first; i < last; ++i) {
      const Entry& entry = entries_[static_cast<std::size_t>(i)];
      if (entry.level < lowest || entry.level > highest) continue;
      if (std::abs(entry.pixel.x - center.x) > radius) continue;
      if (std::abs(entry.pixel.y - center.y) > radius) continue;
      near.push_back(entry.index);
    }
  }
  return near;
}

}  // namespace aisle::slam
