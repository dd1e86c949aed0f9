#include "simulator/shade/light/radiosity.h"

#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/lanes/hemisphere.h"

namespace aisle::sim {
namespace {

constexpr std::uint32_t kDark = 0xffffffffu;  // the ray met nothing, or the back of something
constexpr float kPi = std::numbers::pi_v<float>;

/// The radiosity of a patch.
float LeavingOf(const Patches& patches, const Radiosity& light, std::size_t patch) {
  return patches.albedo[patch] * (light.direct[patch] + light.indirect[patch]) +
         patches.emitted[patch];
}

/// Which patch each ray of a patch meets. Eight neighbouring patches shoot in the same local
/// direction together, so that their paths are alike.
void FindPartners(const Instant& statics, const LightGrid& grid, const Patches& patches,
                  std::span<const Eigen::Vector3f> directions, std::size_t first,
                  std::span<std::uint32_t> partners) {
  const std::size_t count = std::min<std::size_t>(kLanes, patches.places.size() - first);
  std::array<Eigen::Matrix3f, kLanes> basis;
  for (std::size_t k = 0; k < count; ++k) basis[k] = BasisAround(patches.places[first + k].normal);
  Rays8 rays;
  Hits8 hits;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const std::size_t p = std::min(k, count - 1);
      SetRay(patches.places[first + p].position, basis[p] * directions[d], kInfinity,
             static_cast<int>(k), &rays);
    }
    statics.Intersect(rays, Coherence::kCoherent, kStaticOnly, &hits);
    for (std::size_t k = 0; k < count; ++k) {
      std::uint32_t partner = kDark;
      if (hits.geometry[k] == 0) {
        partner = patches.of_point[NearestPoint(grid, hits.primitive[k], hits.u[k], hits.v[k])];
        const Eigen::Vector3f direction(rays.dx[k], rays.dy[k], rays.dz[k]);
        if (patches.places[partner].normal.dot(direction) > 0) partner = kDark;
      }
      partners[(first + k) * directions.size() + d] = partner;
    }
  }
}

}  // namespace

Patches MakePatches(std::span<const std::uint32_t> things, std::span<const SurfacePoint> points,
                    const Leaving& leaving) {
  // Patches cost rays, points next to nothing: of many points each patch takes more.
  constexpr float kCell = 0.33f, kFewPoints = 750'000;
  const float cell =
      kCell * std::max(1.0f, std::sqrt(static_cast<float>(points.size()) / kFewPoints));
  const std::vector<std::uint32_t> leaders =
      GroupsOf(points, things, {.cell_m = cell, .normal_steps = 3, .plane_m = 0.12f * cell});
  Patches patches;
  std::vector<float> members;
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint32_t patch;
    if (leaders[i] == i) {
      patch = static_cast<std::uint32_t>(patches.places.size());
      patches.places.push_back(points[i]);
      patches.albedo.push_back(0);
      patches.emitted.push_back(0);
      members.push_back(0);
    } else {
      patch = patches.of_point[leaders[i]];
    }
    patches.of_point.push_back(patch);
    patches.albedo[patch] += leaving.albedo[i];
    patches.emitted[patch] += leaving.emitted[i];
    members[patch] += 1;
  }
  for (std::size_t i = 0; i < members.size(); ++i) {
    patches.albedo[i] /= members[i];
    patches.emitted[i] /= members[i];
  }
  return patches;
}

std::vector<std::uint32_t> PatchesOf(const LightGrid& fine, const LightGrid& coarse,
                                     const Patches& patches) {
  std::vector<std::uint32_t> patch_of;
  patch_of.reserve(fine.points.size());
  for (const LightPoint& point : fine.points) {
    patch_of.push_back(patches.of_point[NearestPoint(coarse, point.triangle, point.u, point.v)]);
  }
  return patch_of;
}

void CentrePatches(std::span<const SurfacePoint> fine, std::span<const std::uint32_t> patch_of,
                   Patches* patches) {
  const std::size_t count = patches->places.size();
  std::vector<Eigen::Vector3f> middle(count, Eigen::Vector3f::Zero());
  std::vector<float> members(count), nearest(count, kInfinity);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    middle[patch_of[i]] += fine[i].position;
    members[patch_of[i]] += 1;
  }
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const std::uint32_t patch = patch_of[i];
    const float away = (fine[i].position - middle[patch] / members[patch]).squaredNorm();
    if (away >= nearest[patch]) continue;
    nearest[patch] = away;
    patches->places[patch] = fine[i];
  }
}

std::vector<float> MeanByPatch(const LightGrid& fine, std::span<const float> values,
                               std::span<const std::uint32_t> patch_of, std::size_t patches) {
  std::vector<float> sum(patches), area(patches);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const LightPoint& point = fine.points[i];
    // A point on an edge of its triangle stands for half a cell of it, one at a corner for a
    // quarter.
    constexpr float kOnEdge = 1e-4f;
    float weight = 1;
    for (const float share : {point.u, point.v, 1 - point.u - point.v}) {
      if (share < kOnEdge) weight *= 0.5f;
    }
    sum[patch_of[i]] += weight * values[i];
    area[patch_of[i]] += weight;
  }
  for (std::size_t i = 0; i < patches; ++i) sum[i] /= std::max(area[i], 1e-9f);
  return sum;
}

Radiosity SolveRadiosity(const Instant& statics, const LightGrid& grid, const Patches& patches,
                         std::vector<float> direct, const RadiosityOptions& options,
                         SolveWatch* watch) {
  const std::size_t count = patches.places.size();
  const std::vector<Eigen::Vector3f> directions = CosineDirections(options.directions);
  std::vector<std::uint32_t> partners(count * directions.size());
  watch->Begin(count);
  ParallelFor(std::size_t{0}, (count + kLanes - 1) / kLanes, [&](std::size_t i) {
    FindPartners(statics, grid, patches, directions, i * kLanes, partners);
    watch->Add(kLanes);
  });

  Radiosity result{.direct = std::move(direct), .indirect = std::vector<float>(count)};
  std::vector<float> leaving(count);
  for (int bounce = 0; bounce < options.bounces; ++bounce) {
    for (std::size_t i = 0; i < count; ++i) {
      leaving[i] = LeavingOf(patches, result, i);
    }
    ParallelFor(std::size_t{0}, count, [&](std::size_t i) {
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
                const Patches& patches, const Radiosity& radiosity, int count, LightVolume* volume,
                SolveWatch* watch) {
  const std::vector<Eigen::Vector3f> directions = SphereDirections(count / kLanes * kLanes);
  watch->Begin(volume->size());
  ParallelFor(std::size_t{0}, volume->size(), [&](std::size_t node) {
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
        const std::uint32_t p =
            patches.of_point[NearestPoint(grid, hits.primitive[k], hits.u[k], hits.v[k])];
        const float radiance = LeavingOf(patches, radiosity, p) / kPi;
        sum.mean += radiance;
        sum.slope += 3 * radiance * directions[d + k];
      }
    }
    const auto n = static_cast<float>(directions.size());
    volume->Set(node, {sum.mean / n, sum.slope / n, backs > 0.25f * n ? 0.0f : 1.0f});
    watch->Add(1);
  });
}

}  // namespace aisle::sim
