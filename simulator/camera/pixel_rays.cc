#include "simulator/camera/pixel_rays.h"

namespace aisle::sim {

PixelRays MakePixelRays(const StereoCamera& camera) {
  PixelRays rays;
  rays.width = camera.width;
  rays.height = camera.height;
  rays.step_x = static_cast<float>(1.0 / camera.fx);
  rays.step_y = static_cast<float>(1.0 / camera.fy);
  const std::size_t count =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  rays.x.reserve(count + PixelRays::kPadding);
  rays.y.reserve(count + PixelRays::kPadding);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      rays.x.push_back(static_cast<float>((u - camera.cx) / camera.fx));
      rays.y.push_back(static_cast<float>((v - camera.cy) / camera.fy));
    }
  }
  rays.x.resize(count + PixelRays::kPadding);
  rays.y.resize(count + PixelRays::kPadding);
  return rays;
}

Eigen::Isometry3d EyePose(const StereoCamera& camera, const Eigen::Isometry3d& T_world_rig,
                          Eye eye) {
  if (eye == Eye::kLeft) return T_world_rig;
  return T_world_rig * Eigen::Translation3d(camera.baseline_m, 0, 0);
}

}  // namespace aisle::sim
