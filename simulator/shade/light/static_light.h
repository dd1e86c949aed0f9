#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "simulator/common/light_progress.h"
#include "simulator/shade/light/light_state.h"
#include "simulator/shade/light/radiosity.h"
#include "simulator/shade/light/solve_watch.h"
#include "simulator/shade/surface/light_grid.h"
#include "simulator/shade/surface/texture_pool.h"
#include "simulator/trace/tracer.h"

namespace aisle::sim {

class UnfinishedLight;

struct StaticLightOptions {
  /// Where solutions are kept from run to run, by content; empty: nowhere.
  std::filesystem::path cache_folder = {};
  std::uintmax_t cache_bytes = std::uintmax_t{4} << 30;  ///< what is kept there at most
  std::string isa = "avx2";     ///< Embree's, as rays' last bits depend on it
  float texel_m = 0.06f;        ///< spacing of the direct light's points; soft shadows' resolution
  float coarse_texel_m = 0.4f;  ///< spacing of the indirect light's points
  float volume_spacing_m = 0.75f;
  /// Above the lowest point of the static world: what moves higher takes the light of there.
  float volume_height_m = 6;
  int directions = 64;                 ///< rays a point that gather indirect light
  int volume_directions = 256;         ///< the same of the points in free space, which are few
  int bounces = 6;                     ///< of indirect light
  std::size_t max_points = 3'000'000;  ///< the spacing is widened until this holds, and
  std::size_t max_nodes = 200'000;     ///< this of the points in free space
  /// Called while a solution is computed, or waited for while another process computes it; not
  /// while one is read.
  TellLight progress = {};
};

/// The light that static luminaires throw on the static world, solved once: direct light by shadow
/// rays on a fine grid over all surfaces, indirect light as diffuse radiosity on a coarse one (form
/// factors by cosine-distributed rays, Jacobi iterations). Light is linear in the lamps, so a frame
/// with some lamps dimmed is the full solution less the dimmed lamps' own.
class StaticLight {
 public:
  /// Solves the case of all lamps on, in parallel.
  StaticLight(const World& world, const Tracer& tracer, const TexturePool& textures,
              const StaticLightOptions& options);

  const LightGrid& grid() const { return fine_; }
  /// The light under lamps dimmed by `light_scale`. Settings met before are remembered.
  /// Thread-safe.
  std::shared_ptr<const LightState> At(std::span<const float> light_scale) const;

 private:
  /// What a solution is the light of.
  struct Lit {
    std::vector<float> lamps;  ///< scale of each
    bool sky = false;          ///< whether what shines without a lamp does
    auto operator<=>(const Lit&) const = default;
  };

  LightState Solve(const Lit& lit, UnfinishedLight* unfinished, SolveWatch* watch) const;
  std::uint64_t KeyOf(const Lit& lit) const;
  void AddIndirect(const Patches& patches, const Radiosity& radiosity, LightState* state) const;
  LightVolume EmptyVolume() const;
  std::vector<SolveWatch::Foreseen> Foreseen() const;
  LightState LoadOrSolve(const Lit& lit) const;
  std::shared_ptr<const LightState> Solved(const Lit& lit) const;
  LightState Composed(const std::vector<float>& scale) const;

  const World* world_;
  const Tracer* tracer_;
  const TexturePool* textures_;
  StaticLightOptions options_;
  LightGrid fine_, coarse_;
  Lit all_on_;
  bool has_sky_ = false;
  mutable std::mutex mutex_;  ///< guards the two caches
  mutable std::map<Lit, std::shared_ptr<const LightState>> solved_;
  mutable std::map<std::vector<float>, std::shared_ptr<const LightState>> composed_;
};

}  // namespace aisle::sim
