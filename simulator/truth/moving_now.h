#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "simulator/world/world.h"

namespace aisle::sim {

/// What "moves now" means.
struct MovingOptions {
  float threshold_mps = 0.05f;  ///< a surface faster than this moves
  /// Length of the exposure that "now" is, around the stamp. Below the millisecond over which
  /// velocities are differenced it is the stamp alone.
  double window_ms = 8;
};

/// Tells which surfaces move now: those whose fastest speed within the window exceeds the
/// threshold. At the one instant of the stamp an arm that turns back is at rest, though the picture
/// that is exposed around it shows it moving.
///
/// Speeds are taken at the stamp, at both ends of the window, and between them at most 4 ms apart.
/// Where a point's velocity changes evenly from one such instant to the next, its speed is convex
/// in time, so that one of them is the fastest.
class MovingNow {
 public:
  /// `snapshot` is the world's at the stamp; it and the world must outlive this.
  MovingNow(const World& world, const Snapshot& snapshot, const MovingOptions& options);
  MovingNow(const MovingNow&) = delete;
  MovingNow& operator=(const MovingNow&) = delete;

  /// Whether the point (u, v) of a triangle of a mover (by its index in the snapshot) moves now.
  bool operator()(std::size_t mover, std::uint32_t primitive, float u, float v) const;
  /// Whether any point of the mover does.
  bool Any(std::size_t mover) const { return any_[mover]; }

 private:
  bool IsFast(const Eigen::Vector3f& velocity) const { return velocity.norm() > threshold_mps_; }

  const World& world_;
  const float threshold_mps_;
  std::vector<MoverVelocities> around_;  ///< at the window's instants but for the stamp
  /// Per mover: its vertices' velocities at all of them.
  std::vector<std::vector<std::span<const Eigen::Vector3f>>> instants_;
  std::vector<bool> any_;
};

}  // namespace aisle::sim
