#include "harness/score/mask_images.h"

#include "harness/score/boundary.h"
#include "harness/score/masks.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

BoundaryRule RuleOf(const OutlineOptions& options, cv::Size size) {
  if (options.davis) return DavisRule(size);
  BoundaryRule rule;
  if (options.px) rule.tolerance_px = *options.px;
  if (options.share) rule.tolerance_px = *options.share * std::hypot(size.width, size.height);
  return rule;
}

/// DAVIS's F of one frame: two masks without an outline agree.
double FrameF(const MaskFacts& facts) {
  return BoundaryF({.truth = facts.outline_truth,
                    .truth_met = facts.outline_truth_met,
                    .rejected = facts.outline_rejected,
                    .rejected_met = facts.outline_rejected_met})
      .value_or(1);
}

}  // namespace

Scorecard ScoreMaskImages(std::size_t count, const std::function<MaskPair(std::size_t)>& at,
                          const OutlineOptions& outline) {
  RunResult run;
  double sum_f = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const MaskPair pair = at(i);
    const MaskFacts facts =
        CompareMaskBlobs(pair.truth, pair.mask, RuleOf(outline, pair.truth.size()));
    sum_f += FrameF(facts);
    run.facts.emplace_back().mask = facts;
  }
  Scorecard scores = ScoreMasks(run);
  if (outline.davis && count > 0) {
    scores["mask_boundary_f"] = Present(sum_f / static_cast<double>(count), "1", count);
  }
  scores.erase("static_features_lost");
  return scores;
}

}  // namespace aisle
