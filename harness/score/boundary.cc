#include "harness/score/boundary.h"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace aisle {
namespace {

cv::Mat1b Outline(const cv::Mat1b& mask) {
  cv::Mat1b inner, outline;
  cv::erode(mask, inner, cv::getStructuringElement(cv::MORPH_CROSS, {3, 3}));
  cv::subtract(mask, inner, outline);
  return outline;
}

/// Sets pixels that differ from their neighbour one step away; `step` points right or down.
void MarkSteps(const cv::Mat1b& mask, cv::Point step, cv::Mat1b* outline) {
  const cv::Size size(mask.cols - step.x, mask.rows - step.y);
  if (size.empty()) return;
  cv::Mat1b differs;
  cv::bitwise_xor(mask(cv::Rect({}, size)), mask(cv::Rect(step, size)), differs);
  cv::Mat1b of_these = (*outline)(cv::Rect({}, size));
  cv::bitwise_or(of_these, differs, of_these);
}

cv::Mat1b OutlineAsDavis(const cv::Mat1b& mask) {
  cv::Mat1b outline(mask.size(), 0);
  for (const cv::Point step : {cv::Point(1, 0), cv::Point(0, 1), cv::Point(1, 1)}) {
    MarkSteps(mask, step, &outline);
  }
  return outline;
}

/// Outline pixels of `of` that lie within the tolerance of `near`.
std::int64_t Met(const cv::Mat1b& of, const cv::Mat1b& near, double tolerance_px) {
  if (cv::countNonZero(near) == 0) return 0;
  cv::Mat1b away;
  cv::bitwise_not(near, away);
  cv::Mat1f distance;
  cv::distanceTransform(away, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  cv::Mat close, met;
  cv::compare(distance, tolerance_px, close, cv::CMP_LE);
  cv::bitwise_and(of, close, met);
  return cv::countNonZero(met);
}

}  // namespace

BoundaryCounts& BoundaryCounts::operator+=(const BoundaryCounts& other) {
  truth += other.truth;
  truth_met += other.truth_met;
  rejected += other.rejected;
  rejected_met += other.rejected_met;
  return *this;
}

BoundaryRule DavisRule(cv::Size size) {
  return {.tolerance_px = std::ceil(0.008 * std::hypot(size.width, size.height)),
          .davis_outline = true};
}

BoundaryCounts CompareBoundaries(const cv::Mat1b& truth, const cv::Mat1b& rejected,
                                 const BoundaryRule& rule) {
  if (truth.size() != rejected.size()) throw std::invalid_argument("masks differ in size");
  // Outlines and all that is near them lie within a margin of the masks: the rest need not be seen.
  cv::Mat1b either;
  cv::bitwise_or(truth, rejected, either);
  const cv::Rect set = cv::boundingRect(either);
  if (set.empty()) return {};
  const int margin = static_cast<int>(std::ceil(rule.tolerance_px)) + 2;
  const cv::Rect seen =
      cv::Rect(set.x - margin, set.y - margin, set.width + 2 * margin, set.height + 2 * margin) &
      cv::Rect({}, truth.size());
  const auto outline = rule.davis_outline ? OutlineAsDavis : Outline;
  const cv::Mat1b truth_outline = outline(truth(seen)), rejected_outline = outline(rejected(seen));
  return {.truth = cv::countNonZero(truth_outline),
          .truth_met = Met(truth_outline, rejected_outline, rule.tolerance_px),
          .rejected = cv::countNonZero(rejected_outline),
          .rejected_met = Met(rejected_outline, truth_outline, rule.tolerance_px)};
}

std::optional<double> BoundaryF(const BoundaryCounts& counts) {
  if (counts.truth + counts.rejected == 0) return std::nullopt;
  if (counts.truth == 0 || counts.rejected == 0) return 0.0;
  const double recall = static_cast<double>(counts.truth_met) / static_cast<double>(counts.truth);
  const double precision =
      static_cast<double>(counts.rejected_met) / static_cast<double>(counts.rejected);
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0.0;
}

}  // namespace aisle
