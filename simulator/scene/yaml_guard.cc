#include "simulator/scene/yaml_guard.h"

#include "simulator/common/yaml_faults.h"

namespace aisle::sim {

void GuardYaml(const std::string& text, int file, Issues* issues) {
  for (const YamlFault& fault : YamlFaults(text)) {
    issues->Add({fault.line, fault.column, file}, fault.key, fault.what);
  }
}

}  // namespace aisle::sim
