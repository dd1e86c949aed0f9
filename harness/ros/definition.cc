#include "harness/ros/definition.h"

namespace aisle::ros {

std::string FullTypeName(const std::string& type) {
  const std::size_t slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

}  // namespace aisle::ros
