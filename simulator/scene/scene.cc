#include "simulator/scene/scene.h"

#include <fmt/format.h>

namespace aisle::sim {

std::string PlaceText(const std::vector<std::string>& files, Mark mark) {
  const std::string& file = files.at(static_cast<std::size_t>(mark.file));
  return fmt::format("{}:{}:{}", file, mark.line, mark.column);
}

Scene WithoutActors(Scene scene) {
  scene.people.clear();
  scene.vehicles.clear();
  return scene;
}

Scene Frozen(Scene scene) {
  scene.frozen = true;
  return scene;
}

Scene WithDynamics(Scene scene, Dynamics dynamics) {
  const auto too_busy = [&](const auto& actor) { return actor.level > dynamics; };
  std::erase_if(scene.people, too_busy);
  std::erase_if(scene.vehicles, too_busy);
  scene.dynamics = dynamics;
  return scene;
}

}  // namespace aisle::sim
