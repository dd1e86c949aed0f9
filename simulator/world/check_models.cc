#include "simulator/world/check_models.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <set>

#include "simulator/mesh/kept/kept_model.h"
#include "simulator/scene/crowd.h"
#include "simulator/world/actors.h"
#include "simulator/world/manners.h"
#include "simulator/world/mechanism.h"

namespace aisle::sim {
namespace {

class Checker {
 public:
  Checker(const Scene& scene, const AssetLibrary& assets) : scene_(scene), assets_(assets) {}

  std::vector<std::string> Run() {
    CheckPremises(scene_);
    for (const Premises& premises : scene_.dealt) CheckPremises(premises);
    for (const MechanismSpec& mechanism : scene_.mechanisms) CheckMechanism(mechanism);
    for (const PersonSpec& person : scene_.people) CheckPerson(person);
    for (const VehicleSpec& vehicle : scene_.vehicles) CheckVehicle(vehicle);
    CheckMovers();
    return std::move(messages_);
  }

 private:
  void Say(const Mark& mark, const std::string& whose, const std::string& what) {
    std::string message = fmt::format("{}: {}: {}", PlaceText(scene_.files, mark), whose, what);
    // What several halls share is checked with each of them.
    if (told_.insert(message).second) messages_.push_back(std::move(message));
  }

  /// Whether a look-up does not throw; else it is told why.
  bool Try(const Mark& mark, const std::string& whose, const auto& look_up) {
    try {
      look_up();
      return true;
    } catch (const std::runtime_error& error) {
      Say(mark, whose, error.what());
      return false;
    }
  }

  void CheckMesh(const MeshSpec& mesh, const std::string& whose) {
    if (!mesh.name.empty()) Try(mesh.mark, whose, [&] { CheckUserModel(mesh.file); });
  }

  void CheckPremises(const Premises& premises) {
    CheckMesh(premises.hall.mesh, "hall.mesh");
    for (const PropSpec& prop : premises.props) {
      CheckMesh(prop.mesh, "props.mesh");
      if (!prop.mesh.name.empty()) continue;
      Try(prop.model_mark, "props.model", [&] { assets_.Prop(prop.model); });
    }
  }

  void CheckMechanism(const MechanismSpec& mechanism) {
    for (const PartSpec& part : mechanism.parts) {
      if (part.shape != PartShape::kModel) continue;
      Try(part.model_mark, "mechanisms.parts.model", [&] { assets_.Prop(part.model); });
    }
    for (std::size_t i = 0; i < mechanism.taken.size(); ++i) {
      const TakenSpec& taken = mechanism.taken[i];
      const auto truck = std::ranges::find(scene_.vehicles, taken.by, &VehicleSpec::name);
      if (truck == scene_.vehicles.end() || !IsVehicle(truck->model)) continue;  // told elsewhere
      if (!assets_.Vehicle(truck->model).fork_node.empty()) continue;
      Say(taken.mark, fmt::format("mechanisms[{}].taken[{}].by", mechanism.place, i),
          fmt::format("the model '{}' of '{}' has no forks", truck->model, taken.by));
    }
  }

  bool IsVehicle(const std::string& model) const {
    return std::ranges::count(assets_.VehicleNames(), model) > 0;
  }

  void CheckPerson(const PersonSpec& person) {
    CheckMesh(person.capture.mesh, "mesh of " + person.name);
    if (!person.capture.mesh.name.empty()) return;
    if (!Try(person.model_mark, "model of " + person.name, [&] { assets_.Person(person.model); })) {
      return;
    }
    std::vector<std::string> models = {person.model};
    if (person.vary.look) models = assets_.PeopleNames();  // seeds show others
    for (const std::string& model : models) {
      if (!CheckPlays(person, model)) return;
    }
  }

  bool CheckPlays(const PersonSpec& person, const std::string& model) {
    const auto& clips = assets_.Person(model).clips;
    const std::vector<RouteStep>& steps = person.route.plan.steps;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const std::string& play = steps[i].play;
      if (play.empty() || clips.contains(play) || std::ranges::count(kManners, play) > 0) continue;
      std::vector<std::string> names(kManners.begin(), kManners.end());
      for (const auto& [name, unused] : clips) names.push_back(name);
      std::ranges::sort(names);
      const Mark mark = i < person.route.marks.size() ? person.route.marks[i].step : person.mark;
      Say(mark, fmt::format("people[{}].steps[{}].play", person.place, i),
          fmt::format("'{}' is nothing that '{}' can play; there are: {}", play, model,
                      fmt::join(names, ", ")));
      return false;
    }
    return true;
  }

  void CheckVehicle(const VehicleSpec& vehicle) {
    if (!Try(vehicle.model_mark, "model of " + vehicle.name,
             [&] { assets_.Vehicle(vehicle.model); })) {
      return;
    }
    const VehicleFacts& facts = assets_.Vehicle(vehicle.model);
    const std::string key = fmt::format("vehicles[{}]", vehicle.place);
    if (vehicle.load != GoodsKind::kNothing && facts.fork_node.empty()) {
      Say(vehicle.mark, key + ".load",
          fmt::format("the model '{}' has no forks to carry it", vehicle.model));
    }
    double highest_m = 0;
    for (const MastMove& move : vehicle.mast) highest_m = std::max(highest_m, move.height_m);
    const double room_m = std::max(0.0, facts.lift_travel_m - ForksAtRest_m(vehicle));
    if (highest_m <= room_m) return;
    Say(vehicle.mark, key + ".mast",
        facts.lift_travel_m == 0
            ? fmt::format("the model '{}' has none", vehicle.model)
            : fmt::format("{:g} m is higher than the model '{}' lifts: {:g} m above the start at "
                          "the most",
                          highest_m, vehicle.model, room_m));
  }

  /// There are no more movers than the world can tell apart.
  void CheckMovers() {
    const Scene live = WithDynamics(scene_, scene_.dynamics);
    std::size_t movers = 0;
    std::optional<Mark> first;
    const auto add = [&](std::size_t more, const Mark& mark) {
      movers += more;
      if (movers > kMostMovers && !first) first = mark;
    };
    for (const PersonSpec& person : live.people) add(1, person.mark);
    add(static_cast<std::size_t>(CrowdPeople(live)), live.crowd.mark);
    for (const VehicleSpec& vehicle : live.vehicles) add(1, vehicle.mark);
    for (const MechanismSpec& one : live.mechanisms) add(CountMovers(one), one.mark);
    if (!first) return;
    Say(*first, "movers",
        fmt::format("people, crowd, vehicles and mechanisms are {}, and a scene has at most {} (a "
                    "mechanism with panes that others are seen through counts twice)",
                    movers, kMostMovers));
  }

  const Scene& scene_;
  const AssetLibrary& assets_;
  std::vector<std::string> messages_;
  std::set<std::string> told_;
};

}  // namespace

std::vector<std::string> CheckModels(const Scene& scene, const AssetLibrary& assets) {
  return Checker(scene, assets).Run();
}

}  // namespace aisle::sim
