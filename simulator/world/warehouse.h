#pragma once

#include "simulator/world/palette.h"
#include "simulator/world/world_builder.h"

namespace aisle::sim {

// One file a part of the kit; each lays out what the scene says, its accidents drawn from the seed.

void AddFloor(const Scene& scene, const Palette& palette, std::uint64_t seed,
              WorldBuilder* builder);
void AddMarkings(const Scene& scene, const Palette& palette, WorldBuilder* builder);
void AddWalls(const Scene& scene, const Palette& palette, std::uint64_t seed,
              WorldBuilder* builder);
/// What carries the roof, and its skin.
void AddRoof(const Scene& scene, const Palette& palette, WorldBuilder* builder);
/// A door that stands open: the day outside, its leaf run up.
void AddOpenDoor(const HallSpec& hall, const DoorSpec& door, const Palette::Day& day,
                 const Palette& palette, TriangleMesh* mesh);
inline constexpr std::size_t kLightsOfDoor = 2;
/// The light that falls through an open door: the sky's and the yard's, as it shows them.
std::array<AreaLight, kLightsOfDoor> DaylightOf(const HallSpec& hall, const DoorSpec& door);
/// What share of the daylight clouds leave at a time.
float CloudAt(const HallSpec& hall, double time_s);
void AddDoors(const Scene& scene, const Palette& palette, WorldBuilder* builder);
void AddColumns(const Scene& scene, const Palette& palette, WorldBuilder* builder);
void AddRacks(const Scene& scene, const Palette& palette, std::uint64_t seed,
              WorldBuilder* builder);
void AddStacks(const Scene& scene, const Palette& palette, std::uint64_t seed,
               WorldBuilder* builder);
void AddMezzanines(const Scene& scene, const Palette& palette, std::uint64_t seed,
                   WorldBuilder* builder);
/// Also the area lights themselves, in the order of the scene's grids.
void AddLights(const Scene& scene, const Palette& palette, WorldParts* parts,
               WorldBuilder* builder);

/// The windows through which the sun shines: panes as bright as an overcast sky, and their bars.
void AddWindows(const Scene& scene, const Palette& palette, WorldParts* parts,
                WorldBuilder* builder);

/// The scene's moving lights at a time, and in *bounce the irradiance that their light gives
/// everywhere after it met a surface.
std::vector<Beam> BeamsAt(const Scene& scene, double time_s, float* bounce);

/// What share of each light shines at a time, in the order of AddLights. Lamps that go off and
/// clouds before the doors are the hall's, not an actor's: they are the same in every twin.
std::vector<float> LightScale(const Scene& scene, double time_s);

}  // namespace aisle::sim
