#pragma once

#include <functional>

#include "simulator/world/palette.h"

namespace aisle::sim {

/// Where the parts of the static world are put: triangles in one mesh, each with its instance.
class Site {
 public:
  explicit Site(WorldParts* parts) : parts_(parts) {}

  /// Adds an instance and returns its index.
  std::uint16_t Add(const std::string& name, ObjectClass object_class, bool is_actor = false);
  /// Runs `draw`; all triangles it appends belong to the instance.
  void Draw(std::uint16_t instance, const std::function<void(TriangleMesh*)>& draw);
  /// Both, for a thing drawn in one go.
  void Add(const std::string& name, ObjectClass object_class,
           const std::function<void(TriangleMesh*)>& draw) {
    Draw(Add(name, object_class), draw);
  }

 private:
  WorldParts* parts_;
};

// One file a part of the kit; each lays out what the scene says, its accidents drawn from the seed.

void AddFloor(const Scene& scene, const Palette& palette, std::uint64_t seed, Site* site);
void AddMarkings(const Scene& scene, const Palette& palette, Site* site);
void AddWalls(const Scene& scene, const Palette& palette, std::uint64_t seed, Site* site);
/// What carries the roof, and its skin.
void AddRoof(const Scene& scene, const Palette& palette, Site* site);
/// A door that stands open: the day outside, its leaf run up.
void AddOpenDoor(const HallSpec& hall, const DoorSpec& door, const Palette::Day& day,
                 const Palette& palette, TriangleMesh* mesh);
inline constexpr std::size_t kLightsOfDoor = 2;
/// The light that falls through an open door: the sky's and the yard's, as it shows them.
std::array<AreaLight, kLightsOfDoor> DaylightOf(const HallSpec& hall, const DoorSpec& door);
/// What share of the daylight clouds leave at a time.
float CloudAt(const HallSpec& hall, double time_s);
void AddDoors(const Scene& scene, const Palette& palette, Site* site);
void AddColumns(const Scene& scene, const Palette& palette, Site* site);
void AddRacks(const Scene& scene, const Palette& palette, std::uint64_t seed, Site* site);
void AddStacks(const Scene& scene, const Palette& palette, std::uint64_t seed, Site* site);
void AddMezzanines(const Scene& scene, const Palette& palette, std::uint64_t seed, Site* site);
/// Also the area lights themselves, in the order of the scene's grids.
void AddLights(const Scene& scene, const Palette& palette, WorldParts* parts, Site* site);

/// The windows through which the sun shines: panes as bright as an overcast sky, and their bars.
void AddWindows(const Scene& scene, const Palette& palette, WorldParts* parts, Site* site);

/// The scene's moving lights at a time, and in *bounce the irradiance that their light gives
/// everywhere after it met a surface.
std::vector<Beam> BeamsAt(const Scene& scene, double time_s, float* bounce);

/// What share of each light shines at a time, in the order of AddLights.
std::vector<float> LightScale(const Scene& scene, double time_s);

}  // namespace aisle::sim
