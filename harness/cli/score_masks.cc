#include "harness/cli/score_masks.h"

#include <filesystem>

#include "harness/io/image.h"
#include "harness/io/input_error.h"
#include "harness/score/masks.h"
#include "harness/score/scorecard.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::map<std::string, fs::path> Images(const std::string& folder) {
  std::error_code error;
  std::map<std::string, fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".png") images[entry.path().filename().string()] = entry.path();
  }
  if (images.empty()) throw InputError(folder, 0, "holds no PNG images");
  return images;
}

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

Scorecard ScoreMaskFolders(const std::string& truth_folder, const std::string& mask_folder,
                           const OutlineOptions& outline) {
  const auto truths = Images(truth_folder), masks = Images(mask_folder);
  for (const auto& [name, path] : masks) {
    if (truths.count(name) == 0) {
      throw InputError(path.string(), 0, "belongs to no image of " + truth_folder);
    }
  }
  RunResult run;
  double sum_f = 0;
  for (const auto& [name, path] : truths) {
    FrameTruth truth;
    truth.dynamic = ReadMaskPng(path);
    DynamicRegions regions;
    const auto mask = masks.find(name);
    regions.mask =
        mask == masks.end() ? cv::Mat1b(truth.dynamic.size(), 0) : ReadMaskPng(mask->second);
    if (regions.mask.size() != truth.dynamic.size()) {
      throw InputError(mask->second.string(), 0, "has another size than its true mask");
    }
    // Without labels an object is a blob of moving pixels.
    const DynamicRegions true_blobs{.mask = truth.dynamic, .regions = {}};
    FrameFacts facts;
    facts.mask =
        CompareMaskImages(truth.dynamic, regions.mask, RuleOf(outline, truth.dynamic.size()));
    sum_f += FrameF(*facts.mask);
    const auto rejected = RejectedRegions(RejectedBoxes(regions, {}), truth.dynamic, regions.mask);
    const MaskFacts objects = MatchBoxes(RejectedBoxes(true_blobs, {}), rejected, {});
    facts.mask->objects_found = objects.objects_found;
    facts.mask->objects_missed = objects.objects_missed;
    facts.mask->objects_invented = objects.objects_invented;
    facts.mask->iou_sum = objects.iou_sum;
    run.facts.push_back(facts);
  }
  Scorecard scores = ScoreMasks(run);
  if (outline.davis) {
    scores["mask_boundary_f"] =
        Present(sum_f / static_cast<double>(run.facts.size()), "1", run.facts.size());
  }
  scores.erase("static_features_lost");  // needs the pictures, which nobody gave
  return scores;
}

}  // namespace aisle
