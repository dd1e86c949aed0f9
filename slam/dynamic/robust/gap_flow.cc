#include "slam/dynamic/robust/gap_flow.h"

#include <optional>

#include "slam/common/parallel.h"
#include "slam/dynamic/robust/residual_flow.h"

namespace aisle::slam::dynamic {
namespace {

constexpr int kShortestKeyframeGap = 20;  // frames: longer than those of kGaps by a good part

/// Whether most of what is seen now was seen then, at a like scale: what a patch can be
/// followed over.
bool IsSeenAlike(const DenseFrame& now, const Eigen::Isometry3d& T_then_now,
                 const StereoCamera& half) {
  constexpr int kEvery = 16;
  constexpr float kLargestScale = 1.15F;
  int asked = 0, alike = 0;
  for (int y = kEvery / 2; y < now.filled.rows; y += kEvery) {
    for (int x = kEvery / 2; x < now.filled.cols; x += kEvery) {
      const float d = now.filled(y, x);
      if (d <= 0) continue;
      ++asked;
      const Eigen::Vector3d then =
          Project(half, T_then_now * Backproject(half, Eigen::Vector3d(x, y, d)));
      const auto was = static_cast<float>(then.z());
      const bool inside = then.x() >= 0 && then.y() >= 0 && then.x() < now.filled.cols &&
                          then.y() < now.filled.rows;
      alike += inside && was > d / kLargestScale && was < d * kLargestScale ? 1 : 0;
    }
  }
  return 4 * alike >= 3 * asked;
}

/// The gap of a slot, as far as the past reaches: of the keyframes the oldest that is seen alike.
std::optional<int> GapOf(std::size_t slot, const RobustState& before, const View& view,
                         const Eigen::Isometry3d& T_now_before, const StereoCamera& half) {
  if (slot != kKeyframeSlot) {
    if (before.frames.empty() || GapTo(before.frames.front(), before) < kGaps[slot]) return {};
    return kGaps[slot];
  }
  for (const DenseFrame& frame : before.frames) {
    const int gap = GapTo(frame, before);
    if (gap < kShortestKeyframeGap) break;
    const Eigen::Isometry3d T_now_then = MotionOver(gap, before, T_now_before);
    if (IsSeenAlike(view.frame, T_now_then.inverse(), half)) return gap;
  }
  return {};
}

struct Turn {
  std::size_t slot;
  int gap;
};

/// The gaps that have their turn: the shortest, and the next of the longer ones that the past
/// reaches back to.
std::vector<Turn> GapsInTurn(const RobustState& before, const View& view,
                             const Eigen::Isometry3d& T_now_before, const StereoCamera& half) {
  const auto gap_of = [&](std::size_t slot) {
    return GapOf(slot, before, view, T_now_before, half);
  };
  const auto shortest = gap_of(0);
  if (!shortest) return {};
  for (std::size_t k = 0; k + 1 < kSlots; ++k) {
    const std::size_t slot = (before.long_slot + k) % (kSlots - 1) + 1;
    if (const auto gap = gap_of(slot)) return {{0, *shortest}, {slot, *gap}};
  }
  return {{0, *shortest}};
}

}  // namespace

std::vector<GapFlow> FollowGaps(const RobustState& before, const View& view,
                                const Eigen::Isometry3d& T_now_before, const StereoCamera& half,
                                const DenseFlowOptions& options) {
  const std::vector<Turn> turns = GapsInTurn(before, view, T_now_before, half);
  std::vector<GapFlow> flows(turns.size());
  ParallelFor(std::size_t{0}, turns.size(), [&](std::size_t k) {
    const auto [slot, gap] = turns[k];
    const Eigen::Isometry3d T_now_then = MotionOver(gap, before, T_now_before);
    const StaticField expected = WhereStatic(view.frame.filled, T_now_then.inverse(), half);
    const cv::Mat2f flow = FollowBack(view.frame.image, view.pyramid, FrameAgo(before, gap).image,
                                      expected.place, options);
    flows[k] = {slot, gap, expected, flow};
  });
  return flows;
}

}  // namespace aisle::slam::dynamic
