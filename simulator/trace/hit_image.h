#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "simulator/camera/pixel_rays.h"
#include "simulator/trace/mover_windows.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

/// The first hits of an image, one array a quantity, row-major with rows of `stride` entries; the
/// entries beyond `width` hold no hit. `t` is the depth z in metres, infinity where nothing was
/// hit. Shared by truth and shading.
struct HitImage {
  int width = 0, height = 0;
  int stride = 0;  ///< width rounded up to a whole packet
  std::vector<float> t;
  std::vector<std::uint32_t> geometry, primitive;
  std::vector<float> u, v;
  MoverWindows movers;  ///< what further rays of the same view may meet

  void Resize(int new_width, int new_height);
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(stride) +
           static_cast<std::size_t>(x);
  }
};

/// One camera of one frame: its pixels' rays, and where it stands. Directions in the world are
/// rotation · (x, y, 1).
struct CameraView {
  CameraView(const PixelRays& pixel_rays, const Eigen::Isometry3d& T_world_camera);

  const PixelRays* rays;
  Eigen::Isometry3d T_world_camera;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f origin;
};

/// Changes no result; tests and benches use it.
struct TraceOrder {
  /// 0: tiles in reading order; else a seed that shuffles them.
  std::uint64_t shuffle = 0;
  /// Whether packets of eight rays are traced one by one instead of side by side.
  bool single_packets = false;
};

/// Traces the pixel centres of several views of one instant, in parallel over tiles. `images` has
/// one entry per view and is reused from frame to frame, because its pages are expensive to touch
/// for the first time.
void TraceViews(const Instant& instant, std::span<const CameraView> views, const TraceOrder& order,
                std::vector<HitImage>* images);

/// The rays of the eight pixels (x + 0…3, y + 0…1).
Rays8 PixelPacket(const CameraView& view, int x, int y);

}  // namespace aisle::sim
