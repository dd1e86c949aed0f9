#include "simulator/scene/scene.h"

namespace aisle::sim {

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
