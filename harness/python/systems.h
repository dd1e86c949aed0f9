#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "harness/contract/system_spec.h"

namespace aisle::python {

/// A built-in system with options set. Throws InputError for a name or an option that is none.
SystemSpec SpecFrom(const std::string& system, const pybind11::dict& options);

}  // namespace aisle::python
