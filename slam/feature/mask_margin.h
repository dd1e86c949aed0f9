#pragma once

#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "slam/feature/feature_options.h"

namespace aisle::slam {

/// All pixels within a distance of a centre: half its width in the centre's row, the next one, ...
using Disc = std::vector<int>;

/// The pixels within `radius_px` by the chamfer distance of 3x3 steps (Borgefors 1986): 0.955 for a
/// step along an axis, 1.3693 along a diagonal. It differs from Euclid's by at most 4.5 %.
Disc ChamferDisc(double radius_px);

/// Asks a mask, 255 = reject, for rejected pixels near a few places, which costs less than the
/// distance of every pixel would.
class MaskMargin {
 public:
  /// An empty mask rejects nothing.
  explicit MaskMargin(const cv::Mat1b& mask);

  bool rejects_nothing() const { return rejected_before_.empty(); }
  /// Whether any pixel of the disc around one of the image is rejected.
  bool Reaches(cv::Point centre, const Disc& disc) const;

 private:
  /// Of each row how many of its first x pixels are rejected, modulo 2^16: no disc is that wide.
  cv::Mat_<std::uint16_t> rejected_before_;
};

/// Where a mask leaves no corner: nearer to a rejected pixel than FeatureOptions::mask_margin_px.
class MaskedArea {
 public:
  MaskedArea(const cv::Mat1b& mask, const FeatureOptions& options);

  bool empty() const { return margin_.rejects_nothing(); }
  /// Of a pixel of the full image, at one of the options' levels.
  bool Contains(cv::Point pixel, int level) const {
    return margin_.Reaches(pixel, discs_[static_cast<std::size_t>(level)]);
  }

 private:
  MaskMargin margin_;
  std::vector<Disc> discs_;
};

}  // namespace aisle::slam
