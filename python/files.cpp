// The HDF5 files that runs leave, read without h5py.
#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <functional>
#include <map>
#include <variant>

#include "libdem/core/error.h"
#include "libdem/io/hdf5.h"
#include "python/job.h"
#include "python/parts.h"
#include "python/views.h"

namespace python {
namespace {

namespace py = pybind11;
using Values = std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>,
                            std::vector<std::int64_t>, std::vector<std::uint64_t>, std::vector<std::uint8_t>>;

struct Dataset {
  std::vector<std::size_t> shape;
  Values values;
};

/// The first of the types in which the dataset can be read without losing anything; the narrow ones first.
template <class T, class... Others>
Values read_as(const dem::Hdf5File& file, const std::string& name, std::size_t columns) {
  if constexpr (sizeof...(Others) == 0) {
    return file.read<T>(name, columns);
  } else {
    try {
      return file.read<T>(name, columns);
    } catch (const dem::InputError&) {
      return read_as<Others...>(file, name, columns);
    }
  }
}

std::map<std::string, Dataset> read_datasets(const std::filesystem::path& path) {
  const dem::Hdf5File file = dem::Hdf5File::open(path);
  std::map<std::string, Dataset> all;
  const std::function<void(const std::string&)> walk = [&](const std::string& group) {
    for (const std::string& name : file.names_in(group.empty() ? "/" : group)) {
      const std::string whole = group.empty() ? name : fmt::format("{}/{}", group, name);
      Dataset dataset;
      try {
        dataset.shape = file.shape(whole);
      } catch (const dem::InputError&) {  // a group
        walk(whole);
        continue;
      }
      if (dataset.shape.empty() || dataset.shape.size() > 2) continue;
      dataset.values = read_as<std::uint8_t, std::int32_t, std::int64_t, std::uint64_t, float, double>(
          file, whole, dataset.shape.size() == 2 ? dataset.shape[1] : 0);
      all.emplace(whole, std::move(dataset));
    }
  };
  walk("");
  return all;
}

py::dict read_file(const std::filesystem::path& path) {
  const auto all = run_job(py::none(), 1, [&](Job&) { return read_datasets(path); });
  py::dict dict;
  for (auto& [name, dataset] : *all) {
    const std::vector<py::ssize_t> shape(dataset.shape.begin(), dataset.shape.end());
    dict[py::str(name)] = std::visit(
        [&](const auto& values) -> py::array { return copy(values).reshape(shape); }, dataset.values);
  }
  return dict;
}

}  // namespace

void add_files(py::module_& module) {
  module.def(
      "read_hdf5", &read_file, py::arg("file"),
      "Every dataset of one or two dimensions in an HDF5 file, by its path (\"elements/centre\"), as numpy "
      "arrays.\nFor files that Spall wrote, where there is no h5py. Raises InputError.");
}

}  // namespace python
