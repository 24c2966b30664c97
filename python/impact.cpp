// Impacts in Python: a scene from a file or from TOML text, its run, histories and fragments as arrays.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "impact/frames.h"
#include "impact/histories.h"
#include "impact/impact_output.h"
#include "impact/impact_run.h"
#include "impact/scene_file.h"
#include "libdem/core/atomic_file.h"
#include "libdem/core/error.h"
#include "libdem/probe/damage.h"
#include "python/job.h"
#include "python/parts.h"
#include "python/values.h"
#include "python/views.h"

namespace python {
namespace {

namespace py = pybind11;
using impact::Scene;
using ScenePointer = std::shared_ptr<Scene>;

struct Impact {
  Scene scene;
  impact::ImpactResult found;
  int threads = 1;
  std::vector<impact::HistoryColumn> history{};
};

template <class Value>
py::array vectors(std::size_t count, Value value) {
  std::vector<dem::Vec3> rows;
  rows.reserve(count);
  for (std::size_t i = 0; i < count; ++i) rows.push_back(value(i));
  return copy(rows);
}

/// The state of a run as arrays of their own: the run goes on and changes what a view would show.
py::dict dict_of(const impact::Frame& frame) {
  const dem::Particles& particles = frame.assembly->particles;
  const dem::Links& links = frame.assembly->links;
  const dem::LinkLaw& law = frame.assembly->law;
  const std::size_t count = particles.count;
  py::dict dict;
  dict["number"] = frame.number;
  dict["time"] = frame.time;
  dict["position"] = vectors(count, [&](std::size_t i) { return particles.kinematics[i].position(); });
  dict["displacement"] = vectors(count, [&](std::size_t i) { return particles.displacement(i); });
  dict["velocity"] = vectors(count, [&](std::size_t i) { return particles.kinematics[i].velocity(); });
  dict["radius"] = py::array(static_cast<py::ssize_t>(count), particles.radius.data());
  dict["damage"] = copy(dem::element_damage(law, links, count));
  std::vector<std::uint8_t> state;
  for (std::size_t k = 0; k < links.count; ++k) {
    const bool broken = law.is_broken(links.max_strain[k]);
    state.push_back(broken ? 2 : links.max_strain[k] > law.yield_strain() ? 1 : 0);
  }
  dict["link_state"] = copy(state);
  const auto pair_count = static_cast<py::ssize_t>(links.count);
  py::array_t<std::int32_t> pairs({pair_count, py::ssize_t{2}});
  for (py::ssize_t k = 0; k < pair_count; ++k) {
    pairs.mutable_at(k, 0) = links.a[static_cast<std::size_t>(k)];
    pairs.mutable_at(k, 1) = links.b[static_cast<std::size_t>(k)];
  }
  dict["links"] = pairs;
  if (frame.mesh != nullptr && frame.nodes != nullptr) {
    dict["node_position"] = copy(frame.mesh->nodes);
    dict["node_displacement"] = copy(frame.nodes->displacement);
  }
  const dem::Vec3& centre = frame.impactor.position;
  dict["impactor_position"] = py::make_tuple(centre.x(), centre.y(), centre.z());
  return dict;
}

std::shared_ptr<Impact> run_impact(const ScenePointer& scene, int threads, const py::object& progress,
                                   const py::object& frame, const std::optional<std::filesystem::path>& frames,
                                   const std::optional<std::filesystem::path>& checkpoint, bool resume) {
  if (resume && !checkpoint)
    throw dem::InputError("resume", "is given without a checkpoint",
                          "name the file to go on from: checkpoint=...");
  return run_job(progress, threads, [&](Job& job) {
    std::optional<impact::FrameWriter> writer;
    const impact::FrameCallback picture = [&](const impact::Frame& now) {
      if (frames) {
        const bool goes_on = resume && std::filesystem::exists(*checkpoint);
        if (!writer) writer.emplace(*scene, *frames, goes_on);
        writer->write(now);
      }
      if (!frame.is_none()) job.call_back([&] { frame(dict_of(now)); });
    };
    impact::ImpactCheckpoint keep;
    if (checkpoint) keep.file = *checkpoint;
    keep.resume = resume;
    Impact result{*scene,
                  impact::run_impact(*scene, job.threads(), job.progress(),
                                     frames || !frame.is_none() ? picture : impact::FrameCallback(), keep),
                  job.threads()};
    result.history = impact::history_columns(result.scene, result.found.history);
    std::error_code ignored;
    if (checkpoint) std::filesystem::remove(*checkpoint, ignored);
    return result;
  });
}

nlohmann::ordered_json json_of(const Impact& result) {
  return impact::result_of(result.scene, result.found, result.threads);
}

py::dict history_of(const py::object& self) {
  py::dict dict;
  for (const impact::HistoryColumn& column : self.cast<const Impact&>().history) {
    const auto rows = static_cast<py::ssize_t>(column.values.size() / column.components);
    const auto width = static_cast<py::ssize_t>(column.components);
    constexpr auto size = static_cast<py::ssize_t>(sizeof(double));
    dict[py::str(column.name)] = width == 1
                                     ? view(column.values, self)
                                     : view(column.values.data(), {rows, width}, {width * size, size}, self);
  }
  return dict;
}

py::dict history_units(const Impact& result) {
  py::dict dict;
  for (const impact::HistoryColumn& column : result.history) dict[py::str(column.name)] = column.unit;
  return dict;
}

py::dict fragments_of(const py::object& self) {
  using impact::Fragment;
  const impact::Fragments& found = self.cast<const Impact&>().found.fragments;
  const std::vector<Fragment>& list = found.fragments;
  const auto rows = static_cast<py::ssize_t>(list.size());
  const auto three = [&](const dem::Vec3 Fragment::*member) {
    return view(list.empty() ? nullptr : (list.front().*member).data(), {rows, 3},
                {static_cast<py::ssize_t>(sizeof(Fragment)), static_cast<py::ssize_t>(sizeof(double))}, self);
  };
  py::dict dict;
  dict["elements"] = view(list.empty() ? nullptr : &list.front().elements, {rows},
                          {static_cast<py::ssize_t>(sizeof(Fragment))}, self);
  dict["mass"] = view(list, &Fragment::mass, self);
  dict["kinetic_energy"] = view(list, &Fragment::kinetic_energy, self);
  dict["centre"] = three(&Fragment::centre);
  dict["velocity"] = three(&Fragment::velocity);
  dict["extent"] = three(&Fragment::extent);
  dict["of_element"] = view(found.of_element, self);
  return dict;
}

void write(const Impact& result, const std::filesystem::path& folder) {
  run_job(py::none(), 1, [&](Job&) {
    dem::require_writable_folder(folder);
    dem::write_file_atomically(folder / "curves.csv", impact::curves_csv(result.scene, result.found.history));
    impact::write_history(folder / "history.h5", result.scene, result.found.history);
    dem::write_file_atomically(folder / "fragments.csv", impact::fragments_csv(result.found.fragments));
    dem::write_file_atomically(folder / "result.json", json_of(result).dump(2) + "\n");
  });
}

}  // namespace

void add_impact(py::module_& module) {
  py::class_<Scene, ScenePointer>(module, "Scene", "An impact that was read and checked, ready to run.")
      .def_readonly("title", &Scene::title)
      .def_property_readonly(
          "model", [](const Scene& s) { return s.model == impact::Model::coupled ? "coupled" : "de"; },
          "\"de\": discrete elements throughout; \"coupled\": finite elements around them.")
      .def_property_readonly(
          "card", [](const Scene& s) { return s.card; }, "A copy of the card.")
      .def_property_readonly(
          "size", [](const Scene& s) { return py::make_tuple(s.size.x(), s.size.y(), s.size.z()); },
          "Of the structure [m].")
      .def_readonly("duration", &Scene::duration, "[s]")
      .def_readwrite("frames", &Scene::frames, "Pictures over the duration besides the first; 0: none.")
      .def("__repr__", [](const Scene& s) {
        return fmt::format("<spall.Scene \"{}\": {:.4g} x {:.4g} x {:.4g} m, {:.4g} s>", s.title, s.size.x(),
                           s.size.y(), s.size.z(), s.duration);
      });
  py::class_<Impact, std::shared_ptr<Impact>>(module, "Impact",
                                              "What an impact came to. Numbers by attribute or by key, with "
                                              "the keys of result.json. Arrays are read-only\n"
                                              "views that keep the result alive. SI units.")
      .def_property_readonly(
          "values", [](const Impact& r) { return to_python(json_of(r)); }, "dict with the keys of result.json.")
      .def_property_readonly(
          "history", &history_of,
          "dict by quantity of (n,) or (n, 3) float64, a row a sample: time [s], displacement/NAME "
          "of each probe [m],\nforce [N], impulse [N s], impactor_position [m], impactor_velocity "
          "[m/s], broken_links, energy/PART [J]. Views.")
      .def_property_readonly("history_units", &history_units, "SI unit by quantity of the history.")
      .def_property_readonly(
          "fragments", &fragments_of,
          "dict of the fragments, the heaviest (the main body) first: elements (F,), mass (F,) "
          "[kg], kinetic_energy (F,) [J],\ncentre, velocity, extent (F, 3) [m, m/s, m]; of_element "
          "(N,): the fragment of each element. Views.")
      .def_property_readonly(
          "warnings", [](const Impact& r) { return r.found.warnings; }, "In words.")
      .def("write", &write, py::arg("folder"),
           "Leave result.json, curves.csv, history.h5 and fragments.csv in a folder, each whole or not at all. "
           "Raises\n"
           "RunError.")
      .def(
          "__getitem__",
          [](const Impact& r, const std::string& key) -> py::object {
            const nlohmann::ordered_json json = json_of(r);
            if (!json.contains(key)) throw py::key_error(key);
            return to_python(json.at(key));
          },
          py::arg("key"))
      .def(
          "__getattr__",
          [](const Impact& r, const std::string& name) -> py::object {
            const nlohmann::ordered_json json = json_of(r);
            if (!json.contains(name))
              throw py::attribute_error(fmt::format("an impact has no \"{}\"; see result.values", name));
            return to_python(json.at(name));
          },
          py::arg("name"))
      .def("__repr__", [](const Impact& r) {
        return fmt::format("<spall.Impact \"{}\": {} elements, {} of {} links broken, peak force {:.4g} kN>",
                           r.scene.title, counted(r.found.elements), r.found.broken_links, r.found.links,
                           r.found.peak_force / 1e3);
      });
  module.def(
      "read_scene",
      [](const std::optional<std::filesystem::path>& file, const std::string& text, const std::string& name,
         const std::optional<std::filesystem::path>& card) {
        return run_job(py::none(), 0, [&](Job&) {
          return file ? impact::read_scene(*file, card)
                      : impact::scene_of(dem::TomlTable::parse(text, name), card);
        });
      },
      py::arg("file"), py::arg("text"), py::arg("name"), py::arg("card"), "See spall.read_scene.");
  module.def("run_impact", &run_impact, py::arg("scene"), py::arg("threads"), py::arg("progress"),
             py::arg("frame"), py::arg("frames"), py::arg("checkpoint"), py::arg("resume"),
             "See spall.run_impact.");
}

}  // namespace python
