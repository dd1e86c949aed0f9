#include "simulator/world/check_models.h"

#include <fmt/format.h>

#include "simulator/mesh/kept/kept_model.h"

namespace aisle::sim {

std::vector<std::string> CheckModels(const Scene& scene, const AssetLibrary& assets) {
  std::vector<std::string> messages;
  const auto check = [&](const Mark& mark, const std::string& whose, const auto& look_up) {
    try {
      look_up();
    } catch (const std::runtime_error& error) {
      messages.push_back(
          fmt::format("{}: {}: {}", PlaceText(scene.files, mark), whose, error.what()));
    }
  };
  const auto check_mesh = [&](const MeshSpec& mesh, const std::string& whose) {
    if (!mesh.name.empty()) check(mesh.mark, whose, [&] { CheckUserModel(mesh.file); });
  };
  check_mesh(scene.hall.mesh, "hall.mesh");
  for (const PropSpec& prop : scene.props) {
    check_mesh(prop.mesh, "props.mesh");
    if (!prop.mesh.name.empty()) continue;
    check(prop.model_mark, "props.model", [&] { assets.Prop(prop.model); });
  }
  for (const MechanismSpec& mechanism : scene.mechanisms) {
    for (const PartSpec& part : mechanism.parts) {
      if (part.shape != PartShape::kModel) continue;
      check(part.model_mark, "mechanisms.parts.model", [&] { assets.Prop(part.model); });
    }
  }
  for (const PersonSpec& person : scene.people) {
    check_mesh(person.capture.mesh, "mesh of " + person.name);
    if (!person.capture.mesh.name.empty()) continue;
    check(person.model_mark, "model of " + person.name, [&] { assets.Person(person.model); });
  }
  for (const VehicleSpec& vehicle : scene.vehicles) {
    check(vehicle.model_mark, "model of " + vehicle.name, [&] { assets.Vehicle(vehicle.model); });
  }
  return messages;
}

}  // namespace aisle::sim
