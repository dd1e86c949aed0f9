#include "slam/dynamic/robust/pixel_labels.h"

#include <opencv2/imgproc.hpp>

#include "slam/common/parallel.h"
#include "slam/dynamic/common/in_parallel.h"
#include "slam/dynamic/robust/join_regions.h"
#include "slam/dynamic/robust/label_field.h"

namespace aisle::slam::dynamic {
namespace {

/// What leans to static, added.
cv::Mat1f Leaning(const cv::Mat1f& log_odds, const cv::Mat1f& disparity, const cv::Mat1b& floor,
                  const FieldOptions& options) {
  cv::Mat1f leaning;
  cv::add(log_odds, options.bias, leaning);
  const auto unlikely = static_cast<float>(options.unlikely_bias);
  ParallelFor(0, leaning.rows, [&](int y) {
    const float* known = disparity[y];
    float* lean = leaning[y];
    for (int x = 0; x < leaning.cols; ++x) lean[x] += known[x] <= 0 ? unlikely : 0.0F;
    for (int x = 0; x < leaning.cols; ++x) {
      if (floor(y, x) != 0) lean[x] = std::min(lean[x], 0.0F) + unlikely;
    }
  });
  return leaning;
}

/// Each pixel of half size is 2x2 of the image's; a last column or row that is odd is as the one
/// beside it.
cv::Mat AtFullSize(const cv::Mat& half, cv::Size image) {
  const cv::Size even = half.size() * 2;
  cv::Mat full;
  cv::resize(half, full, even, 0, 0, cv::INTER_LINEAR);
  if (even == image) return full;
  cv::copyMakeBorder(full, full, 0, image.height - even.height, 0, image.width - even.width,
                     cv::BORDER_REPLICATE);
  return full;
}

/// The same of a box in an image of half size.
cv::Rect BoxAtFullSize(const cv::Rect& box, cv::Size half, cv::Size image) {
  const cv::Point end(box.br().x == half.width ? image.width : box.br().x * 2,
                      box.br().y == half.height ? image.height : box.br().y * 2);
  return {box.tl() * 2, end};
}

cv::Mat1b PixelMask(const PixelRegions& regions, cv::Size image) {
  cv::Mat1b half;
  cv::compare(regions.labels, 0, half, cv::CMP_GT);
  cv::Mat1b mask = AtFullSize(half, image);
  cv::threshold(mask, mask, 127, 255, cv::THRESH_BINARY);
  return mask;
}

cv::Mat1f PixelProbability(const cv::Mat1f& log_odds, cv::Size image) {
  cv::Mat1f odds;
  cv::exp(-log_odds, odds);
  odds = 1 / (1 + odds);
  return AtFullSize(odds, image);
}

DynamicRegions ToFullSize(const PixelRegions& regions, const cv::Mat1f& disparity,
                          const DisparityTolerance& tolerance, cv::Size image,
                          const RegionOptions& options) {
  DynamicRegions dynamic;
  dynamic.mask = PixelMask(regions, image);
  for (const PixelRegion& region : JoinRegions(regions, disparity, tolerance, options)) {
    const cv::Rect box = BoxAtFullSize(region.box, disparity.size(), image);
    dynamic.regions.push_back({region.id, box, region.log_odds});
  }
  return dynamic;
}

}  // namespace

PixelLabels LabelPixels(const Step& step, const Layout& layout, const cv::Mat1f& log_odds,
                        const PixelRegions& previous) {
  const cv::Mat1f& disparity = step.view.frame.disparity;
  const RobustOptions& options = step.options;
  const cv::Mat1f leaning = Leaning(log_odds, disparity, layout.floor_mask, options.field);
  const cv::Mat1f field = SolveField(leaning, layout.links);
  auto [regions, probability] = InParallel(
      [&] {
        const cv::Mat1b moving = GrowMoving(field, leaning, layout.links, layout.floor_mask,
                                            layout.farthest, options.field);
        return FindRegions(moving, log_odds, layout.links, previous, options.field, options.region);
      },
      [&] { return PixelProbability(field, step.image); });
  DynamicRegions dynamic =
      ToFullSize(regions, disparity, step.tolerance, step.image, options.region);
  return {field, std::move(regions), std::move(dynamic), std::move(probability)};
}

}  // namespace aisle::slam::dynamic
