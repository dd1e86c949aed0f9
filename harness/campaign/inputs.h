#pragma once

#include <string>
#include <vector>

#include "harness/suite/suite.h"

namespace aisle {

/// What a user may say instead of the suite's own.
struct InputOptions {
  std::vector<std::string> files;  ///< suites and scenes
  std::vector<std::string> systems = {}, twins = {};
  std::vector<std::string> set = {};     ///< "SYSTEM.PATH=VALUE": options of one of the systems
  std::uint64_t seeds = 0;               ///< a count, from 1 on; 0: the suite's own
  std::vector<std::uint64_t> seed = {};  ///< these very seeds
};

/// The names of this program's systems, twins, scores and options.
Vocabulary KnownNames();

/// The files as suites; one report answers them all. A bare scene asks the plainest question of the
/// plainest two systems. Limits on systems and twins that are left out go with them. Throws
/// InputError, also where twins or seeds are asked for and every input is a recording, which has
/// neither.
std::vector<Suite> LoadInputs(const InputOptions& options);

/// What of the suite's systems and limits cannot be on its scenes, a line each; empty: nothing.
std::string ComplaintsOf(const Suite& suite);

/// Every mistake of every scene, before hours of work begin. Throws InputError with all of them.
void CheckScenes(const std::vector<Suite>& suites);

/// The part of a command line that says the same again, for a shell.
std::string Describe(const InputOptions& options);

}  // namespace aisle
