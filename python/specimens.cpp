// Numerical specimens in Python: made, read, cut, inspected; their columns as numpy views.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "libdem/config/nearest_name.h"
#include "libdem/core/error.h"
#include "python/job.h"
#include "python/parts.h"
#include "python/values.h"
#include "python/views.h"
#include "specimens/extract.h"
#include "specimens/inspect.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "specimens/representative.h"
#include "specimens/specimen_file.h"

namespace python {
namespace {

namespace py = pybind11;
using specimens::Specimen;
using SpecimenPointer = std::shared_ptr<Specimen>;

std::size_t choice(const std::string& given, const std::vector<std::string>& names, const std::string& where) {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == given) return k;
  throw dem::InputError(where, fmt::format("\"{}\" is none", given), dem::suggestion(given, names));
}

specimens::Shape shape_of(const std::string& name) {
  return choice(name, {"box", "cylinder"}, "shape") == 0 ? specimens::Shape::box : specimens::Shape::cylinder;
}

/// Three sides of a box, or diameter and length of a cylinder.
dem::Vec3 size_of(const py::handle& size, specimens::Shape shape) {
  dem::Vec3 result;
  if (shape == specimens::Shape::cylinder) {
    const std::vector<double> lengths = quantities(size, dem::Quantity::length, "size");
    if (lengths.size() != 2)
      throw dem::InputError("size", fmt::format("has {} number(s) instead of 2", lengths.size()),
                            "write a cylinder's diameter and length as in \"0.11x0.22 m\"");
    result = {lengths[0], lengths[0], lengths[1]};
  } else {
    result = three_lengths(size, "size", "0.5x0.25x0.25 m");
  }
  if (!(result.minCoeff() > 0))
    throw dem::InputError("size", "has a length that is not positive", "every length must be greater than 0");
  return result;
}

SpecimenPointer make(const py::object& size, std::int64_t elements, std::int64_t seed, const std::string& shape,
                     const std::string& grading, double size_ratio, double solid_fraction, int threads,
                     const py::object& progress) {
  specimens::PackingOptions options;
  options.shape = shape_of(shape);
  options.size = size_of(size, options.shape);
  if (elements < 1)
    throw dem::InputError("elements", fmt::format("is {}", elements), "a specimen has thousands of them");
  if (seed < 0) throw dem::InputError("seed", fmt::format("is {}", seed), "allowed: 0 or more");
  options.elements = static_cast<std::size_t>(elements);
  options.seed = static_cast<std::uint64_t>(seed);
  using Kind = specimens::Grading::Kind;
  constexpr Kind of[] = {Kind::uniform, Kind::lognormal, Kind::equal};
  options.grading.kind = of[choice(grading, {"uniform", "lognormal", "equal"}, "grading")];
  options.grading.size_ratio = size_ratio;
  options.solid_fraction = solid_fraction;
  options.validate();
  specimens::require_enough_elements(options.shape, options.size, options.elements);
  return run_job(progress, threads, [&](Job& job) {
    options.threads = job.threads();
    return specimens::make_specimen(options, job.progress());
  });
}

SpecimenPointer from_arrays(const py::object& size,
                            py::array_t<double, py::array::c_style | py::array::forcecast> centres,
                            py::array_t<double, py::array::c_style | py::array::forcecast> radii,
                            const std::string& shape, std::uint64_t seed, int threads) {
  if (centres.ndim() != 2 || centres.shape(1) != 3)
    throw dem::InputError("positions", "is not an array of n rows and 3 columns",
                          "give x, y, z [m] of each element");
  if (radii.ndim() != 1 || radii.shape(0) != centres.shape(0))
    throw dem::InputError("radii", "has not one number for each element",
                          "give as many radii [m] as positions");
  Specimen specimen;
  specimen.shape = shape_of(shape);
  specimen.size = size_of(size, specimen.shape);
  specimen.seed = seed;
  specimen.origin = "given as arrays";
  const auto count = static_cast<std::size_t>(radii.shape(0));
  specimen.radii.assign(radii.data(), radii.data() + count);
  for (std::size_t i = 0; i < count; ++i) {
    const double* row = centres.data() + 3 * i;
    const dem::Vec3 centre(row[0], row[1], row[2]);
    if (!centre.allFinite() || !(specimen.radii[i] > 0) || specimen.depth(centre) < 0)
      throw dem::InputError("positions",
                            fmt::format("element {} is no sphere with its centre inside the shape", i),
                            "centres lie in [0, size], radii are greater than 0");
    specimen.centres.push_back(centre);
  }
  return run_job(py::none(), threads, [&](Job& job) {
    specimens::link(specimen, job.threads());
    specimens::require_representative(specimen);
    return std::move(specimen);
  });
}

SpecimenPointer extract(const SpecimenPointer& whole, const py::object& centre, const py::object& size,
                        const std::string& shape) {
  const specimens::Shape cut = shape_of(shape);
  const dem::Vec3 at = three_lengths(centre, "centre", "1.25,1.0,0.14 m"), sides = size_of(size, cut);
  return run_job(py::none(), 0, [&](Job&) { return specimens::extract(*whole, cut, at, sides); });
}

py::object inspect(const SpecimenPointer& specimen) {
  const auto json = run_job(py::none(), 0, [&](Job&) {
    return nlohmann::ordered_json(specimens::to_json(specimens::inspect(*specimen)));
  });
  return to_python(*json);
}

py::array link_elements(const py::object& self) {
  const auto& links = self.cast<const Specimen&>().links;
  static_assert(offsetof(specimens::Link, b) == sizeof(std::int32_t));
  return view(links.empty() ? nullptr : &links.front().a, {static_cast<py::ssize_t>(links.size()), 2},
              {sizeof(specimens::Link), sizeof(std::int32_t)}, self);
}

py::tuple state_of(const py::object& self) {
  const auto& s = self.cast<const Specimen&>();
  const auto own = [](const py::array& array) { return array.attr("copy")(); };
  return py::make_tuple(static_cast<int>(s.shape), s.size.x(), s.size.y(), s.size.z(), s.seed,
                        s.interaction_radius_factor, own(view(s.centres, self)), own(view(s.radii, self)),
                        own(link_elements(self)), own(view(s.links, &specimens::Link::initial_distance, self)),
                        s.origin);
}

SpecimenPointer from_state(const py::tuple& state) {
  auto specimen = std::make_shared<Specimen>();
  specimen->shape = static_cast<specimens::Shape>(state[0].cast<int>());
  specimen->size = {state[1].cast<double>(), state[2].cast<double>(), state[3].cast<double>()};
  specimen->seed = state[4].cast<std::uint64_t>();
  specimen->interaction_radius_factor = state[5].cast<double>();
  const auto centres = state[6].cast<py::array_t<double, py::array::c_style>>();
  const auto radii = state[7].cast<py::array_t<double, py::array::c_style>>();
  const auto pairs = state[8].cast<py::array_t<std::int32_t, py::array::c_style>>();
  const auto lengths = state[9].cast<py::array_t<double, py::array::c_style>>();
  for (py::ssize_t i = 0; i < radii.shape(0); ++i) {
    specimen->centres.emplace_back(centres.at(i, 0), centres.at(i, 1), centres.at(i, 2));
    specimen->radii.push_back(radii.at(i));
  }
  for (py::ssize_t k = 0; k < lengths.shape(0); ++k)
    specimen->links.push_back({pairs.at(k, 0), pairs.at(k, 1), lengths.at(k)});
  specimen->origin = state[10].cast<std::string>();
  return specimen;
}

}  // namespace

void add_specimens(py::module_& module) {
  py::class_<Specimen, SpecimenPointer>(module, "Specimen",
                                        "A numerical specimen: where the elements are, which of them are "
                                        "linked, and the shape that it stands for.\n\n"
                                        "Nothing in it can be changed. The arrays are read-only views of its "
                                        "memory: they cost nothing, and keep the\n"
                                        "specimen alive as long as they live. SI units.")
      .def_property_readonly(
          "shape", [](const Specimen& s) { return std::string(specimens::name_of(s.shape)); },
          "\"box\", or \"cylinder\" with its axis along z.")
      .def_property_readonly(
          "size", [](const Specimen& s) { return py::make_tuple(s.size.x(), s.size.y(), s.size.z()); },
          "Sides [m]; of a cylinder diameter, diameter, length.")
      .def_readonly("seed", &Specimen::seed, "Of the packing.")
      .def_readonly("origin", &Specimen::origin, "In words: how it was made.")
      .def_readonly(
          "interaction_radius_factor", &Specimen::interaction_radius_factor,
          "A link joins two elements if their distance is at most this times the sum of their radii [-].")
      .def_property_readonly("elements", &Specimen::elements, "Number of elements N.")
      .def_property_readonly(
          "link_count", [](const Specimen& s) { return s.links.size(); }, "Number of links L.")
      .def_property_readonly("volume", &Specimen::volume, "Of the nominal shape [m3].")
      .def_property_readonly("element_size", &Specimen::element_size, "(volume / elements)^(1/3) [m].")
      .def_property_readonly(
          "positions", [](const py::object& self) { return view(self.cast<const Specimen&>().centres, self); },
          "(N, 3) float64: centres of the elements [m]. A read-only view.")
      .def_property_readonly(
          "radii", [](const py::object& self) { return view(self.cast<const Specimen&>().radii, self); },
          "(N,) float64: radii of the elements [m]. A read-only view.")
      .def_property_readonly(
          "links", &link_elements,
          "(L, 2) int32: the two elements of each link, the lower number first, sorted. A read-only "
          "view.")
      .def_property_readonly(
          "link_lengths",
          [](const py::object& self) {
            return view(self.cast<const Specimen&>().links, &specimens::Link::initial_distance, self);
          },
          "(L,) float64: distance of the two centres at rest [m]. A read-only view.")
      .def("sha256", &Specimen::sha256,
           "SHA-256 over shape, size, centres, radii and links: what results refer to.")
      .def(
          "write",
          [](const SpecimenPointer& s, const std::filesystem::path& file) {
            run_job(py::none(), 1, [&](Job&) { specimens::write_specimen(file, *s); });
          },
          py::arg("file"), "Write it as HDF5, whole or not at all. Raises RunError.")
      .def("extract", &extract, py::arg("centre"), py::arg("size"), py::arg("shape") = "box",
           "A smaller specimen cut out of this one and linked anew.\n\n"
           "centre, size: as \"1.25,1.0,0.14 m\" and \"0.28x0.28x0.28 m\", or three numbers in m (a cylinder's "
           "size:\n"
           "diameter and length). Raises InputError if the part does not lie inside, or is not representative.")
      .def("inspect", &inspect,
           "What there is to know about it, as a dict with the keys of `spall specimen inspect --json`: "
           "coordination,\n"
           "solid fraction, fabric eigenvalues, whether it is isotropic and representative, ... SI units.")
      .def(
          "__eq__", [](const Specimen& a, const Specimen& b) { return a.sha256() == b.sha256(); },
          py::is_operator())
      .def("__hash__", [](const Specimen& s) { return py::hash(py::str(s.sha256())); })
      .def("__repr__",
           [](const Specimen& s) {
             return fmt::format(
                 "<spall.Specimen: {} {:.4g} x {:.4g} x {:.4g} m, {} elements, {} links, seed {}>",
                 specimens::name_of(s.shape), s.size.x(), s.size.y(), s.size.z(), counted(s.elements()),
                 counted(s.links.size()), s.seed);
           })
      .def(py::pickle(&state_of, &from_state));
  module.def("make_specimen", &make, py::arg("size"), py::arg("elements"), py::arg("seed"), py::arg("shape"),
             py::arg("grading"), py::arg("size_ratio"), py::arg("solid_fraction"), py::arg("threads"),
             py::arg("progress"), "See spall.make_specimen.");
  module.def(
      "specimen_from_arrays", &from_arrays, py::arg("size"), py::arg("positions"), py::arg("radii"),
      py::arg("shape") = "box", py::arg("seed") = 0, py::arg("threads") = 0,
      "A specimen of spheres that you place yourself; links are found (mean interior coordination 12).\n\n"
      "size: as in make_specimen. positions: (N, 3) [m], inside the shape. radii: (N,) [m]. Both are copied.\n"
      "Raises InputError if there are too few elements inside to stand for the material.");
  module.def(
      "read_specimen",
      [](const std::filesystem::path& file) {
        return run_job(py::none(), 1, [&](Job&) { return specimens::read_specimen(file); });
      },
      py::arg("file"),
      "The specimen in an HDF5 file. Raises InputError if the file is of another kind or damaged.");
}

}  // namespace python
