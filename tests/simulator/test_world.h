#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <opencv2/core.hpp>

#include "simulator/world/world.h"

/// Small worlds for tests: no files, no assets.
namespace aisle::sim::test {

/// Grows a mesh (and, for static worlds, the instance of each triangle).
class MeshBuilder {
 public:
  void Quad(const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v,
            std::uint16_t material, std::uint16_t instance, float uv_scale = 1) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const Eigen::Vector3f normal = u.cross(v).normalized();
    const std::array<Eigen::Vector2f, 4> uvs = {Eigen::Vector2f(0, 0), Eigen::Vector2f(u.norm(), 0),
                                                Eigen::Vector2f(u.norm(), v.norm()),
                                                Eigen::Vector2f(0, v.norm())};
    const std::array<Eigen::Vector3f, 4> corners = {corner, corner + u, corner + u + v, corner + v};
    for (std::size_t i = 0; i < 4; ++i) {
      mesh.positions.push_back(corners[i]);
      mesh.normals.push_back(normal);
      mesh.uvs.push_back(uvs[i] * uv_scale);
    }
    Triangle({first, first + 1, first + 2}, material, instance);
    Triangle({first, first + 2, first + 3}, material, instance);
  }

  void Box(const Eigen::Vector3f& lo, const Eigen::Vector3f& hi, std::uint16_t material,
           std::uint16_t instance, float uv_scale = 1) {
    const Eigen::Vector3f d = hi - lo;
    const Eigen::Vector3f x(d.x(), 0, 0), y(0, d.y(), 0), z(0, 0, d.z());
    Quad(lo, y, x, material, instance, uv_scale);
    Quad(lo + z, x, y, material, instance, uv_scale);
    Quad(lo, x, z, material, instance, uv_scale);
    Quad(lo + y, z, x, material, instance, uv_scale);
    Quad(lo, z, y, material, instance, uv_scale);
    Quad(lo + x, y, z, material, instance, uv_scale);
  }

  void Sphere(const Eigen::Vector3f& center, const Eigen::Vector3f& radii, int rings,
              std::uint16_t material, std::uint16_t instance) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const int segments = 2 * rings;
    for (int i = 0; i <= rings; ++i) {
      for (int j = 0; j <= segments; ++j) {
        const float theta =
            std::numbers::pi_v<float> * static_cast<float>(i) / static_cast<float>(rings);
        const float phi =
            2 * std::numbers::pi_v<float> * static_cast<float>(j) / static_cast<float>(segments);
        const Eigen::Vector3f n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                                std::cos(theta));
        mesh.positions.push_back(center + n.cwiseProduct(radii));
        mesh.normals.push_back(n.cwiseQuotient(radii).normalized());
        mesh.uvs.emplace_back(static_cast<float>(j) / static_cast<float>(segments),
                              static_cast<float>(i) / static_cast<float>(rings));
      }
    }
    const auto at = [&](int i, int j) {
      return first + static_cast<std::uint32_t>(i * (segments + 1) + j);
    };
    for (int i = 0; i < rings; ++i) {
      for (int j = 0; j < segments; ++j) {
        Triangle({at(i, j), at(i + 1, j), at(i + 1, j + 1)}, material, instance);
        Triangle({at(i, j), at(i + 1, j + 1), at(i, j + 1)}, material, instance);
      }
    }
  }

  TriangleMesh mesh;
  std::vector<std::uint16_t> instances;

 private:
  void Triangle(const std::array<std::uint32_t, 3>& t, std::uint16_t material,
                std::uint16_t instance) {
    mesh.triangles.push_back(t);
    mesh.materials.push_back(material);
    instances.push_back(instance);
  }
};

/// The rig at a place, looking along a heading in the floor plane (0: along world x), level.
inline Eigen::Isometry3d LookAlong(const Eigen::Vector3d& position, double heading_rad) {
  Eigen::Matrix3d r;
  r.col(0) = Eigen::Vector3d(std::sin(heading_rad), -std::cos(heading_rad), 0);
  r.col(1) = -Eigen::Vector3d::UnitZ();
  r.col(2) = Eigen::Vector3d(std::cos(heading_rad), std::sin(heading_rad), 0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = r;
  pose.translation() = position;
  return pose;
}

/// Grey noise with blotches of several sizes, and a few lines.
inline cv::Mat Speckle(int size, std::uint64_t seed) {
  cv::Mat1f sum(size, size, 128.0f);
  cv::RNG rng(seed);
  for (int cells = 8; cells <= size; cells *= 2) {
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const auto hash =
            static_cast<std::uint32_t>((static_cast<std::uint64_t>(x * cells / size) * 73856093u) ^
                                       (static_cast<std::uint64_t>(y * cells / size) * 19349663u) ^
                                       (seed * 83492791u) ^ static_cast<std::uint64_t>(cells));
        sum(y, x) += static_cast<float>((hash * 2654435761u) >> 24) * 0.12f - 15.0f;
      }
    }
  }
  cv::Mat grey;
  sum.convertTo(grey, CV_8U);
  return grey;
}

struct HallOptions {
  int boxes = 4000;    ///< cartons on the shelves, 12 triangles each
  bool movers = true;  ///< a walking figure of balls and a driving box
  int lights = 12;
};

/// A hall of 30 × 12 × 6 m with an aisle along x between two rows of stacked cartons, lit by
/// luminaires; a figure walks across the aisle and a box drives along it.
inline WorldParts Hall(const HallOptions& options) {
  WorldParts parts;
  parts.instances = {
      {"nothing", ObjectClass::kNone, false},    {"floor", ObjectClass::kFloor, false},
      {"walls", ObjectClass::kWall, false},      {"goods", ObjectClass::kGoods, false},
      {"lamps", ObjectClass::kLuminaire, false}, {"figure", ObjectClass::kPerson, true},
      {"truck", ObjectClass::kForklift, true}};
  parts.textures = {{"speckle", Speckle(512, 1)}, {"carton", Speckle(256, 2)}};
  parts.materials.resize(5);
  parts.materials[0] = {.name = "floor", .albedo = 0.9f, .albedo_texture = 0};
  parts.materials[1] = {.name = "wall", .albedo = 0.6f};
  parts.materials[2] = {.name = "carton", .albedo = 1.2f, .albedo_texture = 1};
  parts.materials[3] = {.name = "lamp", .albedo = 0.5f, .emission = 20.0f};
  parts.materials[4] = {.name = "figure", .albedo = 0.4f, .albedo_texture = 1};

  MeshBuilder world;
  const Eigen::Vector3f x(30, 0, 0), y(0, 12, 0), z(0, 0, 6), o(0, -6, 0);
  world.Quad(o, x, y, 0, 1, 0.5f);
  world.Quad(o + z, y, x, 1, 2);
  world.Quad(o, z, x, 1, 2);
  world.Quad(o + y, x, z, 1, 2);
  world.Quad(o, y, z, 1, 2);
  world.Quad(o + x, z, y, 1, 2);
  cv::RNG rng(7);
  const int a_side = std::max(1, options.boxes / 2), levels = 5;
  const int columns = std::max(1, a_side / levels / 4);
  for (int i = 0; i < options.boxes; ++i) {
    const int side = i % 2, j = i / 2, depth = j % 4, level = j / 4 % levels;
    const int column = j / 4 / levels;
    const float width = 26.0f / static_cast<float>(columns);
    const float w = width * rng.uniform(0.7f, 0.95f), h = rng.uniform(0.5f, 0.9f);
    const float d = rng.uniform(0.3f, 0.45f);
    const float cx = 2 + static_cast<float>(column) * width;
    const float cy =
        side ? 1.6f + 0.5f * static_cast<float>(depth) : -2.1f - 0.5f * static_cast<float>(depth);
    const float cz = static_cast<float>(level);
    world.Box({cx, cy, cz}, {cx + w, cy + d, cz + h}, 2, 3, 1.0f);
  }
  for (int i = 0; i < options.lights; ++i) {
    const int half = (options.lights + 1) / 2;
    const Eigen::Vector3f center(
        3 + 24.0f * (static_cast<float>(i % half) + 0.5f) / static_cast<float>(half),
        i < half ? -0.8f : 0.8f, 5.7f);
    const Eigen::Vector3f hu(0.75f, 0, 0), hv(0, -0.15f, 0);
    parts.lights.push_back({center, hu, hv, 20.0f});
    world.Quad(center - hu - hv, 2 * hu, 2 * hv, 3, 4);
  }
  parts.statics = {std::move(world.mesh), std::move(world.instances)};
  if (!options.movers) return parts;

  MeshBuilder figure;
  figure.Sphere({0, 0, 1.65f}, {0.11f, 0.1f, 0.14f}, 12, 4, 5);
  figure.Sphere({0, 0, 1.15f}, {0.16f, 0.24f, 0.38f}, 20, 4, 5);
  figure.Sphere({0.15f, 0.1f, 0.42f}, {0.09f, 0.09f, 0.42f}, 16, 4, 5);
  figure.Sphere({-0.15f, -0.1f, 0.42f}, {0.09f, 0.09f, 0.42f}, 16, 4, 5);
  MeshBuilder truck;
  truck.Box({-1, -0.5f, 0.1f}, {1, 0.5f, 1.9f}, 4, 6, 1.0f);
  parts.mover_meshes = {figure.mesh, truck.mesh};
  parts.at = [meshes = parts.mover_meshes, lights = parts.lights.size()](std::int64_t stamp_ns) {
    const double t = 1e-9 * static_cast<double>(stamp_ns);
    Snapshot snapshot{
        .stamp_ns = stamp_ns, .movers = {}, .light_scale = std::vector<float>(lights, 1)};
    const std::array<Eigen::Vector3d, 2> places = {Eigen::Vector3d(7, -1.2 + 0.6 * t, 0),
                                                   Eigen::Vector3d(16 - 0.8 * t, 0.4, 0)};
    const std::array<Eigen::Vector3d, 2> speeds = {Eigen::Vector3d(0, 0.6, 0),
                                                   Eigen::Vector3d(-0.8, 0, 0)};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      MoverState state;
      state.instance = static_cast<std::uint16_t>(5 + i);
      state.T_world_object.translation() = places[i];
      state.velocity_mps = speeds[i];
      for (const Eigen::Vector3f& p : meshes[i].positions) {
        state.positions.push_back(p + places[i].cast<float>());
        state.velocities.push_back(speeds[i].cast<float>());
      }
      state.normals = meshes[i].normals;
      snapshot.movers.push_back(std::move(state));
    }
    return snapshot;
  };
  return parts;
}

}  // namespace aisle::sim::test
