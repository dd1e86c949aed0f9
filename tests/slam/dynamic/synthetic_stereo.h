#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "slam/camera/stereo_camera.h"
#include "slam/common/parallel.h"

// A world of textured rectangles seen by a stereo rig, with exact depth and motion masks: small
// enough to be read and believed. Every pixel is a function of its ray alone.

namespace aisle::slam::test {

/// The simulator's default camera at half its size.
constexpr StereoCamera kHalfCamera{.width = 376,
                                   .height = 240,
                                   .fx = 217.6,
                                   .fy = 217.6,
                                   .cx = 187.5,
                                   .cy = 119.5,
                                   .baseline_m = 0.12};

/// A textured rectangle: points centre + s * right + t * down with |s| <= half_width and
/// |t| <= half_height, at time 0.
struct Panel {
  Eigen::Vector3d centre = {0, 0, 5};
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();
  Eigen::Vector3d down = Eigen::Vector3d::UnitY();
  double half_width = 1, half_height = 1;                  ///< metres
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();  ///< in the world
  double brightness = 128, contrast = 70;                  ///< grey levels
  double grain_m = 0.05;                                   ///< size of the finest texture
  std::uint32_t texture = 1;                               ///< seed
};

struct SyntheticView {
  cv::Mat1b left, right;
  cv::Mat1f disparity;  ///< of the left image, pixels; 0 where nothing is hit
  cv::Mat1b moving;     ///< 255 where the left image shows a moving panel
  cv::Mat1b panel;      ///< index + 1 of the panel seen
};

inline std::uint32_t HashOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  std::uint32_t h = a * 0x8da6b343U ^ b * 0xd8163841U ^ c * 0xcb1ab31fU;
  h = (h ^ (h >> 16)) * 0x7feb352dU;
  h = (h ^ (h >> 15)) * 0x846ca68bU;
  return h ^ (h >> 16);
}

/// Smooth noise in [-1, 1] with features of size one.
inline double ValueNoise(double s, double t, std::uint32_t seed) {
  const double fs = std::floor(s), ft = std::floor(t);
  const auto corner = [&](double i, double j) {
    const auto a = static_cast<std::uint32_t>(static_cast<std::int32_t>(fs + i));
    const auto b = static_cast<std::uint32_t>(static_cast<std::int32_t>(ft + j));
    return HashOf(a, b, seed) / 2147483647.5 - 1;
  };
  const auto ease = [](double x) { return x * x * (3 - 2 * x); };
  const double u = ease(s - fs), v = ease(t - ft);
  return (corner(0, 0) * (1 - u) + corner(1, 0) * u) * (1 - v) +
         (corner(0, 1) * (1 - u) + corner(1, 1) * u) * v;
}

struct PanelHit {
  int panel = -1;
  double depth_m = 0;  ///< z in the camera
  double grey = 0;
};

/// What a ray from the camera at T_world_camera with direction (x, y, 1) sees at a time.
inline PanelHit Look(const std::vector<Panel>& panels, const Eigen::Isometry3d& T_world_camera,
                     double x, double y, double time_s) {
  const Eigen::Vector3d origin = T_world_camera.translation();
  const Eigen::Vector3d direction = T_world_camera.linear() * Eigen::Vector3d(x, y, 1);
  PanelHit hit;
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Panel& panel = panels[k];
    const Eigen::Vector3d centre = panel.centre + time_s * panel.velocity_mps;
    const Eigen::Vector3d normal = panel.right.cross(panel.down);
    const double depth = normal.dot(centre - origin) / normal.dot(direction);
    if (!(depth > 0.05) || (hit.panel >= 0 && depth >= hit.depth_m)) continue;
    const Eigen::Vector3d local = origin + depth * direction - centre;
    const double s = local.dot(panel.right), t = local.dot(panel.down);
    if (std::abs(s) > panel.half_width || std::abs(t) > panel.half_height) continue;
    const double fine = ValueNoise(s / panel.grain_m, t / panel.grain_m, panel.texture);
    const double coarse =
        ValueNoise(s / panel.grain_m / 4, t / panel.grain_m / 4, panel.texture + 77);
    hit = {static_cast<int>(k), depth, panel.brightness + panel.contrast * (fine + coarse) / 2};
  }
  return hit;
}

/// Noise of about unit deviation that depends on its indices alone.
inline double UnitNoise(std::uint32_t frame, std::uint32_t camera, std::uint32_t pixel) {
  double sum = 0;
  for (std::uint32_t k = 0; k < 4; ++k) sum += HashOf(4 * frame + k, camera, pixel) / 4294967295.0;
  return (sum - 2) * std::sqrt(3.0);
}

/// Renders the rig at T_world_rig at a time; `noise` is the deviation in grey levels.
inline SyntheticView Render(const std::vector<Panel>& panels, const StereoCamera& camera,
                            const Eigen::Isometry3d& T_world_rig, double time_s,
                            double noise = 1.5) {
  const cv::Size size(camera.width, camera.height);
  SyntheticView view{cv::Mat1b(size), cv::Mat1b(size), cv::Mat1f(size), cv::Mat1b(size),
                     cv::Mat1b(size)};
  const auto frame = static_cast<std::uint32_t>(std::lround(time_s * 1000));
  const Eigen::Isometry3d T_world_right =
      T_world_rig * Eigen::Translation3d(camera.baseline_m, 0, 0);
  ParallelFor(0, camera.height, [&](int v) {
    for (int u = 0; u < camera.width; ++u) {
      const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
      const auto pixel = static_cast<std::uint32_t>(v * camera.width + u);
      const PanelHit left = Look(panels, T_world_rig, x, y, time_s);
      const PanelHit right = Look(panels, T_world_right, x, y, time_s);
      view.left(v, u) =
          cv::saturate_cast<unsigned char>(left.grey + noise * UnitNoise(frame, 0, pixel));
      view.right(v, u) =
          cv::saturate_cast<unsigned char>(right.grey + noise * UnitNoise(frame, 1, pixel));
      const bool hit = left.panel >= 0;
      view.disparity(v, u) =
          hit ? static_cast<float>(camera.fx * camera.baseline_m / left.depth_m) : 0.0F;
      view.panel(v, u) = static_cast<unsigned char>(left.panel + 1);
      view.moving(v, u) =
          hit && panels[static_cast<std::size_t>(left.panel)].velocity_mps.norm() > 0 ? 255 : 0;
    }
  });
  return view;
}

/// A corridor of a warehouse in rectangles: back wall, two racks along the way, floor, boxes that
/// stand free. The camera is 1 m above the floor and looks along +z from the origin.
inline std::vector<Panel> StaticHall() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
                        z = Eigen::Vector3d::UnitZ();
  return {
      {.centre = {0, -1, 12}, .half_width = 9, .half_height = 4, .grain_m = 0.12, .texture = 11},
      {.centre = {-3.0, -1, 6},
       .right = z,
       .half_width = 7,
       .half_height = 2.5,
       .brightness = 110,
       .grain_m = 0.08,
       .texture = 12},
      {.centre = {3.0, -1, 6},
       .right = z,
       .half_width = 7,
       .half_height = 2.5,
       .brightness = 140,
       .grain_m = 0.08,
       .texture = 13},
      {.centre = {0, 1.0, 7},
       .right = x,
       .down = z,
       .half_width = 5,
       .half_height = 7,
       .brightness = 90,
       .contrast = 50,
       .grain_m = 0.10,
       .texture = 14},
      {.centre = {-1.6, 0.4, 5.0},
       .down = y,
       .half_width = 0.4,
       .half_height = 0.6,
       .brightness = 170,
       .grain_m = 0.06,
       .texture = 15},
      {.centre = {1.7, 0.2, 7.0},
       .half_width = 0.5,
       .half_height = 0.8,
       .brightness = 150,
       .grain_m = 0.07,
       .texture = 16},
  };
}

/// A standing person's worth of texture.
inline Panel Walker(const Eigen::Vector3d& centre, const Eigen::Vector3d& velocity_mps) {
  return {.centre = centre,
          .half_width = 0.28,
          .half_height = 0.85,
          .velocity_mps = velocity_mps,
          .brightness = 60,
          .contrast = 55,
          .grain_m = 0.05,
          .texture = 21};
}

}  // namespace aisle::slam::test
