#include "harness/report/picture/frame_album.h"

#include <opencv2/imgcodecs.hpp>
#include <set>

#include "harness/common/seconds.h"
#include "harness/contract/map_id.h"
#include "harness/io/file.h"
#include "harness/io/input_error.h"

namespace aisle {
namespace {

constexpr std::size_t kEvery = 2;         ///< frames: what one shows the next one shows too
constexpr std::size_t kMostHeld = 2000;   ///< some 80 MB
constexpr std::size_t kEvenlySpaced = 8;  ///< of the worst two dozen
constexpr std::size_t kAroundWorst = 5;   ///< pictures before and after a worst frame
constexpr int kQuality = 85;

std::string Caption(std::size_t index, const FrameEstimate& estimate, double movers_share) {
  const auto inliers = estimate.counts.find("inliers");
  const std::string features =
      estimate.keypoints.empty() ? "" : fmt::format("   {} features", estimate.keypoints.size());
  return fmt::format(
      "frame {}  {:.2f} s   movers {:.1f} %{}{}{}", index, ToSeconds(estimate.stamp_ns),
      100 * movers_share, features,
      inliers == estimate.counts.end() ? "" : fmt::format(", {} used", inliers->second),
      estimate.T_world_rig ? "" : "   NO POSE");
}

std::string ToJpeg(const cv::Mat3b& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", picture, bytes, {cv::IMWRITE_JPEG_QUALITY, kQuality});
  return {bytes.begin(), bytes.end()};
}

}  // namespace

std::string Name(FramesKept kept) {
  return kept == FramesKept::kNone ? "none" : kept == FramesKept::kAll ? "all" : "worst";
}

FramesKept FramesKeptFromName(const std::string& name) {
  for (const FramesKept kept : {FramesKept::kNone, FramesKept::kWorst, FramesKept::kAll}) {
    if (Name(kept) == name) return kept;
  }
  throw InputError(
      fmt::format("frames in the report: '{}' is none of worst, all and none", Printable(name)));
}

cv::Mat3b FrameAlbum::See(std::size_t index, std::size_t count, const cv::Mat1b& left,
                          const FrameTruth* truth, const FrameEstimate& estimate,
                          const FrameFacts& facts) {
  double step_error_m = 0;
  if (estimate.T_world_rig && previous_ && truth != nullptr &&
      previous_->map_id == MapIdOf(estimate)) {
    const Eigen::Isometry3d true_step = previous_->T_truth_rig.inverse() * truth->T_world_rig;
    const Eigen::Isometry3d our_step = previous_->T_world_rig.inverse() * *estimate.T_world_rig;
    step_error_m = (true_step.inverse() * our_step).translation().norm();
  }
  previous_.reset();
  if (estimate.T_world_rig && truth != nullptr) {
    previous_ = {truth->T_world_rig, *estimate.T_world_rig, MapIdOf(estimate)};
  }
  const std::size_t every = std::max(kEvery, (count + kMostHeld - 1) / kMostHeld);
  if (kept_ == FramesKept::kNone || index % every != 0) return {};
  const cv::Mat3b picture =
      DrawOverlay(left, truth, &estimate, Caption(index, estimate, facts.movers_share));
  Picture& held = pictures_[index];
  held.jpeg = ToJpeg(picture);
  held.movers_share = facts.movers_share;
  held.step_error_m = step_error_m;
  if (facts.mask) {
    held.mask_wrong_px =
        static_cast<double>(facts.mask->false_positives + facts.mask->false_negatives);
  }
  return picture;
}

std::map<std::string, std::size_t> FrameAlbum::Leaders(
    const std::map<std::size_t, double>& error_m) const {
  std::map<std::string, std::size_t> leaders;
  std::map<std::string, double> best;
  for (const auto& [index, picture] : pictures_) {
    const auto error = error_m.find(index);
    for (const auto& [name, value] :
         {std::pair("most_movers", picture.movers_share),
          std::pair("worst_mask", picture.mask_wrong_px),
          std::pair("worst_step", picture.step_error_m),
          std::pair("worst_error", error == error_m.end() ? 0 : error->second)}) {
      if (value <= best[name]) continue;
      best[name] = value;
      leaders[name] = index;
    }
  }
  return leaders;
}

std::vector<std::string> FrameAlbum::Write(const std::filesystem::path& folder,
                                           const std::map<std::size_t, double>& error_m) const {
  const std::map<std::string, std::size_t> leaders = Leaders(error_m);
  std::vector<std::size_t> drawn;
  for (const auto& [index, picture] : pictures_) drawn.push_back(index);
  std::set<std::size_t> chosen;
  if (kept_ == FramesKept::kAll || drawn.size() <= kEvenlySpaced) {
    chosen.insert(drawn.begin(), drawn.end());
  }
  for (std::size_t k = 0; k < kEvenlySpaced && chosen.size() < drawn.size(); ++k) {
    chosen.insert(drawn[(2 * k + 1) * drawn.size() / (2 * kEvenlySpaced)]);
  }
  for (const auto& [name, index] : leaders) {
    chosen.insert(index);
    if (name != "worst_error" && name != "worst_step") continue;
    const auto at = static_cast<std::size_t>(std::lower_bound(drawn.begin(), drawn.end(), index) -
                                             drawn.begin());
    const std::size_t around = name == "worst_step" ? kAroundWorst : kAroundWorst / 2;
    const std::size_t first = at - std::min(at, around);
    const std::size_t last = std::min(at + around, drawn.size() - 1);
    chosen.insert(drawn.begin() + static_cast<std::ptrdiff_t>(first),
                  drawn.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  }
  std::vector<std::string> names;
  for (const std::size_t index : chosen) {
    std::string name = fmt::format("frame_{:06}", index);
    for (const auto& [lead, of] : leaders) name += of == index ? "_" + lead : "";
    names.push_back(name + ".jpg");
    WriteFileAtomically(folder / names.back(), pictures_.at(index).jpeg,
                        Durability::kSurvivesProcessLoss);
  }
  return names;
}

}  // namespace aisle
