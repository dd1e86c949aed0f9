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
  if (masks.size() < truths.size()) {
    fmt::print(stderr, "aisle: {} of {} true masks have no mask in {}: counted as empty\n",
               truths.size() - masks.size(), truths.size(), Printable(mask_folder, 4096));
  }
  RunResult run;
  double sum_f = 0;
  for (const auto& [name, path] : truths) {
    const cv::Mat1b truth = ReadMaskPng(path);
    const auto found = masks.find(name);
    const cv::Mat1b mask =
        found == masks.end() ? cv::Mat1b(truth.size(), 0) : ReadMaskPng(found->second);
    if (mask.size() != truth.size()) {
      throw InputError(found->second.string(), 0, "has another size than its true mask");
    }
    FrameFacts facts;
    facts.mask = CompareMaskBlobs(truth, mask, RuleOf(outline, truth.size()));
    sum_f += FrameF(*facts.mask);
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
