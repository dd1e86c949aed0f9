#include "slam/dynamic/robust/robust_state.h"

#include <algorithm>

namespace aisle::slam::dynamic {

const DenseFrame& FrameAgo(const RobustState& before, int gap) {
  const int number = before.frames.back().number + 1 - gap;
  const auto found =
      std::lower_bound(before.frames.begin(), before.frames.end(), number,
                       [](const DenseFrame& frame, int wanted) { return frame.number < wanted; });
  CV_Assert(found != before.frames.end() && found->number == number);
  return *found;
}

std::vector<DenseFrame> WithFrame(std::vector<DenseFrame> frames, DenseFrame now) {
  now.number = frames.empty() ? 0 : frames.back().number + 1;
  std::erase_if(frames, [&](const DenseFrame& frame) {
    const int gap = now.number + 1 - frame.number;  // as the next frame will see it
    return gap > kLongestGap || (gap > kGaps.back() && frame.number % kKeyframeEvery != 0);
  });
  frames.push_back(std::move(now));
  return frames;
}

}  // namespace aisle::slam::dynamic
