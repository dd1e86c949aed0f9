#include "harness/campaign/guest_rooms.h"

#include <algorithm>
#include <tuple>

#include "harness/campaign/own_memory.h"
#include "harness/io/file.h"
#include "harness/io/places.h"

namespace aisle {

namespace fs = std::filesystem;

GuestRooms::GuestRooms(const fs::path& at)
    : folder(fs::absolute(at).lexically_normal()),
      dataset(folder / "dataset"),
      output(folder / "output"),
      temporary(folder / "tmp"),
      ros(CacheDir() / "ros") {
  RemoveFolder(folder);
  for (const fs::path& room : {dataset, output, temporary}) fs::create_directories(room);
}

GuestRooms::~GuestRooms() {
  // What stays is taken away, or complained of, by who comes next.
  std::ignore = TryToRemoveFolder(folder);
}

SandboxRules RulesOf(const ExternalSystem& system, const GuestRooms& rooms,
                     const std::vector<fs::path>& hidden) {
  SandboxRules rules{.hidden = hidden, .writable = {rooms.dataset, rooms.output, rooms.temporary}};
  for (const std::string& folder : system.may_write) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (fs::exists(folder, error)) rules.writable.emplace_back(folder);
  }
  return rules;
}

Confinement ConfinementOf(const ExternalSystem& system, const GuestRooms& rooms,
                          const Sandbox& sandbox) {
  Confinement confinement{.environment = ScrubbedEnvironment(rooms.temporary, system.environment),
                          .ruleset = sandbox.ruleset(),
                          .shared_memory_access = sandbox.writing()};
  for (const std::string& variable : rooms.ros.Variables()) {
    confinement.environment.push_back(variable);
  }
  const auto& asked = system.may_write;
  const bool shares = std::find(asked.begin(), asked.end(), "/dev/shm") != asked.end();
  confinement.own_shared_memory = !shares && CanOwnSharedMemory();
  return confinement;
}

}  // namespace aisle
