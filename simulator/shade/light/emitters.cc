#include "simulator/shade/light/emitters.h"

#include <algorithm>
#include <cmath>

#include "simulator/shade/light/form_factor.h"

namespace aisle::sim {
namespace {

constexpr float kLongestSide = 0.75f;  // of the height above the floor
constexpr float kFlatSide = 0.15f;     // of that height: below, one quadrature point is enough
constexpr float kGauss = 0.57735027f;  // abscissa of the two-point rule
constexpr float kLeastHeight = 0.5f;   // m
constexpr float kNear = 1.25f;         // longer sides: nearer, quadrature is too coarse
constexpr int kMostPieces = 16;        // along a side

int Pieces(float half_side, float height) {
  return std::clamp(static_cast<int>(std::ceil(2 * half_side / (kLongestSide * height) - 1e-3f)), 1,
                    kMostPieces);
}

/// Parts one light into equal pieces.
void Cut(const AreaLight& light, std::size_t index, float floor_z,
         std::vector<Emitters::Emitter>* emitters) {
  const float height = std::max(light.center.z() - floor_z, kLeastHeight);
  const int us = Pieces(light.half_u.norm(), height), vs = Pieces(light.half_v.norm(), height);
  const Eigen::Vector3f half_u = light.half_u / static_cast<float>(us);
  const Eigen::Vector3f half_v = light.half_v / static_cast<float>(vs);
  const Eigen::Vector3f cross = half_u.cross(half_v);
  for (int v = 0; v < vs; ++v) {
    for (int u = 0; u < us; ++u) {
      emitters->push_back({light.center + static_cast<float>(2 * u + 1 - us) * half_u +
                               static_cast<float>(2 * v + 1 - vs) * half_v,
                           half_u, half_v, cross.normalized(), 4 * cross.norm() * light.radiance,
                           index});
    }
  }
}

struct Abscissae {
  std::array<float, 2> at;
  int count;
};
Abscissae PointsAlong(float half_side, float height) {
  return 2 * half_side > kFlatSide * height ? Abscissae{{-kGauss, kGauss}, 2}
                                            : Abscissae{{0, 0}, 1};
}

}  // namespace

Emitters::Emitters(std::span<const AreaLight> lights, float floor_z) {
  for (std::size_t i = 0; i < lights.size(); ++i) Cut(lights[i], i, floor_z, &emitters_);
  stride_ = (emitters_.size() + kLanes - 1) / kLanes * kLanes;
  for (std::vector<float>* values : {&nx_, &ny_, &nz_}) values->resize(stride_);
  light_.resize(stride_);
  columns_.resize(4);
  for (Column& column : columns_) {
    for (std::vector<float>* values : {&column.x, &column.y, &column.z, &column.power}) {
      values->resize(stride_);
    }
  }
  std::size_t used = 1;
  for (std::size_t i = 0; i < emitters_.size(); ++i) {
    const Emitter& e = emitters_[i];
    nx_[i] = e.normal.x();
    ny_[i] = e.normal.y();
    nz_[i] = e.normal.z();
    light_[i] = static_cast<std::int32_t>(e.light);
    near_.push_back(kNear * 2 * std::max(e.half_u.norm(), e.half_v.norm()));
    const float height = std::max(e.center.z() - floor_z, kLeastHeight);
    const Abscissae us = PointsAlong(e.half_u.norm(), height);
    const Abscissae vs = PointsAlong(e.half_v.norm(), height);
    std::size_t column = 0;
    for (int u = 0; u < us.count; ++u) {
      for (int v = 0; v < vs.count; ++v, ++column) {
        const Eigen::Vector3f at = e.center + us.at[static_cast<std::size_t>(u)] * e.half_u +
                                   vs.at[static_cast<std::size_t>(v)] * e.half_v;
        columns_[column].x[i] = at.x();
        columns_[column].y[i] = at.y();
        columns_[column].z[i] = at.z();
        columns_[column].power[i] = e.power / static_cast<float>(us.count * vs.count);
      }
    }
    used = std::max(used, column);
  }
  columns_.resize(used);
}

std::vector<std::uint32_t> Emitters::NearTo(const Eigen::AlignedBox3f& box) const {
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < emitters_.size(); ++i) {
    if (box.exteriorDistance(emitters_[i].center) < near_[i]) near.push_back(i);
  }
  return near;
}

F8 Emitters::Unshadowed(const SurfacePoint& place, std::span<const float> light_scale,
                        std::size_t first, std::span<const std::uint32_t> near) const {
  const Eigen::Vector3f &p = place.position, &n = place.normal;
  const F8 nx = LoadF(&nx_[first]), ny = LoadF(&ny_[first]), nz = LoadF(&nz_[first]);
  F8 sum = Wide(0);
  for (const Column& column : columns_) {
    const F8 dx = LoadF(&column.x[first]) - p.x(), dy = LoadF(&column.y[first]) - p.y();
    const F8 dz = LoadF(&column.z[first]) - p.z();
    const F8 squared = Max(dx * dx + dy * dy + dz * dz, Wide(1e-6f));
    const F8 here = Max(n.x() * dx + n.y() * dy + n.z() * dz, Wide(0));
    const F8 there = Max(-(nx * dx + ny * dy + nz * dz), Wide(0));
    sum += LoadF(&column.power[first]) * here * there / (squared * squared);
  }
  F8 light = sum * Gather(light_scale.data(), LoadI(&light_[first]));
  for (const std::uint32_t i : near) {
    if (i < first || i >= first + kLanes) continue;
    const Emitter& e = emitters_[i];
    if ((e.center - p).norm() >= near_[i]) continue;
    const float radiance = e.power / (4 * e.half_u.cross(e.half_v).norm());
    light[i - first] = UnshadowedIrradiance({e.center, e.half_u, e.half_v, radiance}, place) *
                       light_scale[e.light];
  }
  return light;
}

std::vector<float> Emitters::Shares(const Eigen::Vector3f& point,
                                    std::span<const float> light_scale) const {
  std::vector<float> shares;
  float total = 0;
  for (const Emitter& e : emitters_) {
    const Eigen::Vector3f way = e.center - point;
    const float squared = std::max(way.squaredNorm(), 1e-2f);
    const float there = std::max(0.0f, -way.dot(e.normal));
    shares.push_back(e.power * light_scale[e.light] * there / (squared * std::sqrt(squared)));
    total += shares.back();
  }
  for (float& share : shares) share = total > 0 ? share / total : 0;
  return shares;
}

}  // namespace aisle::sim
