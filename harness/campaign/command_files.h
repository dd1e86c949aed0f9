#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/contract/external.h"

namespace aisle {

/// What a system's command says of the files that decide what it does.
struct CommandFiles {
  /// Those that are there, each once: programs (on PATH too), scripts, settings, what `<` reads,
  /// also behind "key:", "key=" and "--key=". Of files alone, not of folders.
  std::vector<std::filesystem::path> files;
  /// Programs of it, as it names them, that are no file here and no word of the shell's: they may
  /// change and nobody would see it.
  std::vector<std::string> unknown;
};

/// Reads the command as the shell does that it will be given to: quotes, `~`, the variables that
/// the system will see, {source}, `cd DIR`, and the command of an `sh -c` in it.
CommandFiles FilesOf(const ExternalSystem& system);

/// The first of its programs that is no file here, where no `depends_on` answers for it; else
/// empty. Of such a system nobody can tell whether it still is what it was.
std::string UnknownProgram(const ExternalSystem& system);

}  // namespace aisle
