#include "simulator/truth/image_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "simulator/common/parallel.h"
#include "simulator/truth/surface_velocity.h"

namespace aisle::sim {

namespace {

/// Moments at which the rig is looked at, evenly from first to last: a swing of up to four to and
/// fro is seen as such.
constexpr int kMoments = 9;

/// Shares of the strength by which a light may differ and be the same.
constexpr float kSameLight = 0.01F;

bool IsSameLight(const Snapshot& a, const Snapshot& b) {
  const auto same = [](float x, float y) {
    return std::abs(x - y) <= kSameLight * std::max(std::abs(x), std::abs(y));
  };
  return std::ranges::equal(a.light_scale, b.light_scale, same) &&
         std::ranges::equal(a.beams, b.beams,
                            [&](const Beam& x, const Beam& y) { return same(x.power, y.power); });
}

/// By how much the beam that turns most has turned, radians.
double LargestTurn(const Snapshot& a, const Snapshot& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.beams.size(); ++i) {
    const Eigen::Vector3d from = a.beams[i].toward.cast<double>();
    const Eigen::Vector3d to = b.beams[i].toward.cast<double>();
    largest = std::max(largest, std::atan2(from.cross(to).norm(), from.dot(to)));
  }
  return largest;
}

}  // namespace

double LightMotion(const World& world, const Snapshot& now, const StereoCamera& camera,
                   double duration_s) {
  const std::int64_t half_ns = std::llround(0.5e9 * duration_s);
  double turn_rad = 0;
  for (const std::int64_t offset_ns : {-half_ns, half_ns}) {
    const Snapshot then = world.Near(now, offset_ns);
    if (!IsSameLight(now, then)) return std::numeric_limits<double>::infinity();
    turn_rad += LargestTurn(now, then);
  }
  return camera.fx * turn_rad;
}

double ImageMotion(const World& world, const Instant& instant, const StereoCamera& camera,
                   const CameraView& view, const HitImage& hits, const RigAround& rig_at,
                   double duration_s) {
  constexpr int kEvery = 4;  // pixels
  constexpr double kShare = 0.995;
  constexpr double kNear = 1e-3;  // m in front of the camera
  std::array<double, kMoments> offsets_s;
  std::array<Eigen::Isometry3d, kMoments> T_rig_world;
  for (std::size_t k = 0; k < kMoments; ++k) {
    offsets_s[k] = duration_s * (static_cast<double>(k) / (kMoments - 1) - 0.5);
    T_rig_world[k] = rig_at(offsets_s[k]).inverse();
  }
  const Projection project(camera);
  std::vector<std::vector<float>> rows(static_cast<std::size_t>((hits.height - 1) / kEvery + 1));
  ParallelFor(std::size_t{0}, rows.size(), [&](std::size_t row) {
    const int y = static_cast<int>(row) * kEvery;
    for (int x = 0; x < hits.width; x += kEvery) {
      const std::size_t i = hits.Index(x, y);
      if (hits.geometry[i] == kNoGeometry) continue;
      const double z = hits.t[i];
      const Eigen::Vector2d ray = view.rays->At(x, y).cast<double>();
      const Eigen::Vector3d point = view.T_world_camera * Eigen::Vector3d(z * ray.homogeneous());
      const Eigen::Vector3d velocity =
          SurfaceVelocity(world, instant.snapshot(), hits, i).cast<double>();
      std::optional<Eigen::Vector2d> before;
      double way_px = 0;
      bool is_seen = true;
      for (std::size_t k = 0; k < kMoments && is_seen; ++k) {
        const Eigen::Vector3d in_rig =
            T_rig_world[k] * Eigen::Vector3d(point + offsets_s[k] * velocity);
        const std::optional<Eigen::Vector2d> at =
            in_rig.z() < kNear ? std::nullopt : project(in_rig);
        is_seen = at.has_value();
        if (is_seen && before) way_px += (*at - *before).norm();
        before = at;
      }
      if (is_seen) rows[row].push_back(static_cast<float>(way_px));
    }
  });
  std::vector<float> motions;
  for (const std::vector<float>& row : rows) motions.insert(motions.end(), row.begin(), row.end());
  if (motions.empty()) return 0;
  const auto at = motions.begin() +
                  static_cast<std::ptrdiff_t>(kShare * static_cast<double>(motions.size() - 1));
  std::ranges::nth_element(motions, at);
  return *at;
}

}  // namespace aisle::sim
