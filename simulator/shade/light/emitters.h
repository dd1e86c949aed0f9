#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/surface/surface_point.h"
#include "simulator/world/world.h"

namespace aisle::sim {

/// The world's luminaires as a table of emitters that each look small from where things are: a
/// lamp is one, a sky is cut into pieces.
class Emitters {
 public:
  struct Emitter {
    Eigen::Vector3f center, half_u, half_v;  ///< metres, world
    Eigen::Vector3f normal;                  ///< unit, of the side that shines
    float power = 0;                         ///< area · radiance
    std::size_t light = 0;                   ///< index into World::lights()
  };

  /// `floor_z`: the height in metres from which emitters are looked at; a side is at most as long
  /// as three quarters of its height above that.
  Emitters(std::span<const AreaLight> lights, float floor_z);

  std::size_t size() const { return emitters_.size(); }
  /// size(), rounded up to whole packets: the length of all rows by emitter.
  std::size_t stride() const { return stride_; }
  const Emitter& operator[](std::size_t i) const { return emitters_[i]; }

  /// The emitters from which a place in the box may be less than 1.25 of their longer sides away,
  /// in order.
  std::vector<std::uint32_t> NearTo(const Eigen::AlignedBox3f& box) const;
  /// Irradiance that eight emitters, `first` and those behind it, send to a place if nothing stands
  /// between (0 beyond size()): Gauss-Legendre quadrature of up to 2 × 2 points over each, whose
  /// error is some 3 % at 1.25 sides and grows beyond measure nearer. So near, those that `near`
  /// lists (NearTo of a box around the place) are exact. `first` is a multiple of eight.
  F8 Unshadowed(const SurfacePoint& place, std::span<const float> light_scale, std::size_t first,
                std::span<const std::uint32_t> near = {}) const;
  /// The share of each emitter in the light that reaches a free point from all sides.
  std::vector<float> Shares(const Eigen::Vector3f& point, std::span<const float> light_scale) const;

 private:
  /// One quadrature point of each emitter, by emitter.
  struct Column {
    std::vector<float> x, y, z, power;
  };

  std::vector<Emitter> emitters_;
  std::size_t stride_ = 0;
  std::vector<Column> columns_;
  std::vector<float> nx_, ny_, nz_;
  std::vector<float> near_;          ///< by emitter, m: how far from its centre it is near
  std::vector<std::int32_t> light_;  ///< by emitter
};

}  // namespace aisle::sim
