#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "simulator/world/world.h"

namespace aisle::sim {

/// Where the parts of the static world are put: triangles in one mesh, each with its instance.
class WorldBuilder {
 public:
  explicit WorldBuilder(WorldParts* parts) : parts_(parts) {}

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

}  // namespace aisle::sim
