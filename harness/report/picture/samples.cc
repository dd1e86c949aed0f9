#include "harness/report/picture/samples.h"

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
                         const FrameFacts& facts) {
  const std::size_t step =
      std::max<std::size_t>(count / std::max<std::size_t>(evenly_spaced_, 1), 1);
  std::map<std::string, double> marks{{"most_movers", facts.movers_share}};
  if (facts.mask) {
    marks["worst_mask"] =
        static_cast<double>(facts.mask->false_positives + facts.mask->false_negatives);
  }
  if (estimate.T_world_rig && previous_ && truth != nullptr) {
    const Eigen::Isometry3d true_step = previous_->first.inverse() * truth->T_world_rig;
    const Eigen::Isometry3d our_step = previous_->second.inverse() * *estimate.T_world_rig;
    marks["worst_step"] = (true_step.inverse() * our_step).translation().norm();
  }
  previous_.reset();
  if (estimate.T_world_rig && truth != nullptr) {
    previous_ = {truth->T_world_rig, *estimate.T_world_rig};
  }
  const bool is_even = index % step == step / 2;
  const bool leads = std::any_of(marks.begin(), marks.end(), [&](const auto& mark) {
    return mark.second > leaders_[mark.first].value;
  });
  if (!is_even && !leads) return;
  const Sample sample{
      index, DrawOverlay(left, truth, &estimate, Caption(index, estimate, facts.movers_share))};
  if (is_even) samples_.push_back(sample);
  for (const auto& [name, value] : marks) {
    if (value > leaders_[name].value) leaders_[name] = {sample, value};
  }
}

std::vector<std::string> SamplePictures::Write(const std::filesystem::path& folder) const {
  std::map<std::size_t, std::pair<std::string, const Sample*>> by_index;
  for (const Sample& sample : samples_) {
    by_index[sample.index] = {fmt::format("frame_{:06}", sample.index), &sample};
  }
  for (const auto& [name, leader] : leaders_) {
    if (!leader.sample) continue;
    auto& [file, sample] = by_index[leader.sample->index];
    if (sample == nullptr) file = fmt::format("frame_{:06}", leader.sample->index);
    file += "_" + name;
    sample = &*leader.sample;
  }
  std::vector<std::string> names;
  for (const auto& [index, named] : by_index) {
    names.push_back(named.first + ".jpg");
    WriteImage(folder / names.back(), named.second->picture);
  }
  return names;
}

}  // namespace aisle
