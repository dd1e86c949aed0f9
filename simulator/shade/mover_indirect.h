#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "simulator/shade/direct_light.h"
#include "simulator/shade/light_volume.h"

namespace aisle::sim {

/// The indirect light that reaches one mover: what the static world would send there, less what
/// bodies within reach keep away, its own limbs among them, and less what their shadow on the floor
/// takes from the light that the floor sends up.
class MoverIndirect {
 public:
  /// `directions` rays a point, a whole number of packets. `instant` and `volume` must outlive it.
  MoverIndirect(const Instant& instant, std::span<const AreaLight> lights,
                const LightVolume& volume, std::size_t mover, int directions);

  /// Irradiance at a point of the mover's surface.
  float At(const SurfacePoint& point) const;

 private:
  /// Which of the directions around a normal bodies block, as bits from the first packet on.
  using Blocked = std::vector<unsigned>;
  Blocked Probe(const SurfacePoint& point, const Eigen::Matrix3f& basis,
                std::span<const Eigen::Vector3f> directions) const;
  void ShadeGround(std::span<const AreaLight> lights);
  /// Share of its light that the floor keeps where a ray from `from` meets it; 1 if it does not.
  float KeptByGround(const Eigen::Vector3f& from, const Eigen::Vector3f& direction) const;

  const Instant& instant_;
  const LightVolume& volume_;
  GeometryMask bodies_;
  std::vector<Eigen::Vector3f> directions_;
  Eigen::Vector3f ground_ = Eigen::Vector3f::Zero();  ///< first node of the floor's grid
  Eigen::Vector2i nodes_ = Eigen::Vector2i::Zero();   ///< along x, y
  std::vector<float> kept_;                           ///< by node, rows along x
};

}  // namespace aisle::sim
