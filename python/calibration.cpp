// Calibration in Python: a case from a file or from TOML text, its fit, and what came of it.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/calibrate_output.h"
#include "calibrate/pipeline.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "python/job.h"
#include "python/parts.h"
#include "python/values.h"
#include "python/views.h"

namespace python {
namespace {

namespace py = pybind11;
using calibrate::CalibrationCase;
using virtual_tests::CurvePoint;

/// A fit with the case that it answers.
struct Calibration {
  CalibrationCase wanted;
  calibrate::CalibrationResult found;
};
using CasePointer = std::shared_ptr<CalibrationCase>;

py::list targets_of(const CalibrationCase& wanted) {
  py::list list;
  for (const calibrate::Target& target : wanted.targets) {
    const calibrate::Display display = calibrate::display(target);
    py::dict one;
    one["name"] = std::string(calibrate::name_of(target));
    one["words"] = std::string(display.words);
    one["value"] = target.value;
    one["tolerance"] = target.tolerance;
    one["source"] = target.source;
    list.append(one);
  }
  return list;
}

py::dict curve_of(const virtual_tests::Curve& curve, const py::handle& self) {
  py::dict dict;
  dict["strain"] = view(curve, &CurvePoint::strain, self);
  dict["stress"] = view(curve, &CurvePoint::stress, self);
  dict["strain_axial"] = view(curve, &CurvePoint::strain_axial, self);
  dict["strain_lateral"] = view(curve, &CurvePoint::strain_lateral, self);
  dict["broken"] = view(curve, &CurvePoint::broken, self);
  return dict;
}

bool is_tension(const std::string& test) {
  if (test != "tension" && test != "compression")
    throw dem::InputError("test", fmt::format("\"{}\" has no curve in a calibration", test),
                          "allowed: tension, compression");
  return test == "tension";
}

py::list curves_of(const py::object& self, const std::string& test) {
  const bool tension = is_tension(test);
  py::list list;
  for (const calibrate::SpecimenOutcome& outcome : self.cast<const Calibration&>().found.specimens) {
    const virtual_tests::Curve& curve = tension ? outcome.tension.curve : outcome.compression.curve;
    if (curve.empty()) continue;
    py::dict dict = curve_of(curve, self);
    dict["label"] = outcome.label;
    dict["seen"] = outcome.seen;
    list.append(dict);
  }
  return list;
}

py::object laboratory_of(const py::object& self, const std::string& test) {
  const CalibrationCase& wanted = self.cast<const Calibration&>().wanted;
  const bool tension = is_tension(test);
  const auto& series = tension ? wanted.tension_series : wanted.compression_series;
  const auto& code = tension ? wanted.tension_reference : wanted.compression_reference;
  py::dict dict;
  if (series) {
    dict["strain"] = view(series->mean.strain, self);
    dict["stress"] = view(series->mean.stress, self);
    dict["low"] = view(series->low, self);
    dict["high"] = view(series->high, self);
    dict["source"] =
        fmt::format("mean of {} curve{}", series->curves.size(), series->curves.size() == 1 ? "" : "s");
  } else if (code) {
    dict["strain"] = view(code->strain, self);
    dict["stress"] = view(code->stress, self);
    dict["source"] = code->file;
  } else {
    return py::none();
  }
  return dict;
}

std::shared_ptr<Calibration> calibrate_case(const CasePointer& wanted, const std::filesystem::path& journal,
                                            bool resume, int threads, const py::object& progress) {
  if (resume && journal.empty())
    throw dem::InputError("resume", "is given without a journal", "name the file to go on from: journal=...");
  return run_job(progress, threads, [&](Job& job) {
    calibrate::TestJournal kept =
        journal.empty() ? calibrate::TestJournal() : calibrate::TestJournal(journal, resume);
    try {
      return Calibration{*wanted, calibrate::calibrate(*wanted, kept, job.threads(), job.progress())};
    } catch (const dem::InputError& error) {
      throw dem::InputError(wanted->file.string(), error.what(), "");
    } catch (const dem::Interrupted& stop) {
      if (journal.empty()) throw;
      throw dem::Interrupted(fmt::format("{}; {} virtual tests are kept in {}: go on with resume=True",
                                         stop.what(), kept.size(), journal.string()));
    }
  });
}

py::object part_of(const Calibration& fit, const char* key) {
  return to_python(app::result_of(fit.wanted, fit.found).at(key));
}

void write(const Calibration& fit, const std::filesystem::path& folder) {
  run_job(py::none(), 1, [&](Job&) {
    dem::require_writable_folder(folder);
    dem::write_file_atomically(folder / "card.toml", dem::to_toml(fit.found.card));
    dem::write_file_atomically(folder / "curves.csv", app::curves_csv(fit.wanted, fit.found));
    dem::write_file_atomically(folder / "result.json", app::result_of(fit.wanted, fit.found).dump(2) + "\n");
  });
}

}  // namespace

void add_calibration(py::module_& module) {
  py::class_<CalibrationCase, CasePointer>(
      module, "Case", "A calibration case that was read and checked: what a fit is to reach.")
      .def_readonly("name", &CalibrationCase::name)
      .def_readonly("concrete", &CalibrationCase::concrete, "In words.")
      .def_readonly("notes", &CalibrationCase::notes, "What a reader of the card should know.")
      .def_property_readonly("targets", &targets_of,
                             "list of dicts: name, words, value (SI), tolerance (relative), source.")
      .def("__repr__", [](const CalibrationCase& c) {
        return fmt::format("<spall.Case \"{}\": {} targets, {} specimens>", c.name, c.targets.size(),
                           c.fit_seeds.size() + c.fit_centres.size());
      });
  py::class_<Calibration, std::shared_ptr<Calibration>>(module, "Calibration",
                                                        "What a fit came to. Arrays are read-only views that "
                                                        "keep it alive. SI units; the direction of loading is "
                                                        "positive.")
      .def_property_readonly(
          "card", [](const Calibration& c) { return c.found.card; },
          "The fitted card, its quality in its provenance (a copy).")
      .def_property_readonly(
          "complete", [](const Calibration& c) { return c.found.complete(); },
          "Every target is met and every free parameter determined.")
      .def_property_readonly(
          "targets", [](const Calibration& c) { return part_of(c, "targets"); },
          "list of dicts, means over the fitted specimens: name, words, unit, scale, target, "
          "achieved, rel_error,\ntolerance, met, source.")
      .def_property_readonly(
          "unseen_targets", [](const Calibration& c) { return part_of(c, "unseen_targets"); },
          "The same over the specimens that the fit never saw.")
      .def_property_readonly(
          "history", [](const Calibration& c) { return part_of(c, "history"); },
          "list of dicts, one an evaluation: stage, evaluation, worst, T, zeta, Co, slip_softening.")
      .def_property_readonly(
          "parameters", [](const Calibration& c) { return part_of(c, "parameters"); },
          "list of dicts: name, relative_uncertainty, determined, at_bound, remark.")
      .def_property_readonly(
          "warnings", [](const Calibration& c) { return c.found.warnings; }, "In words.")
      .def_property_readonly(
          "virtual_tests", [](const Calibration& c) { return c.found.virtual_tests; },
          "How many were run or replayed.")
      .def_property_readonly("wall_seconds", [](const Calibration& c) { return c.found.wall_seconds; })
      .def("curves", &curves_of, py::arg("test"),
           "list of dicts for \"tension\" or \"compression\", one a specimen: label, seen, and (n,) float64 "
           "views\n"
           "strain, stress [Pa], strain_axial, strain_lateral, broken.")
      .def("laboratory", &laboratory_of, py::arg("test"),
           "What the fit aimed at: a dict with views strain, stress [Pa], of measured curves also low and "
           "high, and\n"
           "source; None where there is no such curve.")
      .def(
          "to_dict", [](const Calibration& c) { return to_python(app::result_of(c.wanted, c.found)); },
          "All of it, with the keys of the command line's result.json.")
      .def(
          "write", &write, py::arg("folder"),
          "Leave card.toml, result.json and curves.csv in a folder, each whole or not at all. Raises RunError.")
      .def("__repr__", [](const Calibration& c) {
        std::size_t met = 0;
        for (const auto& target : c.found.targets) met += target.met() ? 1 : 0;
        return fmt::format("<spall.Calibration \"{}\": {} of {} targets met, {} virtual tests>", c.wanted.name,
                           met, c.found.targets.size(), c.found.virtual_tests);
      });
  module.def(
      "read_case",
      [](const std::optional<std::filesystem::path>& file, const std::string& text, const std::string& name) {
        return run_job(py::none(), 0, [&](Job&) {
          return file ? calibrate::read_case(*file) : calibrate::case_of(dem::TomlTable::parse(text, name));
        });
      },
      py::arg("file"), py::arg("text"), py::arg("name"), "See spall.read_case.");
  module.def("calibrate", &calibrate_case, py::arg("case"), py::arg("journal"), py::arg("resume"),
             py::arg("threads"), py::arg("progress"), "See spall.calibrate.");
}

}  // namespace python
