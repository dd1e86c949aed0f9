#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/contract/estimate.h"
#include "harness/contract/frame.h"
#include "harness/io/features_csv.h"

namespace aisle {

/// Files that a foreign system may leave beside its trajectory; neither is asked for.
inline constexpr const char* kSystemLogName = "system.log";   ///< what it printed
inline constexpr const char* kFeaturesName = "features.csv";  ///< as ReadFeatures has it
inline constexpr const char* kMasksFolder = "masks";          ///< what it rejects: not black

/// Takes both from the folder where the system could write into the run's own, without following
/// what leads elsewhere. Masks are PNGs named by the frame's number in six digits or by the stamp
/// that the dataset tells (`stamp_names`, by frame); they are kept under the number. Returns what
/// could not be taken, a sentence each.
std::vector<std::string> TakeLeftovers(const std::filesystem::path& from,
                                       const std::vector<std::string>& stamp_names,
                                       const std::filesystem::path& to);

/// What was taken, frame by frame.
class Leftovers {
 public:
  /// Throws InputError where features.csv is none.
  explicit Leftovers(std::filesystem::path folder);
  bool any() const { return has_masks_ || !features_.empty(); }
  /// Keypoints and mask of the frame; empty where none were left. Throws InputError for a mask
  /// that is no image.
  FrameEstimate operator()(const StereoFrame& frame) const;

 private:
  std::filesystem::path folder_;
  bool has_masks_ = false;
  std::map<std::int64_t, FrameFeatures> features_;
};

}  // namespace aisle
