#include "harness/io/shell_output.h"

#include <array>
#include <cstdio>

namespace aisle {

ShellOutput RunInShell(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {.status = -1, .text = {}};
  ShellOutput output;
  std::array<char, 4096> part{};
  while (const std::size_t n = std::fread(part.data(), 1, part.size(), pipe)) {
    output.text.append(part.data(), n);
  }
  output.status = ::pclose(pipe);
  return output;
}

}  // namespace aisle
