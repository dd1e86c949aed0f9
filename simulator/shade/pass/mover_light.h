#pragma once

#include <array>
#include <deque>
#include <span>
#include <vector>

#include "simulator/shade/light/light_volume.h"
#include "simulator/shade/light/static_visibility.h"
#include "simulator/shade/pass/mover_nodes.h"
#include "simulator/shade/surface/light_grid.h"

namespace aisle::sim {

struct MoverLightOptions {
  float pixels_per_node = 3.5f;  ///< nodes are as far apart as this many pixels show, or finer
  StaticVisibilityOptions statics;
};

/// The light on what moves: a function of the surface point, the bodies' poses and the lamps.
/// Irradiance is the sum over emitters of what each would send unshadowed, in closed form at each
/// point, times the share of it that is seen. That share is asked at nodes of the body's own
/// surface (bodies by shadow rays whose ends are fixed for each node; the static world by a grid
/// fixed in space) and spread over the points around. Which points the cameras see decides only
/// what is computed; how far off they are, how close the nodes lie.
class MoverLight {
 public:
  /// `world` and `grids` (one a mover) must outlive it.
  MoverLight(const World& world, std::span<const LightGrid> grids,
             const MoverLightOptions& options);

  /// Irradiance at the wanted points of a mover's grid, -1 at the others. `volume`: the indirect
  /// light of free space. `pixel_m`: the size of a pixel on the mover.
  std::vector<float> At(const Instant& instant, std::size_t mover, const LightVolume& volume,
                        std::span<const std::uint8_t> wanted, float pixel_m) const;

 private:
  /// What the nodes of one mover know at an instant.
  struct NodeLight {
    EmitterVisibility visible;
    std::vector<float> kept;  ///< share of the indirect light that bodies around leave
  };
  const MoverNodes& NodesFor(std::size_t mover, float pixel_m) const;
  NodeLight LightNodes(const Instant& instant, std::size_t mover, const LightVolume& volume,
                       const MoverNodes& nodes, std::span<const std::uint32_t> used) const;

  static constexpr std::array<float, 4> kSpacings = {0.025f, 0.05f, 0.1f, 0.2f};  // m
  /// A body in its bind pose, and its nodes at each spacing, chosen when first asked for.
  struct Body {
    std::vector<SurfacePoint> bound;
    std::vector<std::uint32_t> pieces;
    std::array<std::once_flag, kSpacings.size()> chosen;
    std::array<MoverNodes, kSpacings.size()> levels;
  };

  const World& world_;
  std::span<const LightGrid> grids_;
  MoverLightOptions options_;
  float floor_z_;  ///< m
  Emitters emitters_;
  StaticVisibility statics_;
  mutable std::deque<Body> bodies_;  ///< by mover
};

}  // namespace aisle::sim
