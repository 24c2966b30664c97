// Virtual laboratory tests in Python: the catalogue, one function that runs any of them, results.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "libdem/config/nearest_name.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "python/job.h"
#include "python/parts.h"
#include "python/values.h"
#include "python/views.h"
#include "specimens/virtual_tests/catalogue.h"
#include "specimens/virtual_tests/fields.h"

namespace python {
namespace {

namespace py = pybind11;
using virtual_tests::TestDescription;
using virtual_tests::TestOption;
using virtual_tests::TestOutcome;
using SpecimenPointer = std::shared_ptr<specimens::Specimen>;

/// What a test came to, and what it was run with.
struct TestResult {
  const TestDescription* test = nullptr;
  SpecimenPointer specimen;
  dem::MaterialCard card;
  virtual_tests::TestOptions options;
  TestOutcome found;

  const specimens::Specimen& tested() const { return found.tested ? *found.tested : *specimen; }
};

const TestDescription& test_called(const std::string& name) {
  const TestDescription* test = virtual_tests::find_test(name);
  if (test == nullptr)
    throw dem::InputError("test", fmt::format("there is no test \"{}\"", name),
                          dem::suggestion(name, virtual_tests::names_of_tests()));
  return *test;
}

virtual_tests::Value value_of(const TestOption& option, const py::handle& given, const std::string& where) {
  const auto shown = [&] { return py::repr(given).cast<std::string>(); };
  switch (option.kind) {
    case TestOption::Kind::flag:
      if (!py::isinstance<py::bool_>(given))
        throw dem::InputError(where, fmt::format("{} is neither True nor False", shown()), "give one of them");
      return given.cast<bool>();
    case TestOption::Kind::choice: {
      const std::string word = py::str(given).cast<std::string>();
      for (const std::string& choice : option.choices)
        if (choice == word) return word;
      throw dem::InputError(where, fmt::format("{} is none", shown()), dem::suggestion(word, option.choices));
    }
    case TestOption::Kind::number: {
      const double number = quantity(given, option.quantity, where);
      if (!(number >= option.low && number <= option.high))
        throw dem::InputError(where, fmt::format("is {}", number),
                              fmt::format("allowed: {} to {}", option.low, option.high));
      return number;
    }
    case TestOption::Kind::quantity:
      break;
  }
  const double number = quantity(given, option.quantity, where);
  if (!(number > option.low))
    throw dem::InputError(
        where,
        option.low == 0 ? fmt::format("{} is not positive", shown()) : fmt::format("{} is too little", shown()),
        fmt::format("allowed: above {:.4g} {}", option.low, dem::si_unit(option.quantity)));
  if (!(number <= option.high))
    throw dem::InputError(where, fmt::format("{} is too much", shown()),
                          fmt::format("allowed: up to {:.4g} {}", option.high, dem::si_unit(option.quantity)));
  return number;
}

virtual_tests::TestOptions options_of(const TestDescription& test, const py::dict& given) {
  virtual_tests::TestOptions options = test.defaults;
  std::vector<std::string> known;
  for (const TestOption& option : test.options) known.push_back(option.key);
  std::vector<std::string> used;
  for (const auto& [name, value] : given) {
    const std::string key = name.cast<std::string>(), where = test.name + ": " + key;
    const TestOption* found = nullptr;
    for (const TestOption& option : test.options)
      if (option.key == key) found = &option;
    if (found == nullptr)
      throw dem::InputError(test.name, fmt::format("has no option \"{}\"", key), dem::suggestion(key, known));
    if (value.is_none()) continue;  // as if it were not given
    found->set(options, value_of(*found, value, where));
    used.push_back(key);
  }
  const auto has = [&](const char* key) { return std::find(used.begin(), used.end(), key) != used.end(); };
  if (has("velocity") && has("rate"))
    throw dem::InputError(test.name + ": rate", "stands beside velocity",
                          "give one of them: both set the speed");
  return options;
}

std::shared_ptr<TestResult> run_test(const std::string& name, const SpecimenPointer& specimen,
                                     const dem::MaterialCard& card, const py::dict& options, int threads,
                                     const py::object& progress,
                                     const std::optional<std::filesystem::path>& checkpoint, bool resume) {
  auto result = std::make_shared<TestResult>();
  result->test = &test_called(name);
  result->specimen = specimen;
  result->card = card;  // a copy: the caller may go on changing theirs
  result->options = options_of(*result->test, options);
  card.validate("card");
  if (resume && !checkpoint)
    throw dem::InputError("resume", "is given without a checkpoint",
                          "name the file to go on from: checkpoint=...");
  run_job(progress, threads, [&](Job& job) {
    virtual_tests::set_threads(result->options, job.threads());
    result->test->check(*specimen, result->card, result->options);
    virtual_tests::CheckpointPolicy policy;
    if (checkpoint) policy.file = *checkpoint;
    policy.resume = resume;
    result->found = virtual_tests::run_test(*specimen, result->card, result->options, job.progress(), policy);
    std::error_code ignored;  // a finished test needs none; one that stays does no harm
    if (checkpoint) std::filesystem::remove(*checkpoint, ignored);
  });
  return result;
}

py::dict values_of(const TestResult& result) {
  py::dict values;
  for (const auto& [key, value] : virtual_tests::values_of(result.found))
    values[py::str(key)] = to_python(value);
  return values;
}

py::dict curve_of(const py::object& self) {
  const auto& curve = self.cast<const TestResult&>().found.curve;
  py::dict columns;
  const auto width = static_cast<py::ssize_t>(sizeof(double) * curve.columns.size());
  for (std::size_t c = 0; c < curve.columns.size(); ++c)
    columns[py::str(curve.columns[c].name)] = view(curve.values.empty() ? nullptr : curve.values.data() + c,
                                                   {static_cast<py::ssize_t>(curve.rows())}, {width}, self);
  return columns;
}

py::dict curve_units(const TestResult& result) {
  py::dict units;
  for (const auto& column : result.found.curve.columns) units[py::str(column.name)] = column.unit;
  return units;
}

py::dict fields_of(const py::object& self) {
  const auto& fields = self.cast<const TestResult&>().found.fields;
  py::dict dict;
  if (fields.damage.empty()) return dict;
  dict["damage"] = view(fields.damage, self);
  dict["displacement"] = view(fields.displacement, self);
  static_assert(sizeof(virtual_tests::LinkState) == sizeof(std::uint8_t));
  dict["link_state"] = view(reinterpret_cast<const std::uint8_t*>(fields.link_state.data()),
                            {static_cast<py::ssize_t>(fields.link_state.size())}, {sizeof(std::uint8_t)}, self);
  dict["link_strain"] = view(fields.link_strain, self);
  return dict;
}

nlohmann::ordered_json json_of(const TestResult& result) {
  nlohmann::ordered_json json;
  json["test"] = result.test->name;
  for (const auto& [key, value] : virtual_tests::values_of(result.found))
    json[key] = std::visit([](const auto& held) { return nlohmann::ordered_json(held); }, value);
  json["elements"] = result.tested().elements();
  json["wall_seconds"] = result.found.wall_seconds;
  return json;
}

void write(const TestResult& result, const std::filesystem::path& folder) {
  run_job(py::none(), 1, [&](Job&) {
    dem::require_writable_folder(folder);
    if (!result.found.curve.empty())
      dem::write_file_atomically(folder / "curves.csv", virtual_tests::to_csv(result.found.curve));
    if (!result.found.fields.damage.empty()) {
      virtual_tests::write_element_fields(folder / "fields.h5", result.tested(), result.found.fields);
      virtual_tests::write_link_fields(folder / "links.h5", result.tested(), result.found.fields);
    }
    dem::write_file_atomically(folder / "card.toml", dem::to_toml(result.card));
    dem::write_file_atomically(folder / "result.json", json_of(result).dump(2) + "\n");
  });
}

py::object check_rate(const TestResult& result, int threads, const py::object& progress) {
  const auto check = run_job(progress, threads, [&](Job& job) {
    virtual_tests::TestOptions options = result.options;
    virtual_tests::set_threads(options, job.threads());
    return virtual_tests::check_rate(*result.specimen, result.card, options, result.found, job.progress());
  });
  if (!*check) return py::none();
  py::dict dict;
  dict["quantity"] = (*check)->quantity;
  dict["velocity"] = (*check)->velocity;
  dict["value"] = (*check)->value;
  dict["change"] = (*check)->change;
  return dict;
}

py::list catalogue() {
  py::list list;
  for (const TestDescription& test : virtual_tests::catalogue()) {
    py::dict entry;
    entry["name"] = test.name;
    entry["summary"] = test.summary;
    py::list options;
    for (const TestOption& option : test.options) {
      constexpr const char* kinds[] = {"quantity", "number", "choice", "flag"};
      py::dict one;
      one["key"] = option.key;
      one["kind"] = kinds[static_cast<int>(option.kind)];
      one["unit"] = option.kind == TestOption::Kind::quantity ? std::string(dem::si_unit(option.quantity)) : "";
      one["example"] =
          option.kind == TestOption::Kind::quantity ? std::string(dem::example(option.quantity)) : "";
      one["choices"] = option.choices;
      one["default"] = option.fallback;
      one["help"] = option.help;
      options.append(one);
    }
    entry["options"] = options;
    py::list measured;
    for (const auto& quantity : test.measured) {
      py::dict one;
      one["key"] = quantity.key;
      one["unit"] = quantity.unit;
      one["words"] = quantity.words;
      measured.append(one);
    }
    entry["measured"] = measured;
    entry["steps"] = test.usual_rate > 0 || test.dynamic;
    list.append(entry);
  }
  return list;
}

}  // namespace

void add_virtual_tests(py::module_& module) {
  py::class_<TestResult, std::shared_ptr<TestResult>>(
      module, "TestResult",
      "What a virtual test came to. Numbers by attribute or by key: result.peak_stress, "
      "result[\"peak_stress\"]; the\n"
      "keys are those of result.json. Arrays are read-only views that keep the result alive. SI units; the "
      "direction\n"
      "of loading is positive.")
      .def_property_readonly(
          "test", [](const TestResult& r) { return r.test->name; }, "The test's name.")
      .def_property_readonly(
          "card", [](const TestResult& r) { return r.card; }, "A copy of the card.")
      .def_property_readonly(
          "specimen",
          [](const std::shared_ptr<TestResult>& r) {  // what was cut lives in the result
            return r->found.tested ? SpecimenPointer(r, &*r->found.tested) : r->specimen;
          },
          "The specimen as it was tested: cut, for instance, where it got a notch. The fields are of its "
          "elements.")
      .def_property_readonly(
          "values", &values_of,
          "dict of all numbers and settings, with the keys of result.json: what the test measures "
          "first, then steps,\nenergy_balance_error, state_sha256, ...")
      .def_property_readonly(
          "curve", &curve_of,
          "dict of (n,) float64 by column, as \"strain\" and \"stress\"; a row for each window of "
          "time steps.\nEmpty after an elastic test. Read-only views.")
      .def_property_readonly("curve_units", &curve_units, "SI unit by column of the curve.")
      .def_property_readonly(
          "fields", &fields_of,
          "dict of the fields at the end: damage (N,) float64, broken over initial links; displacement (N, 3) "
          "float64\n"
          "[m]; link_state (L,) uint8: 0 intact, 1 softening, 2 broken; link_strain (L,) float64, elongation "
          "over\n"
          "length at rest. N, L of `specimen`. Empty after an elastic test. Read-only views.")
      .def_property_readonly(
          "wall_seconds", [](const TestResult& r) { return r.found.wall_seconds; }, "Of the whole test [s].")
      .def(
          "curve_csv", [](const TestResult& r) { return virtual_tests::to_csv(r.found.curve); },
          "The curve as CSV, units in its header.")
      .def("write", &write, py::arg("folder"),
           "Leave result.json, card.toml, curves.csv, fields.h5 and links.h5 (VTKHDF, for ParaView) in a "
           "folder, each\n"
           "whole or not at all. Raises RunError.")
      .def("check_rate", &check_rate, py::arg("threads") = 0, py::arg("progress") = py::none(),
           "Run it once more at half the speed: {\"quantity\", \"velocity\" [m/s], \"value\", \"change\"}, the "
           "change of the\n"
           "main quantity relative. None for a test without time steps.")
      .def(
          "__getitem__",
          [](const TestResult& r, const std::string& key) -> py::object {
            const py::dict values = values_of(r);
            if (!values.contains(key)) throw py::key_error(key);
            return values[py::str(key)];
          },
          py::arg("key"))
      .def(
          "__getattr__",
          [](const TestResult& r, const std::string& name) -> py::object {
            const py::dict values = values_of(r);
            if (!values.contains(name))
              throw py::attribute_error(
                  fmt::format("the result of {} has no \"{}\"; see result.values", r.test->name, name));
            return values[py::str(name)];
          },
          py::arg("name"))
      .def("__dir__",
           [](const py::object& self) {
             py::list names =
                 py::module_::import("builtins")
                     .attr("list")(py::module_::import("builtins").attr("object").attr("__dir__")(self));
             for (const auto& [key, value] : values_of(self.cast<const TestResult&>())) names.append(key);
             return names;
           })
      .def("__repr__", [](const TestResult& r) {
        std::string line;
        for (const auto& [key, value] : r.found.measured)
          line += fmt::format("{}{} {:.5g}", line.empty() ? "" : ", ", key, value);
        return fmt::format("<spall.TestResult of {}: {}>", r.test->name, line);
      });
  module.def("run_test", &run_test, py::arg("name"), py::arg("specimen"), py::arg("card"), py::arg("options"),
             py::arg("threads"), py::arg("progress"), py::arg("checkpoint"), py::arg("resume"),
             "See spall.run_test.");
  module.def("catalogue", &catalogue,
             "Every virtual test as a dict: name, summary, options (key, kind, unit, example, choices, "
             "default, help),\n"
             "measured (key, unit, words), steps (whether it has time steps).");
}

}  // namespace python
