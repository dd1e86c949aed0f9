#include "harness/campaign/guest_output.h"

#include "harness/io/file.h"
#include "harness/io/image.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestFeatures = std::size_t{256} << 20;
constexpr std::size_t kLargestMask = std::size_t{4} << 20;
constexpr std::size_t kAllMasks = std::size_t{1} << 30;

std::string MaskName(std::size_t frame) { return fmt::format("{:06}.png", frame); }

bool IsThere(const fs::path& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() != fs::file_type::not_found && !error;
}

void TakeFeatures(const fs::path& from, const fs::path& to) {
  if (!IsThere(from / kFeaturesName)) return;
  WriteFileAtomically(to / kFeaturesName, ReadLeftFile(from, kFeaturesName, kLargestFeatures),
                      Durability::kSurvivesProcessLoss);
}

void TakeMasks(const fs::path& from, const std::vector<std::string>& stamp_names,
               const fs::path& to) {
  if (!IsThere(from / kMasksFolder)) return;
  std::size_t taken_bytes = 0;
  for (std::size_t frame = 0; frame < stamp_names.size(); ++frame) {
    for (const std::string& name : {MaskName(frame), stamp_names[frame] + ".png"}) {
      const std::string below = std::string(kMasksFolder) + "/" + name;
      if (!IsThere(from / below)) continue;
      const std::string bytes = ReadLeftFile(from, below, kLargestMask);
      taken_bytes += bytes.size();
      if (taken_bytes > kAllMasks) throw InputError("masks: more than 1 GiB");
      WriteFileAtomically(to / kMasksFolder / MaskName(frame), bytes,
                          Durability::kSurvivesProcessLoss);
      break;
    }
  }
}

}  // namespace

std::vector<std::string> TakeLeftovers(const fs::path& from,
                                       const std::vector<std::string>& stamp_names,
                                       const fs::path& to) {
  std::vector<std::string> troubles;
  const auto attempt = [&](const auto& take) {
    try {
      take();
    } catch (const InputError& wrong) {
      troubles.push_back(fmt::format("not used: {}", wrong.what()));
    }
  };
  attempt([&] { TakeFeatures(from, to); });
  attempt([&] { TakeMasks(from, stamp_names, to); });
  return troubles;
}

Leftovers::Leftovers(fs::path folder)
    : folder_(std::move(folder)), has_masks_(fs::exists(folder_ / kMasksFolder)) {
  if (fs::exists(folder_ / kFeaturesName)) features_ = ReadFeatures(folder_ / kFeaturesName);
}

FrameEstimate Leftovers::operator()(const StereoFrame& frame) const {
  FrameEstimate estimate;
  if (const auto found = features_.find(frame.id); found != features_.end()) {
    estimate.keypoints = found->second.points;
    estimate.keypoint_is_inlier = found->second.used;
    estimate.counts["features"] = static_cast<int>(found->second.points.size());
    estimate.counts["inliers"] =
        static_cast<int>(std::count(found->second.used.begin(), found->second.used.end(), true));
  }
  const fs::path mask = folder_ / kMasksFolder / MaskName(static_cast<std::size_t>(frame.id));
  if (has_masks_ && fs::exists(mask)) estimate.regions.mask = ReadMaskPng(mask);
  return estimate;
}

}  // namespace aisle
