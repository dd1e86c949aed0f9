#pragma once

#include <span>

#include "simulator/shade/lanes/hemisphere.h"
#include "simulator/shade/lanes/wide.h"
#include "simulator/shade/light/emitter_visibility.h"

/// How rays are dealt to emitters, by all that ask which of them a place sees.
namespace aisle::sim {

inline constexpr float kAlmostAtEmitter = 0.998f;  ///< of the way: short of the lamp's own surface

/// A power of two near share · rays_per_share: the points of fewer rays are among those of more, so
/// that a share which changes with time moves no point.
int RaysForShare(float share, float rays_per_share, int least, int most);

/// Up to eight places, and the shift of each one's points on the emitters.
struct Places8 {
  explicit Places8(std::span<const ShadowedPlace> places) {
    for (int k = 0; k < kLanes; ++k) {
      const std::size_t i = std::min(static_cast<std::size_t>(k), places.size() - 1);
      const auto& [surface, id] = places[i];
      const Eigen::Vector2f at = SpreadPoint(static_cast<int>(id % 65536));
      position.x[k] = surface.position.x();
      position.y[k] = surface.position.y();
      position.z[k] = surface.position.z();
      normal.x[k] = surface.normal.x();
      normal.y[k] = surface.normal.y();
      normal.z[k] = surface.normal.z();
      shift_a[k] = at.x();
      shift_b[k] = at.y();
      valid[k] = static_cast<std::size_t>(k) < places.size() ? -1 : 0;
    }
  }

  /// The i-th point of each place on an emitter, in halves of its sides: [-1, 1).
  std::pair<F8, F8> PlaceOnEmitter(int i) const {
    const Eigen::Vector2f at = SpreadPoint(i);
    const F8 a = at.x() + shift_a, b = at.y() + shift_b;
    return {2 * (a - Floor(a)) - 1, 2 * (b - Floor(b)) - 1};
  }

  F8x3 position, normal;
  F8 shift_a, shift_b;
  I8 valid;
};

/// The same for one place, eight points at a time: lane k holds the (first + k)-th.
inline std::pair<F8, F8> EightOnEmitter(const Places8& one, int first) {
  F8 a, b;
  for (int k = 0; k < kLanes; ++k) {
    const Eigen::Vector2f at = SpreadPoint(first + k);
    a[k] = at.x() + one.shift_a[0];
    b[k] = at.y() + one.shift_b[0];
  }
  return {2 * (a - Floor(a)) - 1, 2 * (b - Floor(b)) - 1};
}

/// Points given in halves of an emitter's sides, in the world.
inline F8x3 PointsOn(const Emitters::Emitter& e, const std::pair<F8, F8>& at) {
  const auto& [u, v] = at;
  return {e.center.x() + u * e.half_u.x() + v * e.half_v.x(),
          e.center.y() + u * e.half_u.y() + v * e.half_v.y(),
          e.center.z() + u * e.half_u.z() + v * e.half_v.z()};
}

}  // namespace aisle::sim
