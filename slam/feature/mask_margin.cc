#include "slam/feature/mask_margin.h"

#include <algorithm>
#include <cmath>

namespace aisle::slam {
namespace {

/// In whole 65536ths of a pixel, so that sums are exact.
constexpr int kOne = 1 << 16, kAlongAxis = 62587, kDiagonal = 89738;

int ChamferDistance(int dx, int dy) {
  const int shorter = std::min(dx, dy), longer = std::max(dx, dy);
  return shorter * kDiagonal + (longer - shorter) * kAlongAxis;
}

}  // namespace

Disc ChamferDisc(double radius_px) {
  const double radius = radius_px * kOne;
  Disc disc;
  for (int dy = 0; ChamferDistance(0, dy) <= radius; ++dy) {
    int half_width = 0;
    while (ChamferDistance(half_width + 1, dy) <= radius) ++half_width;
    disc.push_back(half_width);
  }
  return disc;
}

MaskMargin::MaskMargin(const cv::Mat1b& mask) {
  if (mask.empty() || cv::countNonZero(mask) == 0) return;
  rejected_before_.create(mask.rows, mask.cols + 1);
  for (int y = 0; y < mask.rows; ++y) {
    const std::uint8_t* row = mask[y];
    std::uint16_t* before = rejected_before_[y];
    std::uint16_t count = 0;
    for (int x = 0; x < mask.cols; ++x) {
      before[x] = count;
      count = static_cast<std::uint16_t>(count + (row[x] != 0 ? 1 : 0));
    }
    before[mask.cols] = count;
  }
}

bool MaskMargin::Reaches(cv::Point centre, const Disc& disc) const {
  if (rejects_nothing()) return false;
  const int reach = static_cast<int>(disc.size()) - 1, width = rejected_before_.cols - 1;
  const int top = std::max(centre.y - reach, 0),
            bottom = std::min(centre.y + reach, rejected_before_.rows - 1);
  for (int y = top; y <= bottom; ++y) {
    const int half_width = disc[static_cast<std::size_t>(std::abs(y - centre.y))];
    const std::uint16_t* before = rejected_before_[y];
    if (before[std::max(centre.x - half_width, 0)] !=
        before[std::min(centre.x + half_width + 1, width)]) {
      return true;
    }
  }
  return false;
}

MaskedArea::MaskedArea(const cv::Mat1b& mask, const FeatureOptions& options) : margin_(mask) {
  double scale = 1;
  for (int level = 0; level < options.levels; ++level, scale *= options.scale) {
    discs_.push_back(ChamferDisc(options.mask_margin_px * scale));
  }
}

}  // namespace aisle::slam
