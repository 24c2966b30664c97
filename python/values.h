// Between Python's values and ours: quantities with units, results, JSON.
#pragma once
#include <pybind11/pybind11.h>

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "libdem/config/toml_reader.h"
#include "libdem/core/units.h"
#include "libdem/core/vector.h"
#include "specimens/virtual_tests/outcome.h"

namespace python {

/// Text with its unit ("24 GPa"), or a number in SI units. Throws InputError that begins with `where`.
double quantity(pybind11::handle value, dem::Quantity kind, const std::string& where);
/// "0.5x0.25x0.25 m", or a sequence of quantities.
std::vector<double> quantities(pybind11::handle value, dem::Quantity kind, const std::string& where);
/// Three of them.
dem::Vec3 three_lengths(pybind11::handle value, const std::string& where, const std::string& example);

pybind11::object to_python(const virtual_tests::Value& value);
pybind11::object to_python(const nlohmann::ordered_json& json);

/// The words for arrays and results that repr() shows: "12,345".
std::string counted(std::size_t number);

}  // namespace python
