// The compiled half of the Python module `spall`.
#include <pybind11/pybind11.h>

#include "python/parts.h"
#include "python/version.h"

PYBIND11_MODULE(_spall, module) {
  module.doc() =
      "The compiled half of spall: specimens, cards, virtual tests, calibration, impact, studies. Import "
      "spall, "
      "not this.";
  module.attr("__version__") = python::version;
  python::add_errors(module);
  python::add_jobs(module);
  python::add_units(module);
  python::add_specimens(module);
  python::add_cards(module);
  python::add_virtual_tests(module);
  python::add_calibration(module);
  python::add_impact(module);
  python::add_study(module);
  python::add_files(module);
}
