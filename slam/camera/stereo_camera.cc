#include "slam/camera/stereo_camera.h"

#include <fmt/format.h>

namespace aisle::slam {

std::string Validate(const StereoCamera& camera) {
  if (camera.width < 64 || camera.height < 64) {
    return fmt::format("camera is {}x{} pixels; at least 64x64 are needed", camera.width,
                       camera.height);
  }
  const auto is_length = [](double value) { return std::isfinite(value) && value > 0; };
  if (!is_length(camera.fx) || !is_length(camera.fy)) {
    return fmt::format("fx = {}, fy = {} pixels; both must be positive and finite", camera.fx,
                       camera.fy);
  }
  if (!is_length(camera.baseline_m)) {
    return fmt::format(
        "baseline_m = {}; it must be positive and finite (is the right camera given as the left?)",
        camera.baseline_m);
  }
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy)) {
    return fmt::format("cx = {}, cy = {} pixels; both must be finite", camera.cx, camera.cy);
  }
  return {};
}

Eigen::Vector3d Project(const StereoCamera& camera, const Eigen::Vector3d& point) {
  const double inverse_z = 1.0 / point.z();
  return {camera.fx * point.x() * inverse_z + camera.cx,
          camera.fy * point.y() * inverse_z + camera.cy, camera.fx * camera.baseline_m * inverse_z};
}

Eigen::Vector3d Backproject(const StereoCamera& camera, const Eigen::Vector3d& uvd) {
  const double z = DepthOf(camera, uvd.z());
  return {(uvd.x() - camera.cx) / camera.fx * z, (uvd.y() - camera.cy) / camera.fy * z, z};
}

Eigen::Matrix3d ProjectionJacobian(const StereoCamera& camera, const Eigen::Vector3d& point) {
  const double inverse_z = 1.0 / point.z();
  const double inverse_z2 = inverse_z * inverse_z;
  Eigen::Matrix3d jacobian;
  jacobian << camera.fx * inverse_z, 0, -camera.fx * point.x() * inverse_z2,  //
      0, camera.fy * inverse_z, -camera.fy * point.y() * inverse_z2,          //
      0, 0, -camera.fx * camera.baseline_m * inverse_z2;
  return jacobian;
}

}  // namespace aisle::slam
