#include "simulator/camera/pixel_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace aisle::sim {

std::optional<Eigen::Vector2d> Projection::operator()(const Eigen::Vector3d& point_camera) const {
  const auto image = Distort(camera_.lens, widest_, point_camera.hnormalized());
  if (!image) return std::nullopt;
  return Eigen::Vector2d(camera_.fx * image->x() + camera_.cx,
                         camera_.fy * image->y() + camera_.cy);
}

PixelRays MakePixelRays(const StereoCamera& camera) {
  PixelRays rays;
  rays.width = camera.width;
  rays.height = camera.height;
  rays.step_x = static_cast<float>(1.0 / camera.fx);
  rays.step_y = static_cast<float>(1.0 / camera.fy);
  rays.straight = camera.lens.model == LensModel::kPinhole;
  const std::size_t count =
      static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  rays.x.reserve(count + PixelRays::kPadding);
  rays.y.reserve(count + PixelRays::kPadding);
  const double widest = WidestRay(camera.lens);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const std::optional<Eigen::Vector2d> ray = Undistort(
          camera.lens, widest, {(u - camera.cx) / camera.fx, (v - camera.cy) / camera.fy});
      if (!ray) {
        throw std::invalid_argument(fmt::format(
            "the lens has no ray for pixel ({}, {}): its distortion folds the image before that; "
            "smaller coefficients, a smaller image or a longer focal length help",
            u, v));
      }
      rays.x.push_back(static_cast<float>(ray->x()));
      rays.y.push_back(static_cast<float>(ray->y()));
    }
  }
  rays.x.resize(count + PixelRays::kPadding);
  rays.y.resize(count + PixelRays::kPadding);
  return rays;
}

PixelRays::Step PixelRays::StepAt(int column, int row) const {
  if (straight) return {{step_x, 0}, {0, step_y}};
  const int left = std::clamp(column, 0, width - 2), above = std::clamp(row, 0, height - 2);
  return {At(left + 1, row) - At(left, row), At(column, above + 1) - At(column, above)};
}

PixelRays RowsOf(const PixelRays& rays, int first, int last) {
  PixelRays band = rays;
  band.height = last - first;
  for (std::vector<float> PixelRays::*values : {&PixelRays::x, &PixelRays::y}) {
    const auto begin = (rays.*values).begin() + std::ptrdiff_t{first} * rays.width;
    (band.*values).assign(begin, begin + std::ptrdiff_t{band.height} * rays.width);
    (band.*values).resize((band.*values).size() + PixelRays::kPadding);
  }
  return band;
}

PixelWindow WindowOfRays(const PixelRays& rays, const Eigen::Vector2d& low,
                         const Eigen::Vector2d& high) {
  const Eigen::Vector2f lo = low.cast<float>(), hi = high.cast<float>();
  PixelWindow window{rays.width, rays.height, 0, 0};
  // A pinhole's x depends on the column alone, its y on the row: the first row and column tell all.
  const int row_step = rays.straight ? rays.height : 1;
  for (int row = 0; row < rays.height; row += row_step) {
    for (int column = 0; column < rays.width; ++column) {
      const Eigen::Vector2f ray = rays.At(column, row);
      if (ray.x() < lo.x() || ray.x() > hi.x()) continue;
      if (!rays.straight && (ray.y() < lo.y() || ray.y() > hi.y())) continue;
      window.x0 = std::min(window.x0, column);
      window.x1 = std::max(window.x1, column + 1);
      if (rays.straight) continue;
      window.y0 = std::min(window.y0, row);
      window.y1 = std::max(window.y1, row + 1);
    }
  }
  for (int row = 0; rays.straight && row < rays.height; ++row) {
    const float y = rays.At(0, row).y();
    if (y < lo.y() || y > hi.y()) continue;
    window.y0 = std::min(window.y0, row);
    window.y1 = std::max(window.y1, row + 1);
  }
  return window;
}

StereoCamera Coarser(const StereoCamera& camera, int factor) {
  StereoCamera coarse = camera;
  coarse.width = camera.width / factor;
  coarse.height = camera.height / factor;
  coarse.fx = camera.fx / factor;
  coarse.fy = camera.fy / factor;
  // The centre of the first pixel is 0; its corner is at -1/2 in both.
  coarse.cx = (camera.cx + 0.5) / factor - 0.5;
  coarse.cy = (camera.cy + 0.5) / factor - 0.5;
  return coarse;
}

Eigen::Isometry3d CameraPose(const StereoCamera& camera, const Eigen::Isometry3d& T_world_rig,
                             StereoSide side) {
  if (side == StereoSide::kLeft) return T_world_rig;
  return T_world_rig * Eigen::Translation3d(camera.baseline_m, 0, 0);
}

}  // namespace aisle::sim
