#pragma once

#include <string>

namespace aisle {

struct ShellOutput {
  int status = 0;    ///< as waitpid has it: 0 when the command succeeded; -1 when none started
  std::string text;  ///< its stdout
};

/// What a shell command prints, once it has ended.
ShellOutput RunInShell(const std::string& command);

}  // namespace aisle
