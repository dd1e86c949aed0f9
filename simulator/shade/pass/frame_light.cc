#include "simulator/shade/pass/frame_light.h"

#include <atomic>
#include <numbers>

#include "simulator/common/parallel.h"

namespace aisle::sim {
namespace {

/// 1 for each of the movers' triangles that shows in an image.
std::vector<std::uint8_t> FindSeen(std::span<const HitImage> images,
                                   std::span<const std::int32_t> bases, std::size_t records) {
  std::vector<std::uint8_t> seen(records);
  for (const HitImage& image : images) {
    ParallelFor(0, image.height, [&](int y) {
      const std::size_t row = image.Index(0, y);
      for (std::size_t i = row; i < row + static_cast<std::size_t>(image.width); ++i) {
        const std::uint32_t geometry = image.geometry[i];
        if (geometry == 0 || geometry == kNoGeometry) continue;
        const auto record = static_cast<std::size_t>(bases[geometry - 1]) + image.primitive[i];
        std::atomic_ref(seen[record]).store(1, std::memory_order_relaxed);
      }
    });
  }
  return seen;
}

/// Points of the triangles that show and of those around them, which an antialiasing ray may meet
/// though no pixel centre does: 1 by point.
std::vector<std::uint8_t> PointsOf(const LightGrid& grid, const TriangleMesh& mesh,
                                   std::span<const std::uint8_t> seen) {
  std::vector<std::uint8_t> near(mesh.positions.size()), wanted(grid.points.size());
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (!seen[i]) continue;
    for (const std::uint32_t vertex : mesh.triangles[i]) near[vertex] = 1;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    if (!near[a] && !near[b] && !near[c]) continue;
    const auto first = static_cast<std::size_t>(grid.patches[i].slot);
    const std::size_t end = i + 1 < grid.patches.size()
                                ? static_cast<std::size_t>(grid.patches[i + 1].slot)
                                : grid.point_of_slot.size();
    for (std::size_t slot = first; slot < end; ++slot) {
      const std::uint32_t point = grid.point_of_slot[slot];
      if (point < LightGrid::kExtrapolated) wanted[point] = 1;
    }
  }
  return wanted;
}

/// A few, spread over a body of which hardly anything shows: 1 by point.
std::vector<std::uint8_t> SomePoints(const LightGrid& grid) {
  constexpr std::size_t kPoints = 8;
  std::vector<std::uint8_t> wanted(grid.points.size());
  const std::size_t count = std::min(kPoints, wanted.size());
  for (std::size_t i = 0; i < count; ++i) wanted[i * wanted.size() / count] = 1;
  return wanted;
}

/// Gives points that were not lit the mean of those that were: an antialiasing ray hardly ever
/// meets one.
void FillUnlit(std::vector<float>* light) {
  double sum = 0, count = 0;
  for (const float value : *light) {
    if (value >= 0) sum += value, count += 1;
  }
  const float mean = count > 0 ? static_cast<float>(sum / count) : 0;
  for (float& value : *light) value = value < 0 ? mean : value;
}

/// The size of a pixel at the mover's nearest point, in metres.
float PixelOn(const Eigen::AlignedBox3f& box, std::span<const CameraView> views) {
  float size = kInfinity;
  for (const CameraView& view : views) {
    size = std::min(size, view.rays->step_x * box.exteriorDistance(view.origin));
  }
  return size;
}

}  // namespace

SurfaceTables::SurfaceTables(const World& world, const LightGrid& static_grid, float mover_texel_m)
    : world_(&world) {
  const TriangleMesh& mesh = world.statics().mesh;
  statics_ = MakeSurfaceTable(mesh, mesh.positions, static_grid.patches, world.materials(),
                              Luminaires::kShine);
  const auto is_glossy = [](const SurfaceRecord& record) { return record.f0 > 0; };
  for (std::size_t i = 0; i < world.mover_meshes().size(); ++i) {
    const TriangleMesh& mover = world.mover_meshes()[i];
    LightGrid grid = MakeLightGrid(mover, mover_texel_m);
    mover_bases_.push_back(static_cast<std::int32_t>(mover_records_.size()));
    slot_bases_.push_back(slot_count_);
    for (SurfaceRecord record : MakeSurfaceTable(mover, mover.positions, grid.patches,
                                                 world.materials(), Luminaires::kReflect)) {
      record.light.slot += static_cast<std::int32_t>(slot_count_);
      mover_records_.push_back(record);
    }
    slot_count_ += grid.point_of_slot.size();
    mover_grids_.push_back(std::move(grid));
  }
  const auto is_mapped = [](const Material& material) { return material.normal_texture >= 0; };
  has_normal_maps_ = std::ranges::any_of(world.materials(), is_mapped);
  statics_have_normal_maps_ = std::ranges::any_of(
      mesh.materials, [&](const auto material) { return is_mapped(world.materials()[material]); });
  const auto glows = [&](const TriangleMesh& mover) {
    return std::ranges::any_of(mover.materials, [&](const auto material) {
      return world.materials()[material].emission > 0;
    });
  };
  movers_glow_ = std::ranges::any_of(world.mover_meshes(), glows);
  mover_light_ = std::make_unique<MoverLight>(world, mover_grids_, MoverLightOptions{});
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

void SurfaceTables::PrepareFrame(const Instant& instant, std::span<const CameraView> views,
                                 std::span<const HitImage> images,
                                 std::shared_ptr<const LightState> statics, FrameLight* frame,
                                 std::span<const Hits8> beyond) const {
  frame->statics = std::move(statics);
  if (frame->mover_records.size() != mover_records_.size()) frame->mover_records = mover_records_;
  frame->mover_light.resize(slot_count_);
  const std::size_t movers = instant.snapshot().movers.size();
  if (movers == 0) return;
  GeometryMask in_view = 0;
  for (const HitImage& image : images) in_view |= image.movers.In(0, 0, image.width, image.height);
  std::vector<std::uint8_t> all_seen = FindSeen(images, mover_bases_, mover_records_.size());
  for (const Hits8& hits : beyond) {
    for (int k = 0; k < kLanes; ++k) {
      if (hits.geometry[k] == 0 || hits.geometry[k] == kNoGeometry) continue;
      all_seen[static_cast<std::size_t>(mover_bases_[hits.geometry[k] - 1]) + hits.primitive[k]] =
          1;
    }
  }
  // Movers side by side: much of the work on a small one is too little to be split.
  ParallelFor(std::size_t{0}, movers, [&](std::size_t i) {
    const auto base = static_cast<std::size_t>(mover_bases_[i]);
    const std::size_t triangles = world_->mover_meshes()[i].triangles.size();
    const std::span records = std::span(frame->mover_records).subspan(base, triangles);
    const auto seen = std::span(all_seen).subspan(base, triangles);
    const std::span slots =
        std::span(frame->mover_light).subspan(slot_bases_[i], mover_grids_[i].point_of_slot.size());
    const TriangleMesh& mesh = world_->mover_meshes()[i];
    const bool shows = std::ranges::find(seen, 1) != seen.end();
    // Antialiasing rays may meet what no pixel's centre shows; nothing meets what is out of view.
    if (!shows && !(in_view & MoverBit(i))) return;
    PoseSurfaceTable(mesh, instant.snapshot().movers[i].positions, records);
    const std::vector<std::uint8_t> wanted =
        shows ? PointsOf(mover_grids_[i], mesh, seen) : SomePoints(mover_grids_[i]);
    std::vector<float> light = mover_light_->At(instant, i, frame->statics->volume, wanted,
                                                PixelOn(instant.mover_boxes()[i], views));
    FillUnlit(&light);
    FillSlots(mover_grids_[i], light, slots);
  });
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

F8 GlowOfHits(const SurfaceTables& tables, I8 geometry, I8 primitive) {
  F8 glow = Wide(0);
  if (!tables.movers_glow()) return glow;
  for (int k = 0; k < kLanes; ++k) {
    if (geometry[k] <= 0) continue;  // the static world, or nothing
    const TriangleMesh& mesh =
        tables.world().mover_meshes()[static_cast<std::size_t>(geometry[k]) - 1];
    glow[k] =
        tables.world().materials()[mesh.materials[static_cast<std::size_t>(primitive[k])]].emission;
  }
  return glow;
}

F8 RadianceOfHits(const SurfaceTables& tables, const FrameLight& frame, const TexturePool& textures,
                  const F8x3& directions, const Hits8& hits, const RayStep& step) {
  const I8 geometry = LoadI(hits.geometry), primitive = LoadI(hits.primitive);
  const SurfaceLanes seen = LookUpHits(
      tables, frame, textures, geometry, primitive,
      {LoadF(hits.t), LoadF(hits.u), LoadF(hits.v), directions.x, directions.y, directions.z, I8{}},
      step);
  return seen.reflectance * seen.irradiance * std::numbers::inv_pi_v<float> +
         GlowOfHits(tables, geometry, primitive);
}

}  // namespace aisle::sim
