#include "slam/picture/draw_regions.h"

#include <opencv2/imgproc.hpp>

#include "slam/picture/canvas.h"

namespace aisle::slam::picture {
namespace {

constexpr double kSameObject = 0.5;  // overlap from which two rectangles are one object

std::vector<cv::Rect> BoxesOf(const DynamicRegions& regions) {
  std::vector<cv::Rect> boxes;
  for (const DynamicRegion& region : regions.regions) boxes.push_back(region.box);
  return boxes;
}

/// Pixels of both masks, of the first alone, of the second alone.
struct Agreement {
  cv::Mat1b both, rejected_only, moving_only;
};

Agreement Compare(const cv::Mat1b& rejected, const cv::Mat1b& moving, cv::Size size) {
  const cv::Mat1b none(size, static_cast<unsigned char>(0));
  const cv::Mat1b r = rejected.empty() ? none : rejected, m = moving.empty() ? none : moving;
  Agreement agreement;
  cv::bitwise_and(r, m, agreement.both);
  cv::subtract(r, m, agreement.rejected_only);
  cv::subtract(m, r, agreement.moving_only);
  return agreement;
}

void DrawTruthBoxes(const DynamicRegions& regions, const StageTruth& truth, cv::Mat3b& picture) {
  for (const cv::Rect& box : truth.boxes) {
    const bool found = BestOverlap(box, BoxesOf(regions)) >= kSameObject;
    cv::rectangle(picture, box, ToScalar(kTruth), found ? 1 : 2, cv::LINE_8);
    if (!found) Plate("missed", box.br() - cv::Point(box.width, 0), kTruth, picture);
  }
}

void DrawFoundBoxes(const DynamicRegions& regions, const StageTruth& truth, cv::Mat3b& picture) {
  for (const DynamicRegion& region : regions.regions) {
    cv::rectangle(picture, region.box, ToScalar(kFound), 1, cv::LINE_8);
    std::string text = fmt::format("#{}", region.id);
    if (!truth.moving.empty()) {
      text += fmt::format("  IoU {:.2f}", BestOverlap(region.box, truth.boxes));
    }
    Plate(text, region.box.tl(), kFound, picture);
  }
}

std::string Caption(const Agreement& pixels, const DynamicRegions& regions,
                    const StageTruth& truth) {
  if (truth.moving.empty())
    return fmt::format("regions: {}; truth unknown", regions.regions.size());
  const double both = cv::countNonZero(pixels.both), wrong = cv::countNonZero(pixels.rejected_only),
               missed = cv::countNonZero(pixels.moving_only);
  const auto found = std::count_if(truth.boxes.begin(), truth.boxes.end(), [&](const auto& box) {
    return BestOverlap(box, BoxesOf(regions)) >= kSameObject;
  });
  const std::string overlap =
      both + wrong + missed > 0 ? fmt::format("{:.2f}", both / (both + wrong + missed)) : "-";
  return fmt::format(
      "objects found: {} of {}; regions: {}; pixel IoU {}; {:.1f} % of the static "
      "pixels rejected",
      found, truth.boxes.size(), regions.regions.size(), overlap,
      100 * wrong / std::max(static_cast<double>(truth.moving.total()) - both - missed, 1.0));
}

}  // namespace

double BestOverlap(const cv::Rect& box, const std::vector<cv::Rect>& others) {
  double best = 0;
  for (const cv::Rect& other : others) {
    const double shared = (box & other).area();
    const double whole = box.area() + other.area() - shared;
    if (whole > 0) best = std::max(best, shared / whole);
  }
  return best;
}

StagePicture DrawRegions(const DynamicStages& stages, const StageTruth& truth, int number) {
  constexpr double kStrength = 0.45;
  const Agreement pixels = Compare(stages.regions.mask, truth.moving, stages.left.size());
  cv::Mat3b picture = OnGrey(stages.left);
  Tint(pixels.both, kStatic, kStrength, picture);
  Tint(pixels.rejected_only, kFound, kStrength, picture);
  Tint(pixels.moving_only, kTruth, kStrength, picture);
  DrawTruthBoxes(stages.regions, truth, picture);
  DrawFoundBoxes(stages.regions, truth, picture);
  return {"regions", Framed(picture, fmt::format("{}  Rejected against truth", number),
                            {{kStatic, "rejected and moves"},
                             {kFound, "rejected, stands still (box: region)"},
                             {kTruth, "moves, not rejected (box: truth)"}},
                            Caption(pixels, stages.regions, truth))};
}

}  // namespace aisle::slam::picture
