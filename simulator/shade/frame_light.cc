#include "simulator/shade/frame_light.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <numbers>

#include "simulator/shade/direct_light.h"
#include "simulator/shade/mover_indirect.h"

namespace aisle::sim {
namespace {

/// What the images show of the movers.
struct Seen {
  std::vector<std::uint8_t> records;  ///< 1 where a triangle shows
  std::vector<std::uint32_t> pixels;  ///< by mover
};

Seen FindSeen(std::span<const HitImage> images, std::span<const std::int32_t> bases,
              std::size_t records) {
  Seen seen{std::vector<std::uint8_t>(records), std::vector<std::uint32_t>(bases.size())};
  for (const HitImage& image : images) {
    tbb::parallel_for(0, image.height, [&](int y) {
      const std::size_t row = image.Index(0, y);
      for (std::size_t i = row; i < row + static_cast<std::size_t>(image.width); ++i) {
        const std::uint32_t geometry = image.geometry[i];
        if (geometry == 0 || geometry == kNoGeometry) continue;
        const auto record = static_cast<std::size_t>(bases[geometry - 1]) + image.primitive[i];
        std::atomic_ref(seen.records[record]).store(1, std::memory_order_relaxed);
        std::atomic_ref(seen.pixels[geometry - 1]).fetch_add(1, std::memory_order_relaxed);
      }
    });
  }
  return seen;
}

/// Rays from each point of a mover.
struct PointRays {
  int to_lights, to_bodies;
};

/// Many where a point stands for many pixels, few where the errors of neighbours fall into one
/// pixel.
PointRays RaysFor(std::size_t pixels, std::size_t points) {
  if (pixels >= 96 * points) return {.to_lights = 64, .to_bodies = 16};
  if (pixels >= 32 * points) return {.to_lights = 48, .to_bodies = 16};
  if (pixels >= 8 * points) return {.to_lights = 24, .to_bodies = 8};
  return {.to_lights = 12, .to_bodies = 8};
}

/// The bits of x with a zero before each.
std::uint32_t Spread(std::uint32_t x) {
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

constexpr float kFacings = 8;  // cells along each side of the unfolded sphere

/// Orders points so that the eight of a packet face alike: they deal out their rays to the lamps
/// together, and a point that faced another lamp than the rest would be left with few. Within a
/// facing the mesh's order, in which neighbours are near, stays.
void SortByFacing(std::span<const SurfacePoint> places, std::vector<std::uint32_t>* points) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
  for (const std::uint32_t point : *points) {
    // The unit sphere folded to a square (octahedral map), along a Z-order curve.
    const Eigen::Vector3f n =
        places[point].normal / std::max(places[point].normal.lpNorm<1>(), 1e-6f);
    const Eigen::Vector2f folded(std::copysign(1 - std::abs(n.y()), n.x()),
                                 std::copysign(1 - std::abs(n.x()), n.y()));
    const Eigen::Vector2f at = n.z() < 0 ? folded : Eigen::Vector2f(n.head<2>());
    const Eigen::Vector2f cell = (at.array() + 1).matrix() * (kFacings / 2);
    order.emplace_back(
        Spread(static_cast<std::uint32_t>(std::clamp(cell.x(), 0.0f, kFacings - 1))) |
            Spread(static_cast<std::uint32_t>(std::clamp(cell.y(), 0.0f, kFacings - 1))) << 1,
        point);
  }
  std::ranges::sort(order);
  for (std::size_t i = 0; i < order.size(); ++i) (*points)[i] = order[i].second;
}

/// Gives points that were not lit the mean of the lit ones of their triangle, or of the body: an
/// antialiasing ray may meet a triangle that no pixel centre does.
void FillUnlit(const LightGrid& grid, const TriangleMesh& mesh, std::vector<float>* light) {
  constexpr float kUnlit = -1;
  double sum = 0, count = 0;
  for (const float value : *light) {
    if (value != kUnlit) sum += value, count += 1;
  }
  const float mean = count > 0 ? static_cast<float>(sum / count) : 0;
  std::vector<float> filled = *light;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const LightPatch& patch = grid.patches[i];
    const auto slot = static_cast<std::size_t>(patch.slot);
    float near = 0, lit = 0;
    const std::array<std::size_t, 3> corners = {slot, slot + 1,
                                                slot + static_cast<std::size_t>(patch.pitch)};
    for (const std::size_t corner : corners) {
      const std::uint32_t point = grid.point_of_slot[corner];
      if (point < LightGrid::kExtrapolated && (*light)[point] != kUnlit) {
        near += (*light)[point];
        lit += 1;
      }
    }
    for (const std::size_t corner : corners) {
      const std::uint32_t point = grid.point_of_slot[corner];
      if (point < LightGrid::kExtrapolated && filled[point] == kUnlit && lit > 0) {
        filled[point] = near / lit;
      }
    }
  }
  for (float& value : filled) value = value == kUnlit ? mean : value;
  *light = std::move(filled);
}

}  // namespace

SurfaceTables::SurfaceTables(const World& world, const LightGrid& static_grid, float mover_texel_m)
    : world_(&world) {
  const TriangleMesh& mesh = world.statics().mesh;
  statics_ = MakeSurfaceTable(mesh, mesh.positions, static_grid.patches, world.materials());
  const auto is_glossy = [](const SurfaceRecord& record) { return record.f0 > 0; };
  for (std::size_t i = 0; i < world.mover_meshes().size(); ++i) {
    const TriangleMesh& mover = world.mover_meshes()[i];
    LightGrid grid = MakeLightGrid(mover, mover_texel_m);
    mover_bases_.push_back(static_cast<std::int32_t>(mover_records_.size()));
    slot_bases_.push_back(slot_count_);
    for (SurfaceRecord record :
         MakeSurfaceTable(mover, mover.positions, grid.patches, world.materials())) {
      record.light.slot += static_cast<std::int32_t>(slot_count_);
      mover_records_.push_back(record);
    }
    slot_count_ += grid.point_of_slot.size();
    mover_grids_.push_back(std::move(grid));
  }
  has_normal_maps_ = std::ranges::any_of(
      world.materials(), [](const Material& material) { return material.normal_texture >= 0; });
  glossy_ =
      std::ranges::any_of(statics_, is_glossy) || std::ranges::any_of(mover_records_, is_glossy);
}

MeshPlace SurfaceTables::PlaceOf(const Instant& instant, const HitImage& image,
                                 std::size_t pixel) const {
  const std::uint32_t geometry = image.geometry[pixel], triangle = image.primitive[pixel];
  const float u = image.u[pixel], v = image.v[pixel];
  if (geometry == 0) {
    const TriangleMesh& mesh = world_->statics().mesh;
    return {mesh, mesh.positions, mesh.normals, triangle, u, v};
  }
  const MoverState& state = instant.snapshot().movers[geometry - 1];
  return {world_->mover_meshes()[geometry - 1], state.positions, state.normals, triangle, u, v};
}

void SurfaceTables::LightMover(const Instant& instant, std::size_t mover, const LightVolume& volume,
                               std::span<const std::uint8_t> visible, std::size_t pixels,
                               std::span<float> slots) const {
  const MoverState& state = instant.snapshot().movers[mover];
  const TriangleMesh& mesh = world_->mover_meshes()[mover];
  const LightGrid& grid = mover_grids_[mover];
  std::vector<std::uint8_t> wanted(grid.points.size());
  for (std::size_t i = 0; i < visible.size(); ++i) {
    if (!visible[i]) continue;
    const auto first = static_cast<std::size_t>(grid.patches[i].slot);
    const std::size_t end = i + 1 < grid.patches.size()
                                ? static_cast<std::size_t>(grid.patches[i + 1].slot)
                                : grid.point_of_slot.size();
    for (std::size_t slot = first; slot < end; ++slot) {
      const std::uint32_t point = grid.point_of_slot[slot];
      if (point < LightGrid::kExtrapolated) wanted[point] = 1;
    }
  }
  std::vector<std::uint32_t> points;
  for (std::uint32_t i = 0; i < wanted.size(); ++i) {
    if (wanted[i]) points.push_back(i);
  }
  if (points.empty()) return;
  const PointRays rays = RaysFor(pixels, points.size());
  const std::vector<SurfacePoint> places = LocatePoints(grid, mesh, state.positions, state.normals);
  SortByFacing(places, &points);
  const MoverIndirect indirect(instant, world_->lights(), volume, mover, rays.to_bodies);
  std::vector<float> light(grid.points.size(), -1);
  tbb::parallel_for(std::size_t{0}, (points.size() + kLanes - 1) / kLanes, [&](std::size_t i) {
    const std::span packet = std::span(points).subspan(i * kLanes);
    const std::size_t count = std::min<std::size_t>(kLanes, packet.size());
    std::array<SurfacePoint, kLanes> eight;
    for (std::size_t k = 0; k < count; ++k) eight[k] = places[packet[k]];
    const auto direct = SampleDirectLight(
        instant, world_->lights(), instant.snapshot().light_scale, std::span(eight).first(count),
        {.samples = rays.to_lights, .turn = static_cast<std::uint32_t>(i)});
    for (std::size_t k = 0; k < count; ++k) {
      light[packet[k]] = direct[k] + indirect.At(eight[k]);
    }
  });
  FillUnlit(grid, mesh, &light);
  FillSlots(grid, light, slots);
}

void SurfaceTables::PrepareFrame(const Instant& instant, std::span<const HitImage> images,
                                 std::shared_ptr<const LightState> statics,
                                 FrameLight* frame) const {
  frame->statics = std::move(statics);
  if (frame->mover_records.size() != mover_records_.size()) frame->mover_records = mover_records_;
  frame->mover_light.assign(slot_count_, 0);
  const std::size_t movers = instant.snapshot().movers.size();
  if (movers == 0) return;
  const Seen all_seen = FindSeen(images, mover_bases_, mover_records_.size());
  for (std::size_t i = 0; i < movers; ++i) {
    const auto base = static_cast<std::size_t>(mover_bases_[i]);
    const std::size_t triangles = world_->mover_meshes()[i].triangles.size();
    const std::span records = std::span(frame->mover_records).subspan(base, triangles);
    const auto seen = std::span(all_seen.records).subspan(base, triangles);
    if (all_seen.pixels[i] == 0) continue;
    PoseSurfaceTable(world_->mover_meshes()[i], instant.snapshot().movers[i].positions, records);
    LightMover(instant, i, frame->statics->volume, seen, all_seen.pixels[i] / images.size(),
               std::span(frame->mover_light)
                   .subspan(slot_bases_[i], mover_grids_[i].point_of_slot.size()));
  }
}

SurfaceLanes LookUpHits(const SurfaceTables& tables, const FrameLight& frame,
                        const TexturePool& textures, I8 geometry, I8 primitive, HitLanes hits,
                        const RayStep& step) {
  const I8 is_static = geometry == 0, is_mover = geometry > 0;  // "nothing" is -1
  SurfaceLanes result{Wide(0), Wide(0)};
  const auto look_up = [&](I8 mask, I8 record, const Surfaces& surfaces) {
    HitLanes lanes = hits;
    lanes.t = Select(mask, hits.t, Wide(0));
    lanes.u = Select(mask, hits.u, Wide(0));
    lanes.v = Select(mask, hits.v, Wide(0));
    // Idle lanes read a triangle that is in the cache anyway.
    int any = 0;
    while (!mask[any]) ++any;
    lanes.record = mask ? record : WideInt(record[any]);
    const SurfaceLanes found = LookUp(surfaces, textures, lanes, step);
    result.reflectance = Select(mask, found.reflectance, result.reflectance);
    result.irradiance = Select(mask, found.irradiance, result.irradiance);
  };
  if (Any(is_static)) {
    look_up(is_static, primitive, {tables.statics().data(), frame.statics->total.data()});
  }
  if (Any(is_mover)) {
    const I8 base = GatherInt(tables.mover_bases().data(), is_mover ? geometry - 1 : I8{});
    look_up(is_mover, primitive + base, {frame.mover_records.data(), frame.mover_light.data()});
  }
  return result;
}

F8 RadianceOfHits(const SurfaceTables& tables, const FrameLight& frame, const TexturePool& textures,
                  const F8x3& directions, const Hits8& hits, const RayStep& step) {
  const SurfaceLanes seen = LookUpHits(
      tables, frame, textures, LoadI(hits.geometry), LoadI(hits.primitive),
      {LoadF(hits.t), LoadF(hits.u), LoadF(hits.v), directions.x, directions.y, directions.z, I8{}},
      step);
  return seen.reflectance * seen.irradiance * std::numbers::inv_pi_v<float>;
}

}  // namespace aisle::sim
