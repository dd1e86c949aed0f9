#include "slam/dynamic/robust/gap_flow.h"

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/residual_flow.h"

namespace aisle::slam::dynamic {
namespace {

/// The slots in kGaps that have their turn.
std::vector<std::size_t> SlotsInTurn(const RobustState& before) {
  const auto past = std::ssize(before.frames);
  if (past < kGaps[0]) return {};
  std::size_t longer = before.long_slot % (kGaps.size() - 1) + 1;
  if (past < kGaps[longer]) longer = 1;
  if (past < kGaps[longer]) return {0};
  return {0, longer};
}

}  // namespace

std::vector<GapFlow> FollowGaps(const RobustState& before, const View& view,
                                const Eigen::Isometry3d& T_now_before, const StereoCamera& half,
                                const DenseFlowOptions& options) {
  const std::vector<std::size_t> slots = SlotsInTurn(before);
  std::vector<GapFlow> flows(slots.size());
  ParallelFor(std::size_t{0}, slots.size(), [&](std::size_t k) {
    const int gap = kGaps[slots[k]];
    const Eigen::Isometry3d T_now_then = MotionOver(gap, before, T_now_before);
    const cv::Mat2f expected = WhereStatic(view.frame.filled, T_now_then.inverse(), half).place;
    flows[k] = {
        slots[k], gap, expected,
        FollowBack(view.frame.image, view.pyramid, FrameAgo(before, gap).image, expected, options)};
  });
  return flows;
}

}  // namespace aisle::slam::dynamic
