#include "simulator/shade/light/static_light.h"

#include <thread>

#include "simulator/common/parallel.h"
#include "simulator/shade/light/direct_light.h"
#include "simulator/shade/light/light_cache.h"
#include "simulator/shade/light/light_lock.h"
#include "simulator/shade/light/radiosity.h"
#include "simulator/shade/light/reflectance.h"
#include "simulator/shade/light/shared_visibility.h"
#include "simulator/shade/light/solve_watch.h"
#include "simulator/shade/light/unfinished_light.h"

namespace aisle::sim {
namespace {

// The faint lamps are the far ones, which racks hide more often than the near: taking them to be as
// visible as these would brighten the racks by this share.
constexpr float kUntracedShare = 0.003f;
/// Shadow rays of a point to all lamps: nobody sees the noise of one leaf among others.
constexpr int kRays = 128, kRaysOfLoose = 32;

/// The grid at the spacing at which the triangles that are larger than it have few enough points:
/// they fall with its square. Smaller ones have points at their vertices, whatever the spacing.
LightGrid GridWithin(const TriangleMesh& mesh, float texel, std::size_t max_points) {
  for (int i = 0; i < 8 && PointsAbout(mesh, texel) > max_points; ++i) texel *= 1.3f;
  return MakeLightGrid(mesh, texel);
}

/// Direct light at places, of which the first so many are fixed, piece by piece; `unfinished`,
/// where there is one, has the first of them already and is given the others.
std::vector<float> TraceDirect(const Instant& statics, const World& world,
                               std::span<const float> light_scale,
                               std::span<const SurfacePoint> places, std::size_t fixed,
                               UnfinishedLight* unfinished, SolveWatch* watch) {
  constexpr std::size_t kPiece = std::size_t{1} << 16;  // some seconds of one processor
  static_assert(kPiece % kLanes == 0, "lanes are filled alike wherever it goes on");
  std::vector<float> direct;
  if (unfinished) direct = unfinished->TakeBegun();
  std::size_t begin = std::min(direct.size(), places.size());
  direct.resize(places.size());
  watch->Begin(places.size());
  watch->Add(begin);
  for (std::size_t end; begin < places.size(); begin = end) {
    end = std::min(places.size(), begin + kPiece);
    ParallelFor(std::size_t{0}, (end - begin + kLanes - 1) / kLanes, [&](std::size_t i) {
      const std::size_t first = begin + i * kLanes;
      const std::size_t count = std::min<std::size_t>(kLanes, end - first);
      const auto light =
          GatherDirectLight(statics, world.lights(), light_scale, places.subspan(first, count),
                            {.untraced_share = kUntracedShare,
                             .rays = first < fixed ? kRays : kRaysOfLoose,
                             .turn = static_cast<std::uint32_t>(first),
                             .occluders = kStaticOnly});
      for (std::size_t k = 0; k < count; ++k) direct[first + k] = light[k];
      watch->Add(count);
    });
    if (unfinished) unfinished->Append(std::span(direct).subspan(begin, end - begin));
  }
  return direct;
}

/// Direct light at the points of a grid, which are at `places`.
std::vector<float> DirectAt(const Instant& statics, const World& world,
                            std::span<const float> light_scale, const LightGrid& grid,
                            const Things& things, std::span<const SurfacePoint> places,
                            UnfinishedLight* unfinished, SolveWatch* watch) {
  const SharedVisibility shared = ShareVisibility(LooseThings(grid, world.statics().mesh, things),
                                                  places, world.lights(), light_scale);
  std::vector<SurfacePoint> traced;
  traced.reserve(shared.traced.size());
  for (const std::uint32_t point : shared.traced) traced.push_back(places[point]);
  return shared.Spread(
      TraceDirect(statics, world, light_scale, traced, shared.fixed, unfinished, watch));
}

/// Light that is taken off other light, and how much of it.
struct Less {
  float share = 0;
  std::shared_ptr<const LightState> light;
};

/// Calls work(begin, end) for pieces of so many numbers, in parallel.
void InPieces(std::size_t count, const auto& work) {
  constexpr std::size_t kPiece = std::size_t{1} << 15;
  ParallelFor(std::size_t{0}, (count + kPiece - 1) / kPiece,
              [&](std::size_t i) { work(i * kPiece, std::min(count, (i + 1) * kPiece)); });
}

std::vector<float> Without(std::vector<float> whole, std::span<const Less> less,
                           std::vector<float> LightState::*slots) {
  InPieces(whole.size(), [&](std::size_t begin, std::size_t end) {
    for (const Less& one : less) {
      const std::vector<float>& off = (*one.light).*slots;
      for (std::size_t i = begin; i < end; ++i) {
        whole[i] = std::max(0.0f, whole[i] - one.share * off[i]);
      }
    }
  });
  return whole;
}

LightVolume Without(LightVolume whole, std::span<const Less> less) {
  InPieces(whole.size(), [&](std::size_t begin, std::size_t end) {
    for (const Less& one : less) {
      for (std::size_t i = begin; i < end; ++i) {
        LightVolume::Node node = whole.node(i);
        node.mean -= one.share * one.light->volume.node(i).mean;
        node.slope -= one.share * one.light->volume.node(i).slope;
        whole.Set(i, node);
      }
    }
  });
  return whole;
}

/// What is left of the whole.
LightState Without(const LightState& whole, std::span<const Less> less) {
  return {.total = Without(whole.total, less, &LightState::total),
          .direct = Without(whole.direct, less, &LightState::direct),
          .volume = Without(whole.volume, less)};
}

/// The lock, once nobody else has it; none if its holder has fallen silent.
std::optional<LightLock> TakeOrWait(const std::filesystem::path& file, const TellLight& tell) {
  constexpr auto kBetweenLooks = std::chrono::milliseconds(100);
  for (LightWait wait(file);;) {
    if (std::optional<LightLock> lock = LightLock::Try(file)) return lock;
    if (!wait.Look()) return std::nullopt;
    if (tell) tell({"another run solves it", wait.share()});
    std::this_thread::sleep_for(kBetweenLooks);
  }
}

}  // namespace

StaticLight::StaticLight(const World& world, const Tracer& tracer, const TexturePool& textures,
                         const StaticLightOptions& options)
    : world_(&world),
      tracer_(&tracer),
      textures_(&textures),
      options_(options),
      all_on_{std::vector<float>(world.lights().size(), 1.0f), true},
      has_sky_(HasSky(world)) {
  const TriangleMesh& mesh = world.statics().mesh;
  {
    const bool is_kept =
        !options_.cache_folder.empty() && HasLight(options_.cache_folder, KeyOf(all_on_));
    SolveWatch watch(is_kept ? TellLight() : options_.progress, {{"laying its points", 0}});
    watch.Begin(1);
    fine_ = GridWithin(mesh, options_.texel_m, options_.max_points);
    watch.Add(0);
    coarse_ = GridWithin(mesh, options_.coarse_texel_m, options_.max_points);
  }
  Solved(all_on_);
}

std::uint64_t StaticLight::KeyOf(const Lit& lit) const {
  return LightKey(*world_, options_, lit.lamps, !lit.sky && lit.lamps == all_on_.lamps);
}

LightState StaticLight::Solve(const Lit& lit, UnfinishedLight* unfinished,
                              SolveWatch* watch) const {
  const TriangleMesh& mesh = world_->statics().mesh;
  const Instant statics = tracer_->Pose({});

  const Things things = ThingsOf(mesh);
  const std::vector<SurfacePoint> places = LocatePoints(fine_, mesh, mesh.positions, mesh.normals);
  const std::vector<float> direct =
      DirectAt(statics, *world_, lit.lamps, fine_, things, places, unfinished, watch);
  watch->Begin(4);
  LightState state;
  state.direct.resize(fine_.point_of_slot.size());
  FillSlots(fine_, direct, state.direct);
  watch->Add(1);
  const float sky = lit.sky ? 1.0f : 0.0f;
  Patches patches = MakePatches(
      LooseThings(coarse_, mesh, things), LocatePoints(coarse_, mesh, mesh.positions, mesh.normals),
      {ReflectanceAt(*world_, *textures_, coarse_, options_.coarse_texel_m),
       EmittedAt(*world_, coarse_, sky)});
  watch->Add(1);
  const std::vector<std::uint32_t> patch_of = PatchesOf(fine_, coarse_, patches);
  watch->Add(1);
  CentrePatches(places, patch_of, &patches);
  const Radiosity radiosity = SolveRadiosity(
      statics, coarse_, patches, MeanByPatch(fine_, direct, patch_of, patches.places.size()),
      {.directions = options_.directions, .bounces = options_.bounces}, watch);
  AddIndirect(patches, radiosity, &state);
  PaintLuminaires(*world_, *textures_, fine_, options_.texel_m, lit.lamps, sky, &state);
  state.volume = EmptyVolume();
  FillVolume(statics, coarse_, mesh, patches, radiosity, options_.volume_directions, &state.volume,
             watch);
  return state;
}

LightVolume StaticLight::EmptyVolume() const {
  Eigen::AlignedBox3f box = tracer_->static_box();
  box.min().z() = FloorOf(box);
  box.max().z() = std::min(box.max().z(), box.min().z() + options_.volume_height_m);
  float spacing = options_.volume_spacing_m;
  while (LightVolume::ShapeOf(box, spacing).size() > options_.max_nodes) spacing *= 1.1f;
  return LightVolume(box, spacing);
}

std::vector<SolveWatch::Foreseen> StaticLight::Foreseen() const {
  // Seconds of one processor a point, as measured in a hall; only their ratios matter.
  const auto fine = static_cast<double>(fine_.points.size());
  const auto coarse = static_cast<double>(coarse_.points.size());
  const auto nodes = static_cast<double>(EmptyVolume().size());
  return {{"direct light", 32e-6 * fine},
          {"patches", 2e-7 * fine + 1e-6 * coarse},
          {"reflected light", 17e-6 * coarse},
          {"light in free space", 80e-6 * nodes},
          {"writing", 2e-8 * fine}};
}

/// Adds to the direct light of every slot what the patches around it throw there.
void StaticLight::AddIndirect(const Patches& patches, const Radiosity& radiosity,
                              LightState* state) const {
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
  state->total.resize(state->direct.size());
  FillSlots(fine_, indirect, state->total);
  for (std::size_t i = 0; i < state->total.size(); ++i) state->total[i] += state->direct[i];
}

LightState StaticLight::LoadOrSolve(const Lit& lit) const {
  if (options_.cache_folder.empty()) {
    SolveWatch watch(options_.progress, Foreseen());
    LightState state = Solve(lit, nullptr, &watch);
    watch.End();
    return state;
  }
  const std::uint64_t key = KeyOf(lit);
  const auto kept = [&] {
    return LoadLight(options_.cache_folder, key, fine_.point_of_slot.size());
  };
  // The one who has the lock solves; others wait for what he leaves. He may have left it between
  // our look and our lock, so who has it looks once more.
  if (std::optional<LightState> state = kept()) return *std::move(state);
  const std::optional<LightLock> lock =
      TakeOrWait(LockFileOf(options_.cache_folder, key), options_.progress);
  if (std::optional<LightState> state = kept()) return *std::move(state);
  const TellLight tell = [&](const LightProgress& progress) {
    if (lock) lock->Beat(progress.share);
    if (options_.progress) options_.progress(progress);
  };
  SolveWatch watch(tell, Foreseen());
  std::optional<UnfinishedLight> unfinished;
  if (lock) unfinished.emplace(options_.cache_folder, key);
  LightState state = Solve(lit, unfinished ? &*unfinished : nullptr, &watch);
  watch.Begin(1);
  SaveLight(options_.cache_folder, key, state);
  ShrinkLight(options_.cache_folder, options_.cache_bytes);
  watch.End();
  return state;
}

std::shared_ptr<const LightState> StaticLight::Solved(const Lit& lit) const {
  auto& found = solved_[lit];
  // Isolated: a thread that holds the mutex must not pick up another frame's work while it waits.
  if (!found) {
    Isolated([&] { found = std::make_shared<LightState>(LoadOrSolve(lit)); });
  }
  return found;
}

std::shared_ptr<const LightState> StaticLight::At(std::span<const float> light_scale) const {
  const std::vector<float> scale(light_scale.begin(), light_scale.end());
  const std::lock_guard lock(mutex_);
  if (scale.empty() || scale == all_on_.lamps) return Solved(all_on_);
  if (const auto found = composed_.find(scale); found != composed_.end()) return found->second;

  auto composed = std::make_shared<const LightState>(Composed(scale));
  constexpr std::size_t kRemembered = 4;  // a fade never comes back to the same setting
  if (composed_.size() > kRemembered) composed_.clear();
  return composed_[scale] = std::move(composed);
}

LightState StaticLight::Composed(const std::vector<float>& scale) const {
  // One solution for each group of lamps dimmed alike: the same few groups serve a whole fade.
  std::map<float, std::vector<float>> groups;
  for (std::size_t i = 0; i < scale.size(); ++i) {
    if (scale[i] == 1) continue;
    auto& group = groups[scale[i]];
    group.resize(scale.size());
    group[i] = 1;
  }
  std::vector<Less> dimmed;
  for (const auto& [share, group] : groups) {
    // It is taken off the whole, which keeps the sky. Where there is none, all lamps are the whole.
    const Lit lamps_alone = {group, !has_sky_ && group == all_on_.lamps};
    dimmed.push_back({1 - share, Solved(lamps_alone)});
  }
  const std::shared_ptr<const LightState> whole = Solved(all_on_);
  LightState state;
  Isolated([&] { state = Without(*whole, dimmed); });
  return state;
}

}  // namespace aisle::sim
