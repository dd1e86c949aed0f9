#pragma once

#include <string>

#include "simulator/scene/issues.h"

namespace aisle::sim {

/// Reports what is wrong with a YAML text as such (YamlFaults). `file` goes into the marks.
void GuardYaml(const std::string& text, int file, Issues* issues);

}  // namespace aisle::sim
