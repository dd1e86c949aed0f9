#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/contract/external.h"

namespace aisle {

/// What a system's command says of the files that decide what it does.
struct CommandFiles {
  /// Those that are there, each once: the program (on PATH too), scripts and settings, also behind
  /// "key:", "key=" and "--key=". Of files alone, not of folders.
  std::vector<std::filesystem::path> files;
  /// Why others may decide as well, a clause of a sentence; empty where it names them all. The
  /// command may be more than one program with its arguments (`cd x && ./run`, a redirection, a
  /// substitution), its program may not be here, start something else (`docker run`, `python3 -m`)
  /// or be everybody's without a file of the system's own (`perl {output}`), and what
  /// it names may be a folder. Libraries that a program loads are never looked at.
  std::string unseen = {};
};

/// Words are those that a shell would hand on (POSIX wordexp: quotes, `~`, variables, patterns),
/// {source} filled in; the command of an `sh -c` is read the same way.
CommandFiles FilesOf(const ExternalSystem& system);

/// Why nobody can tell that it still is what it was: CommandFiles::unseen where no `depends_on`
/// answers for the rest. Empty where one can tell.
std::string WhyUnseen(const ExternalSystem& system);

}  // namespace aisle
