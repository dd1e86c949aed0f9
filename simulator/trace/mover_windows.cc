#include "simulator/trace/mover_windows.h"

#include <algorithm>
#include <array>
#include <span>

#include "simulator/common/parallel.h"
#include "simulator/trace/hit_image.h"

namespace aisle::sim {
namespace {

/// x / z and y / z of what of a box lies before the camera, which may be nothing.
Eigen::AlignedBox2f Project(const Eigen::AlignedBox3f& box,
                            const Eigen::Isometry3f& T_camera_world) {
  constexpr float kNear = 1e-3f;  // m
  std::array<Eigen::Vector3f, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = T_camera_world * box.corner(static_cast<Eigen::AlignedBox3f::CornerType>(i));
  }
  Eigen::AlignedBox2f seen;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3f& a = corners[i];
    if (a.z() >= kNear) seen.extend(a.hnormalized());
    // Bits of a corner's number are its sides. Edges that pass the plane close to the camera end
    // there.
    for (std::size_t side = 1; side < corners.size(); side *= 2) {
      const Eigen::Vector3f& b = corners[i ^ side];
      if (a.z() >= kNear || b.z() < kNear) continue;
      seen.extend((a + (kNear - a.z()) / (b.z() - a.z()) * (b - a)).head<2>() / kNear);
    }
  }
  return seen;
}

/// A pinhole's windows: half a pixel for rays beside the centres, the rest of one for rounding.
std::vector<PixelWindow> StraightWindows(const PixelRays& rays,
                                         std::span<const Eigen::AlignedBox2f> seen) {
  const Eigen::Vector2d margin(rays.step_x, rays.step_y);
  std::vector<PixelWindow> windows(seen.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].isEmpty()) continue;
    windows[i] = WindowOfRays(rays, seen[i].min().cast<double>() - margin,
                              seen[i].max().cast<double>() + margin);
  }
  return windows;
}

/// The same through a lens that bends, whose pixels are unlike: seen by angle, one at 77 degrees is
/// twenty times as wide on the plane z = 1 as one in the middle. Each has a margin of its own, and
/// all movers are looked for in one walk over the pixels.
std::vector<PixelWindow> BentWindows(const PixelRays& rays,
                                     std::span<const Eigen::AlignedBox2f> seen) {
  const std::size_t movers = seen.size();
  if (movers == 0) return {};
  const PixelWindow none{rays.width, rays.height, 0, 0};
  std::vector<PixelWindow> of_rows(movers * static_cast<std::size_t>(rays.height), none);
  ParallelFor(0, rays.height, [&](int y) {
    PixelWindow* const of_row = &of_rows[movers * static_cast<std::size_t>(y)];
    for (int x = 0; x < rays.width; ++x) {
      const Eigen::Vector2f ray = rays.At(x, y);
      const PixelRays::Step step = rays.StepAt(x, y);
      const Eigen::Array2f margin = step.right.cwiseAbs() + step.down.cwiseAbs();
      const Eigen::Array2f low = ray.array() - margin, high = ray.array() + margin;
      for (std::size_t i = 0; i < movers; ++i) {
        if ((low > seen[i].max().array()).any() || (high < seen[i].min().array()).any()) continue;
        of_row[i].x0 = std::min(of_row[i].x0, x);
        of_row[i] = {of_row[i].x0, y, x + 1, y + 1};
      }
    }
  });
  std::vector<PixelWindow> windows(movers, none);
  for (std::size_t k = 0; k < of_rows.size(); ++k) {
    const PixelWindow& row = of_rows[k];
    PixelWindow& all = windows[k % movers];
    all = {std::min(all.x0, row.x0), std::min(all.y0, row.y0), std::max(all.x1, row.x1),
           std::max(all.y1, row.y1)};
  }
  return windows;
}

}  // namespace

MoverWindows::MoverWindows(const Instant& instant, const CameraView& view) {
  const Eigen::Isometry3f T_camera_world = view.T_world_camera.inverse().cast<float>();
  std::vector<Eigen::AlignedBox2f> seen;
  for (const Eigen::AlignedBox3f& box : instant.mover_boxes()) {
    seen.push_back(Project(box, T_camera_world));
  }
  windows_ =
      view.rays->straight ? StraightWindows(*view.rays, seen) : BentWindows(*view.rays, seen);
}

}  // namespace aisle::sim
