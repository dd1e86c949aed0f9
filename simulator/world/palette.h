#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "simulator/scene/dice.h"
#include "simulator/scene/scene.h"
#include "simulator/world/assets.h"
#include "simulator/world/shapes.h"
#include "simulator/world/world.h"

namespace aisle::sim {

inline constexpr std::size_t kFloorSheets = 4;
inline constexpr std::size_t kCartonSides = 12, kCartonTops = 4, kAisleSigns = 8, kBayLabels = 8;
inline constexpr float kFloorSheet_m = 5.0f;  ///< side of the floor a sheet shows
inline constexpr float kWallSheet_m = 4.0f;
inline constexpr float kOvercast = 0.28f;  ///< radiance of a sky of which the scene says nothing
inline constexpr float kYardShare = 0.3f;  ///< of the sky's radiance, of a yard in the open

/// Materials of the warehouse kit, as indices into the world's materials, and the places of
/// pictures in its atlases.
struct Palette {
  std::array<std::uint16_t, kFloorSheets> floor{};
  std::uint16_t wall = 0, plinth = 0, roof = 0, door = 0;
  float wall_wide_m = kWallSheet_m;      ///< what a sheet of wall shows of its length
  std::uint16_t steel = 0;               ///< bare, scratched
  std::uint16_t upright = 0;             ///< perforated rack posts: 0.1 m × 0.4 m a repeat
  std::array<std::uint16_t, 3> posts{};  ///< the same by RackPaint
  std::uint16_t beam = 0;                ///< 1.35 m × 0.34 m a repeat
  std::uint16_t wood = 0;
  std::uint16_t carton = 0;  ///< atlas
  std::uint16_t wrap = 0;    ///< shrink-wrapped goods
  std::uint16_t drum = 0, tote = 0;
  std::uint16_t stripes = 0, line_paint = 0, hatch = 0;
  std::uint16_t sign = 0;            ///< atlas
  std::vector<std::uint16_t> lamps;  ///< by Scene::lights, each as bright as these
  std::uint16_t lamp_housing = 0;
  std::uint16_t sky = 0, pavement = 0;
  /// What an open door shows: the sky, and the yard below it.
  struct Day {
    std::uint16_t sky = 0, yard = 0;
  };
  std::vector<Day> days;  ///< by Scene::doors; nothing for those that are closed

  std::array<UvRect, kCartonSides> carton_sides;
  std::array<UvRect, kCartonTops> carton_tops;
  std::array<UvRect, kAisleSigns> aisle_signs;
  std::array<UvRect, kBayLabels> bay_labels;  ///< twice as wide as tall
  std::vector<UvRect> wall_signs;             ///< square
};

/// Adds the kit's textures and materials. Wear and stains depend on the seed.
Palette AddPalette(const Scene& scene, std::uint64_t seed, const AssetLibrary& assets,
                   WorldParts* parts);

}  // namespace aisle::sim
