#pragma once

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/light/light_volume.h"
#include "simulator/shade/light/static_visibility.h"

namespace aisle::sim {

/// What bodies within reach keep of the indirect light that reaches one mover, its own limbs among
/// them: they hide where it comes from, and their shadow on the floor takes from what the floor
/// sends up.
class MoverIndirect {
 public:
  /// All must outlive it. `floor_z`: height of the floor, m.
  MoverIndirect(const Instant& instant, const Emitters& emitters, const StaticVisibility& statics,
                const LightVolume& volume, std::size_t mover, float floor_z);

  /// Share of the indirect irradiance that is left at a place of the mover's surface. The
  /// directions that are asked turn with `tangent`, any vector that is fixed to the surface there.
  float KeptAt(const ShadowedPlace& place, const Eigen::Vector3f& tangent) const;

 private:
  static constexpr std::size_t kPackets = 2;  ///< of eight directions around a normal
  using Directions = std::array<F8x3, kPackets>;
  /// The directions around a normal, given as the third axis of the basis.
  Directions Turned(const Eigen::Matrix3f& basis) const;
  /// Lanes of directions that bodies block.
  std::array<I8, kPackets> Probe(const SurfacePoint& point, const Directions& directions) const;
  void ShadeGround(const Emitters& emitters, const StaticVisibility& statics, std::size_t mover);
  /// Shares of its light that the floor keeps where rays from `from` meet it; 1 if they do not.
  F8 KeptByGround(const Eigen::Vector3f& from, const F8x3& directions) const;

  const Instant& instant_;
  const LightVolume& volume_;
  GeometryMask bodies_;
  Directions directions_;                            ///< around z
  float ground_z_;                                   ///< m
  Eigen::Vector2i first_ = Eigen::Vector2i::Zero();  ///< node of a grid that is fixed in the world
  Eigen::Vector2i nodes_ = Eigen::Vector2i::Zero();  ///< along x, y
  std::vector<float> kept_;                          ///< by node, rows along x
};

}  // namespace aisle::sim
