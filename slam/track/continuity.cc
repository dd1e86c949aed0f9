#include "slam/track/continuity.h"

#include <algorithm>
#include <limits>

namespace aisle::slam {
namespace {

constexpr int kLeastAlike = 20;
constexpr int kAlike = 50;      // bits
constexpr double kRatio = 0.8;  // best to second best

bool HasLikeness(const Descriptor& descriptor, const Frame& frame) {
  int best = std::numeric_limits<int>::max(), second = best;
  for (const Descriptor& other : frame.features.descriptors) {
    const int bits = HammingDistance(descriptor, other);
    if (bits < best) {
      second = best;
      best = bits;
    } else if (bits < second) {
      second = bits;
    }
  }
  return best <= kAlike && best <= kRatio * second;
}

}  // namespace

bool ShowsSomething(const Frame& frame) { return frame.size() >= 60; }

bool IsCut(const Frame& before, const Frame& now, int budget) {
  if (2 * std::min(before.size(), now.size()) < budget) return false;
  int alike = 0;
  for (const Descriptor& descriptor : now.features.descriptors) {
    alike += HasLikeness(descriptor, before);
    if (alike >= kLeastAlike) return false;
  }
  return true;
}

}  // namespace aisle::slam
