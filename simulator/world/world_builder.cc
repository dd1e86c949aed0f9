#include "simulator/world/world_builder.h"

#include <stdexcept>

namespace aisle::sim {

std::uint16_t WorldBuilder::Add(const std::string& name, ObjectClass object_class, bool is_actor) {
  constexpr std::size_t kMost = 65'535;    // labels are pictures of 16 bits
  if (parts_->instances.size() > kMost) {  // the first is nothing
    throw std::runtime_error(
        fmt::format("a scene has at most {} things with labels of their own; '{}' is one more: use "
                    "fewer goods, racks or props",
                    kMost, name));
  }
  parts_->instances.push_back({name, object_class, is_actor});
  return static_cast<std::uint16_t>(parts_->instances.size() - 1);
}

void WorldBuilder::Draw(std::uint16_t instance, const std::function<void(TriangleMesh*)>& draw) {
  draw(&parts_->statics.mesh);
  parts_->statics.instances.resize(parts_->statics.mesh.triangles.size(), instance);
}

}  // namespace aisle::sim
