#include "simulator/shade/radiosity.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "simulator/shade/hemisphere.h"

namespace aisle::sim {
namespace {

constexpr std::uint32_t kDark = 0xffffffffu;  // the ray met nothing, or the back of something
constexpr float kPi = std::numbers::pi_v<float>;

/// Which point of the grid each ray of a point meets. Eight neighbouring points shoot in the same
/// local direction together, so that their paths are alike.
void FindPartners(const Instant& statics, const LightGrid& grid,
                  std::span<const SurfacePoint> points, std::span<const Eigen::Vector3f> directions,
                  std::size_t first, std::span<std::uint32_t> partners) {
  const std::size_t count = std::min<std::size_t>(kLanes, points.size() - first);
  std::array<Eigen::Matrix3f, kLanes> basis;
  for (std::size_t k = 0; k < count; ++k) basis[k] = BasisAround(points[first + k].normal);
  Rays8 rays;
  Hits8 hits;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::size_t p = std::min(k, count - 1);
      SetRay(points[first + p].position, basis[p] * directions[d], kInfinity, static_cast<int>(k),
             &rays);
    }
    statics.Intersect(rays, Coherence::kCoherent, kStaticOnly, &hits);
    for (std::size_t k = 0; k < count; ++k) {
      std::uint32_t partner = kDark;
      if (hits.geometry[k] == 0) {
        partner = NearestPoint(grid, hits.primitive[k], hits.u[k], hits.v[k]);
        const Eigen::Vector3f direction(rays.dx[k], rays.dy[k], rays.dz[k]);
        if (points[partner].normal.dot(direction) > 0) partner = kDark;
      }
      partners[(first + k) * directions.size() + d] = partner;
    }
  }
}

}  // namespace

Radiosity SolveRadiosity(const Instant& statics, const LightGrid& grid,
                         std::span<const SurfacePoint> points, std::span<const float> albedo,
                         std::vector<float> direct, const RadiosityOptions& options) {
  const std::vector<Eigen::Vector3f> directions = CosineDirections(options.directions);
  std::vector<std::uint32_t> partners(points.size() * directions.size());
  tbb::parallel_for(std::size_t{0}, (points.size() + kLanes - 1) / kLanes, [&](std::size_t i) {
    FindPartners(statics, grid, points, directions, i * kLanes, partners);
  });

  Radiosity result{.direct = std::move(direct), .indirect = std::vector<float>(points.size())};
  std::vector<float> leaving(points.size());
  for (int bounce = 0; bounce < options.bounces; ++bounce) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      leaving[i] = albedo[i] * (result.direct[i] + result.indirect[i]);
    }
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
      float sum = 0;
      for (std::size_t d = 0; d < directions.size(); ++d) {
        const std::uint32_t partner = partners[i * directions.size() + d];
        if (partner != kDark) sum += leaving[partner];
      }
      result.indirect[i] = sum / static_cast<float>(directions.size());
    });
  }
  return result;
}

void FillVolume(const Instant& statics, const LightGrid& grid, const TriangleMesh& mesh,
                std::span<const float> albedo, const Radiosity& radiosity, int count,
                LightVolume* volume) {
  const std::vector<Eigen::Vector3f> directions = SphereDirections(count / kLanes * kLanes);
  tbb::parallel_for(std::size_t{0}, volume->size(), [&](std::size_t node) {
    const Eigen::Vector3f origin = volume->Position(node);
    LightVolume::Node sum;
    float backs = 0;
    Rays8 rays;
    Hits8 hits;
    for (std::size_t d = 0; d < directions.size(); d += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        SetRay(origin, directions[d + k], kInfinity, static_cast<int>(k), &rays);
      }
      statics.Intersect(rays, Coherence::kIncoherent, kStaticOnly, &hits);
      for (std::size_t k = 0; k < kLanes; ++k) {
        if (hits.geometry[k] != 0) continue;
        const auto& [a, b, c] = mesh.triangles[hits.primitive[k]];
        const Eigen::Vector3f normal =
            (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
        if (normal.dot(directions[d + k]) > 0) {
          backs += 1;
          continue;
        }
        const std::uint32_t p = NearestPoint(grid, hits.primitive[k], hits.u[k], hits.v[k]);
        const float radiance = albedo[p] * (radiosity.direct[p] + radiosity.indirect[p]) / kPi;
        sum.mean += radiance;
        sum.slope += 3 * radiance * directions[d + k];
      }
    }
    const auto n = static_cast<float>(directions.size());
    volume->Set(node, {sum.mean / n, sum.slope / n, backs > 0.25f * n ? 0.0f : 1.0f});
  });
}

}  // namespace aisle::sim
