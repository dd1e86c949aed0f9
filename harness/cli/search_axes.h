#pragma once

#include <string>
#include <vector>

#include "harness/bench/search.h"

namespace aisle {

/// A file of options to be searched, one a line: PATH LOW HIGH, and "ratio" where steps are to be
/// of equal ratio; empty lines and those that begin with # are for the reader. `system` is the
/// built-in one whose options they are. Throws InputError with file and line.
std::vector<SearchAxis> ReadAxes(const std::string& file, const std::string& system);

/// "NAME:PATH=VALUE,PATH=VALUE": a set of options with a name; nothing behind the colon is the
/// system as it is. Throws InputError.
struct NamedSet {
  std::string name;
  OptionSet options;
};
NamedSet ParseNamedSet(const std::string& text, const std::string& system);

}  // namespace aisle
