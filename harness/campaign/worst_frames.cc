#include "harness/campaign/worst_frames.h"

#include <algorithm>
#include <cmath>

#include "harness/common/seconds.h"

namespace aisle {

std::vector<WorstFrame> FindWorstFrames(const std::vector<FrameRow>& rows, std::size_t count,
                                        double apart_s) {
  std::vector<const FrameRow*> order;
  for (const FrameRow& row : rows) {
    if (row.live_error_m) order.push_back(&row);
  }
  std::ranges::stable_sort(order, [](const FrameRow* a, const FrameRow* b) {
    return *a->live_error_m > *b->live_error_m;
  });
  std::vector<const FrameRow*> chosen;
  for (const FrameRow* row : order) {
    const bool is_near = std::ranges::any_of(chosen, [&](const FrameRow* other) {
      return std::abs(ToSeconds(row->stamp_ns - other->stamp_ns)) < apart_s;
    });
    if (chosen.size() < count && !is_near) chosen.push_back(row);
  }
  std::vector<WorstFrame> worst;
  for (const FrameRow* row : chosen) worst.push_back({row->id, *row->live_error_m});
  return worst;
}

}  // namespace aisle
