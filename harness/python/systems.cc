#include "harness/python/systems.h"

#include "harness/plugs/systems.h"

namespace py = pybind11;

namespace aisle::python {
namespace {

/// As a suite file would have it written.
std::string TextOf(const py::handle& value) {
  if (py::isinstance<py::bool_>(value)) return py::cast<bool>(value) ? "true" : "false";
  return py::cast<std::string>(py::str(value));
}

}  // namespace

SystemSpec SpecFrom(const std::string& system, const py::dict& options) {
  std::vector<std::string> assignments;
  for (const auto& [path, value] : options) {
    assignments.push_back(py::cast<std::string>(path) + "=" + TextOf(value));
  }
  SystemSpec spec = BuiltIn(system);
  spec.options = OptionsFromText(assignments, FindSystem(system));
  return spec;
}

}  // namespace aisle::python
