#include "harness/report/samples.h"

#include "harness/io/image.h"

namespace aisle {
namespace {

std::string Caption(std::size_t index, const FrameEstimate& estimate, double movers_share) {
  const auto inliers = estimate.counts.find("inliers");
  return fmt::format(
      "frame {}  {:.2f} s   movers {:.1f} %   {} features{}{}", index,
      static_cast<double>(estimate.stamp_ns) * 1e-9, 100 * movers_share, estimate.keypoints.size(),
      inliers == estimate.counts.end() ? "" : fmt::format(", {} used", inliers->second),
      estimate.T_world_rig ? "" : "   NO POSE");
}

}  // namespace

void SamplePictures::See(std::size_t index, std::size_t count, const cv::Mat1b& left,
                         const FrameTruth* truth, const FrameEstimate& estimate,
                         double movers_share) {
  const std::size_t step =
      std::max<std::size_t>(count / std::max<std::size_t>(evenly_spaced_, 1), 1);
  const bool is_even = index % step == step / 2;
  const bool is_most = movers_share > most_share_;
  if (!is_even && !is_most) return;
  const Sample sample{index,
                      DrawOverlay(left, truth, &estimate, Caption(index, estimate, movers_share))};
  if (is_even) samples_.push_back(sample);
  if (is_most) {
    most_movers_ = sample;
    most_share_ = movers_share;
  }
}

std::vector<std::string> SamplePictures::Write(const std::filesystem::path& folder) const {
  std::map<std::size_t, std::pair<std::string, const Sample*>> by_index;
  for (const Sample& sample : samples_) {
    by_index[sample.index] = {fmt::format("frame_{:06}.jpg", sample.index), &sample};
  }
  if (most_movers_) {
    by_index[most_movers_->index] = {
        fmt::format("frame_{:06}_most_movers.jpg", most_movers_->index), &*most_movers_};
  }
  std::vector<std::string> names;
  for (const auto& [index, named] : by_index) {
    WriteImage(folder / named.first, named.second->picture);
    names.push_back(named.first);
  }
  return names;
}

}  // namespace aisle
