#pragma once

#include <functional>

#include "simulator/camera/pixel_rays.h"
#include "simulator/trace/hit_image.h"
#include "simulator/trace/tracer.h"
#include "tests/simulator/test_world.h"

namespace aisle::sim::test {

/// A mesh that moves, and bends, in any way: where each of its points is at a time, world.
struct OneMover {
  TriangleMesh mesh;
  std::function<Eigen::Vector3d(const Eigen::Vector3d& point, double time_s)> at;
  /// MoverState::T_world_object.
  std::function<Eigen::Isometry3d(double time_s)> pose = [](double) {
    return Eigen::Isometry3d::Identity();
  };
};

/// One that moves as a whole.
inline OneMover Rigid(TriangleMesh mesh, std::function<Eigen::Isometry3d(double time_s)> pose) {
  return {
      .mesh = std::move(mesh),
      .at = [pose](const Eigen::Vector3d& point,
                   double time_s) { return Eigen::Vector3d(pose(time_s) * point); },
      .pose = pose,
  };
}

/// Instance 2 is all that moves, in as many meshes as there are; instance 1 a wall at x = 10 m. The
/// vertices' velocities are the difference quotients of their places.
inline WorldParts BeforeAWall(const std::vector<OneMover>& movers) {
  WorldParts parts;
  parts.instances = {{"nothing", ObjectClass::kNone, false},
                     {"wall", ObjectClass::kWall, false},
                     {"mover", ObjectClass::kAgv, true}};
  parts.materials.resize(1);
  parts.lights.push_back({{0, 0, 5}, {1, 0, 0}, {0, -1, 0}, 1});
  MeshBuilder wall;
  wall.Quad({10, 50, -50}, {0, -100, 0}, {0, 0, 100}, 0, 1);
  parts.statics = {wall.mesh, wall.instances};
  for (const OneMover& mover : movers) parts.mover_meshes.push_back(mover.mesh);
  parts.at = [movers](std::int64_t stamp_ns) {
    constexpr double kHalf_s = 1e-4;
    const double t = 1e-9 * static_cast<double>(stamp_ns);
    Snapshot snapshot{.stamp_ns = stamp_ns, .movers = {}, .light_scale = {1}};
    for (const OneMover& mover : movers) {
      const auto rate = [&](const auto& place) {
        return Eigen::Vector3d((place(t + kHalf_s) - place(t - kHalf_s)) / (2 * kHalf_s));
      };
      MoverState state;
      state.instance = 2;
      for (const Eigen::Vector3f& vertex : mover.mesh.positions) {
        const auto place = [&, point = Eigen::Vector3d(vertex.cast<double>())](double time_s) {
          return mover.at(point, time_s);
        };
        state.positions.push_back(place(t).cast<float>());
        state.velocities.push_back(rate(place).cast<float>());
      }
      state.normals = mover.mesh.normals;
      state.T_world_object = mover.pose(t);
      state.velocity_mps =
          rate([&](double time_s) { return Eigen::Vector3d(mover.pose(time_s).translation()); });
      snapshot.movers.push_back(std::move(state));
    }
    return snapshot;
  };
  return parts;
}

/// That which the left camera meets.
inline HitImage Trace(const Instant& instant, const CameraView& view) {
  std::vector<HitImage> hits;
  TraceViews(instant, std::span(&view, 1), {}, &hits);
  return std::move(hits[0]);
}

}  // namespace aisle::sim::test
