#include "simulator/truth/moving_now.h"

#include <algorithm>
#include <cmath>

#include "simulator/truth/surface_velocity.h"

namespace aisle::sim {
namespace {

constexpr double kSpacing_ms = 4;
constexpr double kDifferenced_ms = 1;  // velocities say nothing of shorter times

/// Instants of the window on one side of the stamp, nanoseconds from it.
std::vector<std::int64_t> OffsetsOf(double window_ms) {
  std::vector<std::int64_t> offsets;
  if (window_ms <= kDifferenced_ms) return offsets;
  const int steps = static_cast<int>(std::ceil(window_ms / 2 / kSpacing_ms));
  for (int k = 1; k <= steps; ++k) offsets.push_back(std::llround(1e6 * window_ms / 2 * k / steps));
  return offsets;
}

}  // namespace

MovingNow::MovingNow(const World& world, const Snapshot& snapshot, const MovingOptions& options)
    : world_(world), threshold_mps_(options.threshold_mps), instants_{&snapshot} {
  if (snapshot.movers.empty()) return;
  for (const std::int64_t offset_ns : OffsetsOf(options.window_ms)) {
    around_.push_back(world.Near(snapshot, -offset_ns));
    around_.push_back(world.Near(snapshot, offset_ns));
  }
  for (const Snapshot& other : around_) instants_.push_back(&other);
  for (std::size_t i = 0; i < snapshot.movers.size(); ++i) {
    any_.push_back(std::ranges::any_of(instants_, [&](const Snapshot* instant) {
      return std::ranges::any_of(instant->movers[i].velocities,
                                 [&](const Eigen::Vector3f& v) { return IsFast(v); });
    }));
  }
}

bool MovingNow::operator()(std::size_t mover, std::uint32_t primitive, float u, float v) const {
  // The speed of a point is at most that of the fastest of its triangle's vertices.
  return any_[mover] && std::ranges::any_of(instants_, [&](const Snapshot* instant) {
           return IsFast(VelocityOnMover(world_.mover_meshes()[mover],
                                         instant->movers[mover].velocities, primitive, u, v));
         });
}

}  // namespace aisle::sim
