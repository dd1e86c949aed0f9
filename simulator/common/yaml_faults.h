#pragma once

#include <string>
#include <vector>

namespace aisle::sim {

/// A mistake in a YAML text, and where it is, from 1.
struct YamlFault {
  int line = 0, column = 0;
  std::string key;  ///< printable and short; "" where no key is to blame
  std::string what;
};

/// Reads the event stream of a YAML text once, before anything is built from it, and tells what
/// yaml-cpp would swallow or choke on: syntax errors, anchors and aliases (a few hundred bytes can
/// stand for 10^9 nodes, or for themselves), duplicate keys (the first would win silently), more
/// than one document, nesting and node counts without end. Stops at a hundred of them.
std::vector<YamlFault> YamlFaults(const std::string& text);

}  // namespace aisle::sim
