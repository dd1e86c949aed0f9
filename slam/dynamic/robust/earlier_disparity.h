#pragma once

#include <algorithm>

namespace aisle::slam::dynamic {

/// The disparities that the surface of a pixel may have had in an earlier frame, whatever it does:
/// the rig's motion has changed that of a static one; what goes along with the rig has kept its
/// own; what comes towards it as fast has changed by twice as much. Half-size pixels.
class EarlierDisparity {
 public:
  /// Its disparity `now`, and `if_static` then (StaticField; <= 0: behind the camera).
  EarlierDisparity(float now, float if_static) : low_(now), high_(now) {
    if (if_static <= 0) return;
    const float towards = 2 * if_static - now;
    low_ = std::max(std::min(now, towards), 0.0F);
    high_ = std::max(now, towards);
  }

  /// How far one that was seen is from all of them; 0 for each of them.
  float DistanceTo(float seen) const { return std::max({low_ - seen, seen - high_, 0.0F}); }

 private:
  float low_, high_;
};

}  // namespace aisle::slam::dynamic
