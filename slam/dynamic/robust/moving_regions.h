#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "slam/dynamic/robust/label_field.h"
#include "slam/dynamic/robust/robust_options.h"

namespace aisle::slam::dynamic {

/// A region of half-size pixels that moves.
struct PixelRegion {
  int id = 0;
  cv::Rect box;
  int pixels = 0;
  double log_odds = 0;  ///< mean over its pixels
};

struct PixelRegions {
  cv::Mat1i labels;                  ///< per pixel: index into regions + 1; 0 = static
  std::vector<PixelRegion> regions;  ///< the largest first
  int next_id = 0;                   ///< of the next one to be born; no id is given twice
};

/// Moving pixels that hang together by links that are not too weak, so that two people who meet
/// stay two, and that speak for motion in the mean. A region is born where enough of its pixels are
/// sure (by `log_odds`); it lives on, under its id, with fewer while it covers a good part of its
/// predecessor, and then the mean is of those that say something. Each id goes to the largest of
/// its heirs. `previous` has been carried to the current frame already.
PixelRegions FindRegions(const cv::Mat1b& moving, const cv::Mat1f& log_odds, const Links& links,
                         const PixelRegions& previous, const FieldOptions& field,
                         const RegionOptions& options);

}  // namespace aisle::slam::dynamic
