#include "simulator/truth/image_motion.h"

#include <algorithm>
#include <vector>

#include "simulator/common/parallel.h"
#include "simulator/truth/surface_velocity.h"

namespace aisle::sim {

double ImageMotion(const World& world, const Instant& instant, const StereoCamera& camera,
                   const CameraView& view, const HitImage& hits,
                   const Eigen::Isometry3d& T_world_first, const Eigen::Isometry3d& T_world_last,
                   double duration_s) {
  constexpr int kEvery = 4;  // pixels
  constexpr double kShare = 0.995;
  constexpr double kNear = 1e-3;  // m in front of the camera
  const Eigen::Isometry3d T_first_world = T_world_first.inverse();
  const Eigen::Isometry3d T_last_world = T_world_last.inverse();
  const Projection project(camera);
  std::vector<std::vector<float>> rows(static_cast<std::size_t>((hits.height - 1) / kEvery + 1));
  ParallelFor(std::size_t{0}, rows.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row) * kEvery;
    for (int x = 0; x < hits.width; x += kEvery) {
      const std::size_t i = hits.Index(x, y);
      if (hits.geometry[i] == kNoGeometry) continue;
      const double z = hits.t[i];
      const Eigen::Vector2d ray = view.rays->At(x, y).cast<double>();
      const Eigen::Vector3d point = view.T_world_camera * Eigen::Vector3d(z * ray.homogeneous());
      const Eigen::Vector3d way =
          0.5 * duration_s * SurfaceVelocity(world, instant.snapshot(), hits, i).cast<double>();
      const Eigen::Vector3d first = T_first_world * Eigen::Vector3d(point - way);
      const Eigen::Vector3d last = T_last_world * Eigen::Vector3d(point + way);
      if (first.z() < kNear || last.z() < kNear) continue;
      const auto from = project(first), to = project(last);
      if (from && to) rows[row].push_back(static_cast<float>((*to - *from).norm()));
    }
  });
  std::vector<float> motions;
  for (const std::vector<float>& row : rows) motions.insert(motions.end(), row.begin(), row.end());
  if (motions.empty()) return 0;
  const auto at = motions.begin() +
                  static_cast<std::ptrdiff_t>(kShare * static_cast<double>(motions.size() - 1));
  std::ranges::nth_element(motions, at);
  return *at;
}

}  // namespace aisle::sim
