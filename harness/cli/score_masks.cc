#include "harness/cli/score_masks.h"

#include <filesystem>

#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

std::map<std::string, fs::path> Images(const std::string& folder) {
  std::error_code error;
  std::map<std::string, fs::path> images;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".png") images[entry.path().filename().string()] = entry.path();
  }
  if (images.empty()) throw InputError(folder, 0, "no PNG images in this folder");
  return images;
}

}  // namespace

Scorecard ScoreMaskFolders(const std::string& truth_folder, const std::string& mask_folder,
                           const OutlineOptions& outline) {
  const auto truths = Images(truth_folder), masks = Images(mask_folder);
  for (const auto& [name, path] : masks) {
    if (truths.count(name) == 0) {
      throw InputError(path.string(), 0, "has no counterpart in " + truth_folder);
    }
  }
  if (masks.size() < truths.size()) {
    fmt::print(stderr, "aisle: {} of {} true masks have no counterpart in {}: counted as empty\n",
               truths.size() - masks.size(), truths.size(), Printable(mask_folder, 4096));
  }
  const std::vector<std::pair<std::string, fs::path>> frames(truths.begin(), truths.end());
  const auto pair_at = [&](std::size_t i) -> MaskPair {
    const auto& [name, path] = frames[i];
    const cv::Mat1b truth = ReadMaskPng(path);
    const auto found = masks.find(name);
    if (found == masks.end()) return {truth, cv::Mat1b(truth.size(), 0)};
    const cv::Mat1b mask = ReadMaskPng(found->second);
    if (mask.size() != truth.size()) {
      throw InputError(found->second.string(), 0, "its size differs from that of its true mask");
    }
    return {truth, mask};
  };
  return ScoreMaskImages(frames.size(), pair_at, outline);
}

}  // namespace aisle
