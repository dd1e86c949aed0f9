#include "simulator/scene/check_loads.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace aisle::sim {
namespace {

/// Who waits when: what is pushed or towed waits with who moves it.
class Clocks {
 public:
  explicit Clocks(const Scene& scene) {
    for (const VehicleSpec& vehicle : scene.vehicles) {
      const std::string& by = vehicle.pushed_by.empty() ? vehicle.towed_by : vehicle.pushed_by;
      if (!by.empty()) leader_[vehicle.name] = by;
    }
    for (const PersonSpec& person : scene.people) yields_[person.name] = person.yields.yields;
    for (const VehicleSpec& vehicle : scene.vehicles) {
      yields_[LeaderOf(vehicle.name)] |= vehicle.yields.yields;
    }
  }

  /// Whether one of the two may wait while the other goes on.
  bool MayPart(const std::string& a, const std::string& b) const {
    const std::string &leads_a = LeaderOf(a), &leads_b = LeaderOf(b);
    return leads_a != leads_b && (Yields(leads_a) || Yields(leads_b));
  }

 private:
  const std::string& LeaderOf(const std::string& name) const {
    const auto leader = leader_.find(name);
    return leader == leader_.end() ? name : leader->second;
  }
  bool Yields(const std::string& leader) const {
    const auto yields = yields_.find(leader);
    return yields != yields_.end() && yields->second;
  }

  std::map<std::string, std::string> leader_;
  std::map<std::string, bool> yields_;  ///< per leader: it or who goes with it
};

}  // namespace

void CheckLoads(const Scene& scene, Issues* issues) {
  if (!scene.drive.there) return;  // nobody yields to a rig on its route
  const Clocks clocks(scene);
  for (std::size_t i = 0; i < scene.mechanisms.size(); ++i) {
    const MechanismSpec& load = scene.mechanisms[i];
    std::vector<std::string> holders;
    if (!load.front_by.empty()) holders = {load.front_by, load.rear_by};
    for (const TakenSpec& taken : load.taken) holders.push_back(taken.by);
    const auto parts = std::ranges::adjacent_find(
        holders, [&](const std::string& a, const std::string& b) { return clocks.MayPart(a, b); });
    if (parts == holders.end()) continue;
    issues->Add(load.mark, fmt::format("mechanisms[{}]", i),
                fmt::format("'{}' and '{}' carry it, and where one yields to the vehicle the other "
                            "would walk on; remove the `yields` of both",
                            *parts, *(parts + 1)));
  }
}

}  // namespace aisle::sim
