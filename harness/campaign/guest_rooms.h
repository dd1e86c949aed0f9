#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/campaign/process.h"
#include "harness/campaign/ros_domain.h"
#include "harness/campaign/sandbox.h"
#include "harness/contract/external.h"

namespace aisle {

/// The folders of one foreign system in one run, only three of which may it write to, and where its
/// nodes of ROS meet.
struct GuestRooms {
  /// Throws MachineError where what lies there cannot be taken away.
  explicit GuestRooms(const std::filesystem::path& at);
  ~GuestRooms();
  GuestRooms(const GuestRooms&) = delete;
  GuestRooms& operator=(const GuestRooms&) = delete;

  const std::filesystem::path folder, dataset, output, temporary;
  const RosDomain ros;
};

/// What holds the system to its rooms and to the folders that it may write to beside. Those are
/// made; what cannot be made cannot be written.
SandboxRules RulesOf(const ExternalSystem& system, const GuestRooms& rooms,
                     const std::vector<std::filesystem::path>& hidden);

/// How it is started: bound to these rules, with nothing of the night's environment but what
/// ScrubbedEnvironment leaves, and with a /dev/shm of its own where the kernel gives one and it
/// does not ask for the machine's (`may_write: [/dev/shm]`).
Confinement ConfinementOf(const ExternalSystem& system, const GuestRooms& rooms,
                          const Sandbox& sandbox);

}  // namespace aisle
