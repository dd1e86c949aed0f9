#include "harness/python/module.h"

#include "harness/io/input_error.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, module) {
  module.doc() = "The compiled part of aisle.";
  py::register_exception<aisle::InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<aisle::MachineError>(module, "MachineError", PyExc_OSError);
  aisle::python::BindFrames(module);
  aisle::python::BindSimulator(module);
  aisle::python::BindScores(module);
  aisle::python::BindSlam(module);
  aisle::python::BindDrive(module);
}
