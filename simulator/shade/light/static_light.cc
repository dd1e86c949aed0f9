#include "simulator/shade/light/static_light.h"

#include <tbb/task_arena.h>

#include <atomic>
#include <numbers>

#include "simulator/common/parallel.h"
#include "simulator/shade/light/direct_light.h"
#include "simulator/shade/light/light_cache.h"
#include "simulator/shade/light/radiosity.h"
#include "simulator/shade/surface/gloss.h"
#include "simulator/shade/surface/luminaires.h"

namespace aisle::sim {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
// The faint lamps are the far ones, which racks hide more often than the near: taking them to be as
// visible as these would brighten the racks by this share.
constexpr float kUntracedShare = 0.003f;

LightGrid GridWithin(const TriangleMesh& mesh, float texel, std::size_t max_points) {
  LightGrid grid = MakeLightGrid(mesh, texel);
  // Points fall with the square of the spacing, down to what the vertices need.
  for (int i = 0; i < 8 && grid.points.size() > max_points; ++i) {
    texel *= 1.3f;
    grid = MakeLightGrid(mesh, texel);
  }
  return grid;
}

/// Counts work of one solution and reports each percent.
class Progress {
 public:
  Progress(const std::function<void(double)>& report, std::size_t total)
      : report_(report), total_(std::max<std::size_t>(total, 1)) {}

  void Add(std::size_t work) {
    if (!report_) return;
    const std::size_t before = done_.fetch_add(work);
    if (before * 100 / total_ == (before + work) * 100 / total_) return;
    const std::lock_guard lock(mutex_);
    const double share = static_cast<double>(done_.load()) / static_cast<double>(total_);
    if (share > reported_) report_(reported_ = std::min(share, 1.0));
  }

 private:
  const std::function<void(double)>& report_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
  std::mutex mutex_;  ///< guards reported_ and the call
  double reported_ = 0;
};

std::vector<float> DirectAt(const Instant& statics, const World& world,
                            std::span<const float> light_scale,
                            std::span<const SurfacePoint> points, Progress* progress) {
  std::vector<float> direct(points.size());
  ParallelFor(std::size_t{0}, (points.size() + kLanes - 1) / kLanes, [&](std::size_t i) {
    const std::size_t first = i * kLanes;
    const std::size_t count = std::min<std::size_t>(kLanes, points.size() - first);
    const auto light =
        GatherDirectLight(statics, world.lights(), light_scale, points.subspan(first, count),
                          {.untraced_share = kUntracedShare,
                           .turn = static_cast<std::uint32_t>(first),
                           .occluders = kStaticOnly});
    for (std::size_t k = 0; k < count; ++k) direct[first + k] = light[k];
    progress->Add(count);
  });
  return direct;
}

/// Reflectance around a point, over `texel` metres.
float AlbedoAround(const World& world, const TexturePool& textures, const LightPoint& point,
                   float texel) {
  const TriangleMesh& mesh = world.statics().mesh;
  const Material& material = world.materials()[mesh.materials[point.triangle]];
  const auto& [a, b, c] = mesh.triangles[point.triangle];
  const Eigen::Vector2f uv =
      (1 - point.u - point.v) * mesh.uvs[a] + point.u * mesh.uvs[b] + point.v * mesh.uvs[c];
  const Eigen::Vector2f du = mesh.uvs[b] - mesh.uvs[a], dv = mesh.uvs[c] - mesh.uvs[a];
  const Eigen::Vector3f x = mesh.positions[b] - mesh.positions[a];
  const Eigen::Vector3f y = mesh.positions[c] - mesh.positions[a];
  const float world_area = x.cross(y).norm();
  const float uv_area = std::abs(du.x() * dv.y() - du.y() * dv.x());
  const float width = texel * std::sqrt(uv_area / std::max(world_area, 1e-9f));
  return material.albedo * textures.SampleWide(material.albedo_texture, uv.x(), uv.y(), width);
}

/// Share of diffuse light that a finish's lobe sends back, by Malley's measure 2 c dc of cosines.
float MeanGloss(const Finish& finish) {
  constexpr int kSteps = 64;
  if (finish.f0 <= 0) return 0;
  float sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const float squared = (static_cast<float>(i) + 0.5f) / kSteps;
    sum += GlossShare(finish.f0, finish.roughness, std::sqrt(squared));
  }
  return sum / kSteps;
}

/// What each point of a grid sends on of the light it receives: the diffuse base, and what its lobe
/// mirrors, whose energy must not be lost though radiosity spreads it as if it were diffuse.
std::vector<float> ReflectanceAt(const World& world, const TexturePool& textures,
                                 const LightGrid& grid, float texel) {
  std::vector<float> gloss, reflectance;
  for (const Material& material : world.materials()) gloss.push_back(MeanGloss(FinishOf(material)));
  reflectance.reserve(grid.points.size());
  for (const LightPoint& point : grid.points) {
    const float mirrored = gloss[world.statics().mesh.materials[point.triangle]];
    reflectance.push_back((1 - mirrored) * AlbedoAround(world, textures, point, texel) + mirrored);
  }
  return reflectance;
}

/// Makes luminaires show their own radiance beside what they reflect: their light is read at
/// reflectance 1, so that the irradiance there becomes albedo · irradiance + π · emission.
void PaintLuminaires(const World& world, const TexturePool& textures, const LightGrid& grid,
                     float texel, std::span<const float> light_scale, LightState* state) {
  const TriangleMesh& mesh = world.statics().mesh;
  for (std::size_t i = 0; i < grid.patches.size(); ++i) {
    const Material& material = world.materials()[mesh.materials[i]];
    if (material.emission <= 0) continue;
    const float emitted = material.emission * kPi * light_scale[NearestLight(world, i)];
    const auto first = static_cast<std::size_t>(grid.patches[i].slot);
    const std::size_t end = i + 1 < grid.patches.size()
                                ? static_cast<std::size_t>(grid.patches[i + 1].slot)
                                : grid.point_of_slot.size();
    float albedo = material.albedo;  // slots beyond the edge have that of the one before them
    for (std::size_t slot = first; slot < end; ++slot) {
      const std::uint32_t point = grid.point_of_slot[slot];
      if (point < LightGrid::kExtrapolated) {
        albedo = AlbedoAround(world, textures, grid.points[point], texel);
      }
      state->total[slot] = emitted + albedo * state->total[slot];
      state->direct[slot] *= albedo;
    }
  }
}

}  // namespace

StaticLight::StaticLight(const World& world, const Tracer& tracer, const TexturePool& textures,
                         const StaticLightOptions& options)
    : world_(&world),
      tracer_(&tracer),
      textures_(&textures),
      options_(options),
      fine_(GridWithin(world.statics().mesh, options.texel_m, options.max_points)),
      coarse_(GridWithin(world.statics().mesh, options.coarse_texel_m, options.max_points / 4)),
      all_on_(world.lights().size(), 1.0f) {
  Solved(all_on_);
}

LightState StaticLight::Solve(std::span<const float> light_scale) const {
  const TriangleMesh& mesh = world_->statics().mesh;
  const Instant statics = tracer_->Pose({});
  const auto locate = [&](const LightGrid& grid) {
    return LocatePoints(grid, mesh, mesh.positions, mesh.normals);
  };
  // Gathering indirect light takes about a third as long as the direct light of the fine grid.
  const std::size_t indirect_work = fine_.points.size() / 3;
  Progress progress(options_.progress, fine_.points.size() + 2 * indirect_work);
  const std::vector<SurfacePoint> places = locate(fine_);
  const std::vector<float> direct = DirectAt(statics, *world_, light_scale, places, &progress);
  LightState state;
  state.direct.resize(fine_.point_of_slot.size());
  FillSlots(fine_, direct, state.direct);

  Patches patches = MakePatches(
      locate(coarse_), ReflectanceAt(*world_, *textures_, coarse_, options_.coarse_texel_m));
  const std::vector<std::uint32_t> patch_of = PatchesOf(fine_, coarse_, patches);
  CentrePatches(places, patch_of, &patches);
  const Radiosity radiosity = SolveRadiosity(
      statics, coarse_, patches, MeanByPatch(fine_, direct, patch_of, patches.places.size()),
      {.directions = options_.directions, .bounces = options_.bounces});
  progress.Add(indirect_work);

  std::vector<float> coarse_indirect;
  for (const std::uint32_t patch : patches.of_point) {
    coarse_indirect.push_back(radiosity.indirect[patch]);
  }
  std::vector<float> coarse_slots(coarse_.point_of_slot.size());
  FillSlots(coarse_, coarse_indirect, coarse_slots);
  std::vector<float> indirect(fine_.points.size());
  ParallelFor(std::size_t{0}, indirect.size(), [&](std::size_t i) {
    const LightPoint& point = fine_.points[i];
    indirect[i] = ReadLight(coarse_.patches[point.triangle], coarse_slots, point.u, point.v);
  });
  state.total.resize(state.direct.size());
  FillSlots(fine_, indirect, state.total);
  for (std::size_t i = 0; i < state.total.size(); ++i) state.total[i] += state.direct[i];
  PaintLuminaires(*world_, *textures_, fine_, options_.texel_m, light_scale, &state);

  state.volume = LightVolume(tracer_->static_box(), options_.volume_spacing_m);
  FillVolume(statics, coarse_, mesh, patches, radiosity, options_.volume_directions, &state.volume);
  progress.Add(indirect_work);
  return state;
}

LightState StaticLight::LoadOrSolve(std::span<const float> light_scale) const {
  if (options_.cache_folder.empty()) return Solve(light_scale);
  const std::uint64_t key = LightKey(*world_, options_, light_scale);
  if (std::optional<LightState> kept =
          LoadLight(options_.cache_folder, key, fine_.point_of_slot.size())) {
    return *std::move(kept);
  }
  LightState state = Solve(light_scale);
  SaveLight(options_.cache_folder, key, state);
  return state;
}

std::shared_ptr<const LightState> StaticLight::Solved(const std::vector<float>& scale) const {
  auto& found = solved_[scale];
  // Isolated: a thread that holds the mutex must not pick up another frame's work while it waits.
  if (!found) {
    tbb::this_task_arena::isolate(
        [&] { found = std::make_shared<LightState>(LoadOrSolve(scale)); });
  }
  return found;
}

std::shared_ptr<const LightState> StaticLight::At(std::span<const float> light_scale) const {
  const std::vector<float> scale(light_scale.begin(), light_scale.end());
  const std::lock_guard lock(mutex_);
  if (scale.empty() || scale == all_on_) return Solved(all_on_);
  if (const auto found = composed_.find(scale); found != composed_.end()) return found->second;

  LightState state = *Solved(all_on_);
  // One solution for each group of lamps dimmed alike: the same few groups serve a whole fade.
  std::map<float, std::vector<float>> groups;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    if (scale[i] == 1) continue;
    auto& group = groups[scale[i]];
    group.resize(scale.size());
    group[i] = 1;
  }
  for (const auto& [dimmed, group] : groups) {
    const std::shared_ptr<const LightState> part = Solved(group);
    const float less = 1 - dimmed;
    const auto subtract = [less](const std::vector<float>& from, std::vector<float>* to) {
      for (std::size_t i = 0; i < to->size(); ++i) {
        (*to)[i] = std::max(0.0f, (*to)[i] - less * from[i]);
      }
    };
    subtract(part->total, &state.total);
    subtract(part->direct, &state.direct);
    for (std::size_t i = 0; i < state.volume.size(); ++i) {
      LightVolume::Node node = state.volume.node(i);
      node.mean -= less * part->volume.node(i).mean;
      node.slope -= less * part->volume.node(i).slope;
      state.volume.Set(i, node);
    }
  }
  constexpr std::size_t kRemembered = 4;  // a fade never comes back to the same setting
  if (composed_.size() > kRemembered) composed_.clear();
  return composed_[scale] = std::make_shared<LightState>(std::move(state));
}

}  // namespace aisle::sim
