#include "simulator/trace/mover_windows.h"

#include "simulator/common/parallel.h"

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

}  // namespace

MoverWindows::MoverWindows(const Instant& instant, const CameraView& view)
    : windows_(instant.mover_boxes().size()) {
  const PixelRays& rays = *view.rays;
  const Eigen::Isometry3f T_camera_world = view.T_world_camera.inverse().cast<float>();
  // Half a pixel for rays beside the centres; the rest for rounding.
  const Eigen::Vector2d margin(rays.step_x, rays.step_y);
  ParallelFor(std::size_t{0}, windows_.size(), [&](std::size_t i) {
    const Eigen::AlignedBox2f seen = Project(instant.mover_boxes()[i], T_camera_world);
    if (seen.isEmpty()) return;
    windows_[i] =
        WindowOfRays(rays, seen.min().cast<double>() - margin, seen.max().cast<double>() + margin);
  });
}

}  // namespace aisle::sim
