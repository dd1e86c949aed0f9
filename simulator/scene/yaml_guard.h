#pragma once

#include <string>

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// Reads the event stream of a YAML text once, before anything is built from it, and reports what
/// yaml-cpp would swallow or choke on: syntax errors, anchors and aliases (a few hundred bytes can
/// stand for 10^9 nodes, or for themselves), duplicate keys (the first would win silently), more
/// than one document, nesting and node counts without end. `file` goes into the marks.
void GuardYaml(const std::string& text, int file, Issues* issues);

}  // namespace aisle::sim
