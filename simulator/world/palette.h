#pragma once

#include <array>
#include <cstdint>

#include "simulator/scene/scene.h"
#include "simulator/world/dice.h"
#include "simulator/world/shapes.h"
#include "simulator/world/world.h"

namespace aisle::sim {

inline constexpr int kFloorSheets = 4;
inline constexpr float kFloorSheet_m = 5.0f;  ///< side of the floor a sheet shows
inline constexpr float kWallSheet_m = 4.0f;

/// Materials of the warehouse kit, as indices into the world's materials.
struct Palette {
  std::array<std::uint16_t, kFloorSheets> floor{};
  std::uint16_t wall = 0, plinth = 0, roof = 0, door = 0;
  std::uint16_t steel = 0;    ///< painted, dark
  std::uint16_t upright = 0;  ///< perforated rack posts, wrapped along their length
  std::uint16_t beam = 0;
  std::uint16_t wood = 0;
  std::uint16_t carton = 0;  ///< atlas, see CartonSide and CartonTop
  std::uint16_t wrap = 0;    ///< shrink-wrapped goods
  std::uint16_t drum = 0, tote = 0;
  std::uint16_t stripes = 0, line_paint = 0, hatch = 0;
  std::uint16_t sign = 0;  ///< atlas, see SignFace
  std::uint16_t lamp = 0, lamp_housing = 0;
};

/// Paints all textures and adds them with their materials. Everything depends on the seed.
Palette AddPalette(const Scene& scene, std::uint64_t seed, WorldParts* parts);

/// Places of the atlas pictures.
UvRect CartonSide(int kind);  ///< kinds 0 to kCartonSides - 1; the last four carry no label
UvRect CartonTop(int kind);   ///< kinds 0 to kCartonTops - 1
UvRect SignFace(int kind);    ///< kinds 0 to kSignFaces - 1; the first eight name aisles
inline constexpr int kCartonSides = 12, kCartonTops = 4, kSignFaces = 16;

}  // namespace aisle::sim
