#pragma once

#include <string_view>

#include "simulator/scene/given_key.h"
#include "simulator/scene/issues.h"

namespace aisle::sim {

/// A kind of a thing, "a slider", and those keys that it has and other kinds have not.
struct KindKeys {
  std::string_view kind;
  std::vector<std::string_view> keys;
};

/// Reports the given keys that this kind has not; all that is in a list of another kind is told
/// once. `path` is the thing's own.
void CheckGiven(const std::vector<GivenKey>& given, const KindKeys& kind, const std::string& path,
                Issues* issues);

}  // namespace aisle::sim
