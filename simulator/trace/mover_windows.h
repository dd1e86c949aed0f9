#pragma once

#include <vector>

#include "simulator/camera/pixel_rays.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

struct CameraView;

/// Where in an image each mover may show: the pixels around its box. Rays elsewhere need not ask
/// for it. Without any, nothing moves.
class MoverWindows {
 public:
  MoverWindows() = default;
  MoverWindows(const Instant& instant, const CameraView& view);

  /// The static world, and the movers that rays through the pixels [x0, x1) × [y0, y1) may meet:
  /// rays anywhere in these pixels, not through their centres alone.
  GeometryMask In(int x0, int y0, int x1, int y1) const {
    GeometryMask mask = kStaticOnly;
    for (std::size_t i = 0; i < windows_.size(); ++i) {
      const PixelWindow& window = windows_[i];
      if (x0 < window.x1 && x1 > window.x0 && y0 < window.y1 && y1 > window.y0) mask |= MoverBit(i);
    }
    return mask;
  }

 private:
  std::vector<PixelWindow> windows_;  ///< by mover; empty where it does not show
};

}  // namespace aisle::sim
