#pragma once

#include <string>
#include <vector>

#include "simulator/scene/mark.h"

namespace aisle::sim {

/// A key that stands in the file, of those that only some kinds of a thing have.
struct GivenKey {
  std::string name;
  Mark mark;
  std::string list;  ///< of the thing, in which the key's own map is; empty: the thing itself
  std::size_t index = 0;
};

}  // namespace aisle::sim
