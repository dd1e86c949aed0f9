#pragma once

#include <pybind11/pybind11.h>

namespace aisle::python {

/// Each tells Python of a part, in this order: later ones speak of earlier ones' types.
void BindFrames(pybind11::module_& module);
void BindSimulator(pybind11::module_& module);
void BindSlam(pybind11::module_& module);
void BindScores(pybind11::module_& module);
void BindDrive(pybind11::module_& module);

}  // namespace aisle::python
