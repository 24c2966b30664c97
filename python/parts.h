// The parts of the module `_spall`, each in a file of its own. The package python/spall is what users import;
// it adds what is easier said in Python.
#pragma once
#include <pybind11/pybind11.h>

namespace python {

void add_errors(pybind11::module_& module);
void add_jobs(pybind11::module_& module);
void add_units(pybind11::module_& module);
void add_specimens(pybind11::module_& module);
void add_cards(pybind11::module_& module);
void add_virtual_tests(pybind11::module_& module);
void add_calibration(pybind11::module_& module);
void add_impact(pybind11::module_& module);
void add_study(pybind11::module_& module);
void add_files(pybind11::module_& module);

}  // namespace python
