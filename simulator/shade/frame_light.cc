#include "simulator/shade/frame_light.h"

#include <tbb/parallel_for.h>

#include <atomic>

#include "simulator/shade/direct_light.h"
#include "simulator/shade/hemisphere.h"

namespace aisle::sim {
namespace {

constexpr float kUntracedShare = 0.08f;
constexpr float kClusterSize = 0.06f;    // m: points nearer than this share their shadow rays
constexpr float kBodyReach = 1.0f;       // m: how far a body darkens itself
constexpr float kBodyReflection = 0.3f;  // what the blocking parts send on in turn

/// Share of the hemisphere over each point that the mover's own bind pose leaves open.
std::vector<float> OpennessOf(const Tracer& tracer, const World& world, std::size_t mover,
                              const LightGrid& grid) {
  const TriangleMesh& mesh = world.mover_meshes()[mover];
  Snapshot bind;
  for (const TriangleMesh& each : world.mover_meshes()) {
    bind.movers.push_back(
        {.instance = 0, .positions = each.positions, .normals = each.normals, .velocities = {}});
  }
  const Instant instant = tracer.Pose(std::move(bind));
  const std::vector<SurfacePoint> points = LocatePoints(grid, mesh, mesh.positions, mesh.normals);
  const std::vector<Eigen::Vector3f> directions = CosineDirections(64);
  std::vector<float> openness(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const Eigen::Matrix3f basis = BasisAround(points[i].normal);
    Rays8 rays;
    int blocked = 0;
    for (std::size_t d = 0; d < directions.size(); d += kLanes) {
      for (std::size_t k = 0; k < kLanes; ++k) {
        SetRay(points[i].position, basis * directions[d + k], kBodyReach, static_cast<int>(k),
               &rays);
      }
      blocked += std::popcount(instant.Occluded(rays, Coherence::kIncoherent, MoverBit(mover)));
    }
    const float share = static_cast<float>(blocked) / static_cast<float>(directions.size());
    openness[i] = 1 - share * (1 - kBodyReflection);
  });
  return openness;
}

/// Which triangles of which mover the images show: a byte a record.
std::vector<std::uint8_t> VisibleRecords(std::span<const HitImage> images,
                                         std::span<const std::int32_t> bases, std::size_t count) {
  std::vector<std::uint8_t> visible(count);
  for (const HitImage& image : images) {
    tbb::parallel_for(0, image.height, [&](int y) {
      const std::size_t row = image.Index(0, y);
      for (std::size_t i = row; i < row + static_cast<std::size_t>(image.width); ++i) {
        const std::uint32_t geometry = image.geometry[i];
        if (geometry == 0 || geometry == kNoGeometry) continue;
        const auto record = static_cast<std::size_t>(bases[geometry - 1]) + image.primitive[i];
        std::atomic_ref(visible[record]).store(1, std::memory_order_relaxed);
      }
    });
  }
  return visible;
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

SurfaceTables::SurfaceTables(const World& world, const Tracer& tracer, const LightGrid& static_grid,
                             float mover_texel_m)
    : world_(&world) {
  const TriangleMesh& mesh = world.statics().mesh;
  statics_ = MakeSurfaceTable(mesh, mesh.positions, static_grid.patches, world.materials());
  const auto glossy = [&](std::uint16_t material) {
    return FinishOf(world.materials()[material]).f0 > 0;
  };
  if (std::ranges::any_of(mesh.materials, glossy)) {
    for (const std::uint16_t material : mesh.materials) {
      finishes_.push_back(FinishOf(world.materials()[material]));
    }
  }
  for (std::size_t i = 0; i < world.mover_meshes().size(); ++i) {
    const TriangleMesh& mover = world.mover_meshes()[i];
    MoverGrid own;
    own.grid = MakeLightGrid(mover, mover_texel_m);
    own.openness = OpennessOf(tracer, world, i, own.grid);
    own.group = GroupsOf(LocatePoints(own.grid, mover, mover.positions, mover.normals),
                         {.cell_m = kClusterSize});
    mover_bases_.push_back(static_cast<std::int32_t>(mover_records_.size()));
    slot_bases_.push_back(slot_count_);
    for (SurfaceRecord record :
         MakeSurfaceTable(mover, mover.positions, own.grid.patches, world.materials())) {
      record.light.slot += static_cast<std::int32_t>(slot_count_);
      mover_records_.push_back(record);
    }
    slot_count_ += own.grid.point_of_slot.size();
    movers_.push_back(std::move(own));
  }
}

void SurfaceTables::LightMover(const Instant& instant, std::size_t mover, const LightVolume& volume,
                               std::span<const std::uint8_t> visible,
                               std::span<float> slots) const {
  const MoverState& state = instant.snapshot().movers[mover];
  const TriangleMesh& mesh = world_->mover_meshes()[mover];
  const LightGrid& grid = movers_[mover].grid;
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
  // The first seen point of a group leads it: the group's others may lie in a layer of clothes
  // below, where no light comes.
  constexpr std::uint32_t kNobody = 0xffffffffu;
  std::vector<std::uint32_t> leader_of_group(wanted.size(), kNobody), leader(wanted.size());
  std::vector<std::uint32_t> points, leaders;
  for (std::uint32_t i = 0; i < wanted.size(); ++i) {
    if (!wanted[i]) continue;
    points.push_back(i);
    std::uint32_t& lead = leader_of_group[movers_[mover].group[i]];
    if (lead == kNobody) leaders.push_back(lead = i);
    leader[i] = lead;
  }
  if (points.empty()) return;
  const std::vector<SurfacePoint> places = LocatePoints(grid, mesh, state.positions, state.normals);
  std::vector<DirectLight> direct(grid.points.size());
  tbb::parallel_for(std::size_t{0}, (leaders.size() + kLanes - 1) / kLanes, [&](std::size_t i) {
    const std::size_t first = i * kLanes;
    const std::size_t count = std::min<std::size_t>(kLanes, leaders.size() - first);
    std::array<SurfacePoint, kLanes> eight;
    for (std::size_t k = 0; k < count; ++k) eight[k] = places[leaders[first + k]];
    // Many lamps and small bodies: steps of a quarter lamp are lost among them.
    const auto light = GatherDirectLight(instant, world_->lights(), instant.snapshot().light_scale,
                                         std::span(eight).first(count),
                                         {.untraced_share = kUntracedShare, .refine = false});
    for (std::size_t k = 0; k < count; ++k) direct[leaders[first + k]] = light[k];
  });

  std::vector<float> light(grid.points.size(), -1);
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const std::uint32_t point = points[i];
    const SurfacePoint& place = places[point];
    const DirectLight& lead = direct[leader[point]];
    // To first order in how the normals differ.
    const float turned = (place.normal - places[leader[point]].normal).dot(lead.vector);
    light[point] = std::max(0.0f, lead.irradiance + turned) +
                   movers_[mover].openness[point] * volume.Irradiance(place.position, place.normal);
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
  const std::vector<std::uint8_t> visible =
      VisibleRecords(images, mover_bases_, mover_records_.size());
  for (std::size_t i = 0; i < movers; ++i) {
    const auto base = static_cast<std::size_t>(mover_bases_[i]);
    const std::size_t triangles = world_->mover_meshes()[i].triangles.size();
    const std::span records = std::span(frame->mover_records).subspan(base, triangles);
    const auto seen = std::span(visible).subspan(base, triangles);
    if (std::ranges::find(seen, 1) == seen.end()) continue;
    PoseSurfaceTable(world_->mover_meshes()[i], instant.snapshot().movers[i].positions, records);
    LightMover(instant, i, frame->statics->volume, seen,
               std::span(frame->mover_light)
                   .subspan(slot_bases_[i], movers_[i].grid.point_of_slot.size()));
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

}  // namespace aisle::sim
