#include "simulator/truth/moving_now.h"

#include <algorithm>
#include <cmath>

#include "simulator/truth/surface_velocity.h"

namespace aisle::sim {
namespace {

constexpr double kSpacing_ms = 4;
constexpr double kDifferenced_ms = 1;  // velocities say nothing of shorter times

/// Instants of the window but for the stamp, nanoseconds from it.
std::vector<std::int64_t> OffsetsOf(double window_ms) {
  std::vector<std::int64_t> offsets;
  if (window_ms <= kDifferenced_ms) return offsets;
  const int steps = static_cast<int>(std::ceil(window_ms / 2 / kSpacing_ms));
  for (int k = 1; k <= steps; ++k) {
    const std::int64_t offset_ns = std::llround(1e6 * window_ms / 2 * k / steps);
    offsets.insert(offsets.end(), {-offset_ns, offset_ns});
  }
  return offsets;
}

}  // namespace

MovingNow::MovingNow(const World& world, const Snapshot& snapshot, const MovingOptions& options)
    : world_(world),
      threshold_mps_(options.threshold_mps),
      around_(world.VelocitiesNear(snapshot, OffsetsOf(options.window_ms))) {
  for (std::size_t i = 0; i < snapshot.movers.size(); ++i) {
    std::vector<std::span<const Eigen::Vector3f>>& instants = instants_.emplace_back();
    instants.emplace_back(snapshot.movers[i].velocities);
    for (const MoverVelocities& then : around_) instants.emplace_back(then[i]);
    any_.push_back(std::ranges::any_of(instants, [&](std::span<const Eigen::Vector3f> velocities) {
      return std::ranges::any_of(velocities, [&](const Eigen::Vector3f& v) { return IsFast(v); });
    }));
  }
}

bool MovingNow::operator()(std::size_t mover, std::uint32_t primitive, float u, float v) const {
  // The speed of a point is at most that of the fastest of its triangle's vertices.
  const TriangleMesh& mesh = world_.mover_meshes()[mover];
  return any_[mover] && std::ranges::any_of(instants_[mover], [&](const auto& velocities) {
           return IsFast(VelocityOnMover(mesh, velocities, primitive, u, v));
         });
}

}  // namespace aisle::sim
