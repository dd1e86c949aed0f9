#pragma once

#include <yaml-cpp/yaml.h>

#include <string>

namespace aisle {

/// Reads one YAML document the careful way: no anchors or aliases (they can blow up without bound),
/// no duplicate keys (yaml-cpp keeps the first in silence), no second document (it leaves it out in
/// silence), bounded depth, bounded size. Throws InputError with file:line:column.
YAML::Node LoadYaml(const std::string& file);
YAML::Node ParseYaml(const std::string& text, const std::string& file);

/// "file:line:column: message", the place being the node's.
[[noreturn]] void FailAt(const std::string& file, const YAML::Mark& mark,
                         const std::string& message);

}  // namespace aisle
