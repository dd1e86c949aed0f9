#include "simulator/scene/scene.h"

#include <fmt/format.h>

namespace aisle::sim {

std::string PlaceText(const std::vector<std::string>& files, Mark mark) {
  const std::string& file = files.at(static_cast<std::size_t>(mark.file));
  return fmt::format("{}:{}:{}", file, mark.line, mark.column);
}

std::vector<DescribedCamera> DescribedCameras(const Scene& scene) {
  std::vector<DescribedCamera> cameras = {{"camera", scene.camera}};
  for (std::size_t i = 0; i < scene.rig.pairs.size(); ++i) {
    const PairSpec& pair = scene.rig.pairs[i];
    if (pair.has_camera) cameras.push_back({fmt::format("rig.pairs[{}].camera", i), pair.camera});
  }
  return cameras;
}

Scene WithPair(Scene scene, const std::string& name) {
  RigSpec& rig = scene.rig;
  for (const PairSpec& pair : rig.pairs) {
    if (pair.name != name) continue;
    rig.first_mount = rig.mount;
    rig.mount = pair.mount;
    scene.camera = pair.camera;
    rig.pair = name;
  }
  return scene;
}

namespace {

/// Those that people bring stay away with these; others stand as at the start.
void Calm(std::vector<MechanismSpec>* mechanisms, const auto& is_calm) {
  std::erase_if(*mechanisms,
                [&](const MechanismSpec& one) { return is_calm(one) && one.IsBrought(); });
  for (MechanismSpec& one : *mechanisms) {
    if (!is_calm(one)) continue;
    one.still = true;
    one.taken.clear();
  }
}

/// They shine on, but as at the start.
void Calm(std::vector<BeamSpec>* beams, const auto& is_calm) {
  for (BeamSpec& one : *beams) {
    if (!is_calm(one)) continue;
    one.rate_rad_s = 0;
    one.moves.clear();
  }
}

}  // namespace

Scene WithoutActors(Scene scene) {
  scene.people.clear();
  scene.vehicles.clear();
  scene.crowd.people = 0;
  Calm(&scene.mechanisms, [](const MechanismSpec&) { return true; });
  Calm(&scene.beams, [](const BeamSpec&) { return true; });
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
  Calm(&scene.mechanisms, too_busy);
  Calm(&scene.beams, too_busy);
  scene.dynamics = dynamics;
  return scene;
}

}  // namespace aisle::sim
