#pragma once

#include <filesystem>
#include <vector>

#include "harness/contract/external.h"

namespace aisle {

/// What a system's command says of the files that decide what it does.
struct CommandFiles {
  /// Those that are there, each once: the program (on PATH too), scripts and settings, also behind
  /// "key:", "key=" and "--key=". Of files alone, not of folders.
  std::vector<std::filesystem::path> files;
  /// False where others may decide as well: the command is more than one program with its
  /// arguments (`cd x && ./run`, a redirection, a substitution), or that program is no file here.
  bool complete = false;
};

/// Words are those that a shell would hand on (POSIX wordexp: quotes, `~`, variables, patterns),
/// {source} filled in; the command of an `sh -c` is read the same way.
CommandFiles FilesOf(const ExternalSystem& system);

/// Whether nobody can tell that it still is what it was: its command does not say it all and no
/// `depends_on` answers for the rest.
bool MayChangeUnseen(const ExternalSystem& system);

}  // namespace aisle
