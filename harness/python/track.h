#pragma once

#include <pybind11/pybind11.h>

#include "harness/contract/estimate.h"

namespace aisle::python {

/// A Trajectory as Python has it: an object, not a list.
struct Track {
  Trajectory poses;
};

void BindTrack(pybind11::module_& module);

}  // namespace aisle::python
