#include "python/values.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "libdem/config/nearest_name.h"
#include "libdem/core/error.h"
#include "python/parts.h"

namespace python {
namespace py = pybind11;

double quantity(py::handle value, dem::Quantity kind, const std::string& where) {
  if (py::isinstance<py::str>(value)) return dem::parse_quantity(value.cast<std::string>(), kind, where);
  const std::string remedy = kind == dem::Quantity::ratio
                                 ? "give a number"
                                 : fmt::format("write it as in \"{}\", or give a number in {}",
                                               dem::example(kind), dem::si_unit(kind));
  const auto refuse = [&]() -> double {
    throw dem::InputError(where, fmt::format("{} is no quantity", py::repr(value).cast<std::string>()), remedy);
  };
  if (py::isinstance<py::bool_>(value) || PyNumber_Check(value.ptr()) == 0) return refuse();
  const double number = PyFloat_AsDouble(value.ptr());
  if (PyErr_Occurred() != nullptr) {
    PyErr_Clear();
    return refuse();
  }
  if (!std::isfinite(number)) return refuse();
  return number;
}

std::vector<double> quantities(py::handle value, dem::Quantity kind, const std::string& where) {
  if (py::isinstance<py::str>(value)) return dem::parse_quantities(value.cast<std::string>(), kind, where);
  if (!py::hasattr(value, "__iter__"))
    throw dem::InputError(where,
                          fmt::format("{} is no list of quantities", py::repr(value).cast<std::string>()),
                          "give text with one unit at its end, or a sequence");
  std::vector<double> list;
  for (const py::handle item : py::iter(value)) list.push_back(quantity(item, kind, where));
  return list;
}

dem::Vec3 three_lengths(py::handle value, const std::string& where, const std::string& example) {
  const std::vector<double> lengths = quantities(value, dem::Quantity::length, where);
  if (lengths.size() != 3)
    throw dem::InputError(where, fmt::format("has {} number(s) instead of 3", lengths.size()),
                          fmt::format("write it as in \"{}\", or give three numbers in m", example));
  return {lengths[0], lengths[1], lengths[2]};
}

py::object to_python(const virtual_tests::Value& value) {
  return std::visit([](const auto& held) -> py::object { return py::cast(held); }, value);
}

py::object to_python(const nlohmann::ordered_json& json) {
  if (json.is_object()) {
    py::dict dict;
    for (const auto& [key, value] : json.items()) dict[py::str(key)] = to_python(value);
    return dict;
  }
  if (json.is_array()) {
    py::list list;
    for (const auto& value : json) list.append(to_python(value));
    return list;
  }
  if (json.is_boolean()) return py::bool_(json.get<bool>());
  if (json.is_number_unsigned()) return py::int_(json.get<std::uint64_t>());
  if (json.is_number_integer()) return py::int_(json.get<std::int64_t>());
  if (json.is_number_float()) return py::float_(json.get<double>());
  if (json.is_string()) return py::str(json.get<std::string>());
  return py::none();
}

std::string counted(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::ptrdiff_t at = static_cast<std::ptrdiff_t>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), 1, ',');
  return text;
}

namespace {

const std::vector<std::pair<std::string, dem::Quantity>>& kinds() {
  static const std::vector<std::pair<std::string, dem::Quantity>> all{
      {"length", dem::Quantity::length},   {"velocity", dem::Quantity::velocity},
      {"time", dem::Quantity::time},       {"mass", dem::Quantity::mass},
      {"density", dem::Quantity::density}, {"force", dem::Quantity::force},
      {"stress", dem::Quantity::stress},   {"fracture_energy", dem::Quantity::fracture_energy},
      {"angle", dem::Quantity::angle},     {"ratio", dem::Quantity::ratio}};
  return all;
}

double to_si(const py::object& value, const std::string& kind) {
  std::vector<std::string> names;
  for (const auto& [name, of] : kinds()) {
    if (name == kind) return quantity(value, of, "value");
    names.push_back(name);
  }
  throw dem::InputError("kind", fmt::format("\"{}\" is no kind of quantity", kind),
                        dem::suggestion(kind, names));
}

}  // namespace

void add_units(py::module_& module) {
  module.def(
      "si", &to_si, py::arg("value"), py::arg("kind"),
      "The SI number of a quantity: si(\"24 GPa\", \"stress\") is 2.4e10. A number is taken as it is.\n\n"
      "kind: length, velocity, time, mass, density, force, stress, fracture_energy, angle or ratio. Raises\n"
      "InputError for a unit that is missing, unknown or of another kind.");
}

}  // namespace python
