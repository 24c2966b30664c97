// Spall's errors as Python's: the classes are written in Python (python/spall/_errors.py), so that they can be
// pickled and sent between processes like any other.
#include <pybind11/pybind11.h>

#include "libdem/core/error.h"
#include "python/parts.h"

namespace python {
namespace {

namespace py = pybind11;

void raise(const char* name, const py::tuple& arguments) {
  const py::object type = py::module_::import("spall._errors").attr(name);
  PyErr_SetObject(type.ptr(), type(*arguments).ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const dem::InputError& error) {
    raise("InputError", py::make_tuple(error.what(), error.where(), error.what_is_wrong(), error.remedy()));
  } catch (const dem::RunError& error) {
    raise("RunError", py::make_tuple(error.what()));
  } catch (const dem::Interrupted& error) {
    PyErr_SetString(PyExc_KeyboardInterrupt, error.what());
  }
}

}  // namespace

void add_errors(py::module_&) { py::register_exception_translator(&translate); }

}  // namespace python
