#pragma once

#include <functional>
#include <map>
#include <vector>

#include "simulator/world/actors.h"
#include "simulator/world/warehouse.h"

namespace aisle::sim {

/// Materials of the parts of mechanisms, added to the world when first asked for.
class PartPaints {
 public:
  PartPaints(const Palette& palette, WorldParts* parts) : palette_(palette), parts_(parts) {}

  std::uint16_t Of(PartPaint paint);
  const Palette& palette() const { return palette_; }

 private:
  const Palette& palette_;
  WorldParts* parts_;
  std::map<PartPaint, std::uint16_t> own_;
};

/// Finds who or what holds something: the grip of an actor by its name.
using FindGrip = std::function<Grip(const std::string& name)>;

/// One mesh of a mechanism.
struct MechanismMesh {
  TriangleMesh mesh;
  MoverMotion motion;     ///< exact velocities of all vertices
  bool is_clear = false;  ///< all of it is seen through
};

ObjectClass ClassOf(const MechanismSpec& mechanism);

/// How many meshes MakeMechanism makes.
std::size_t CountMovers(const MechanismSpec& mechanism);

/// What of a mechanism moves: up to two meshes, what is seen through being its own. Parts that
/// never move go to the builder as NAME_frame. Velocities are the joints' own derivatives; those of
/// the people and forks that hold it are differenced over a millisecond.
std::vector<MechanismMesh> MakeMechanism(const MechanismSpec& mechanism, const FindGrip& find,
                                         AssetLibrary* assets, Wardrobe* wardrobe,
                                         PartPaints* paints, std::uint64_t seed,
                                         WorldBuilder* builder);

}  // namespace aisle::sim
