#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

namespace aisle {

/// A folder of the public data sets (tests/README.md): below the environment's AISLE_TEST_DATA,
/// else below what CMake was given under that name. Where neither is set, a path that does not
/// exist and shows in the message of a skipped test what to set.
inline std::filesystem::path TestData(const std::string& folder) {
  const char* const set = std::getenv("AISLE_TEST_DATA");
  const std::filesystem::path root = set != nullptr ? set : AISLE_TEST_DATA;
  return (root.empty() ? "$AISLE_TEST_DATA" : root) / folder;
}

}  // namespace aisle
