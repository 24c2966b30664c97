// Studies in Python: the plan, the run of what is missing, the rows.
#include <fmt/format.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "libdem/core/error.h"
#include "python/job.h"
#include "python/parts.h"
#include "python/values.h"
#include "study/plan.h"
#include "study/rows.h"
#include "study/runner.h"
#include "study/status.h"
#include "study/study_result.h"

namespace python {
namespace {

namespace py = pybind11;
using study::Plan;
using PlanPointer = std::shared_ptr<Plan>;

py::list tasks_of(const Plan& plan) {
  py::list list;
  for (const study::Task& task : plan.tasks) {
    const study::SpecimenRecipe& recipe = plan.specimen_of(task);
    py::dict row;
    row["task"] = task.number;
    row["specimen"] = recipe.group;
    row["seed"] = recipe.packing.seed;
    row["elements"] = recipe.packing.elements;
    row["card"] = plan.study.cards[task.card].name;
    row["point"] = task.point + 1;
    for (std::size_t p = 0; p < plan.study.parameters.size(); ++p)
      row[py::str("card." + plan.study.parameters[p].key)] = plan.points[task.point].values[p];
    row["test"] = plan.test_of(task).name;
    row["key"] = task.key;
    row["seconds"] = task.seconds;
    row["bytes"] = task.bytes;
    list.append(row);
  }
  return list;
}

py::list rows_of(const study::RowTable& table) {
  py::list list;
  for (const study::Row& row : table.rows) {
    py::dict one;
    one["task"] = row.task;
    one["specimen"] = row.specimen;
    one["shape"] = row.shape;
    one["seed"] = row.seed;
    one["size_x"] = row.size.x();
    one["size_y"] = row.size.y();
    one["size_z"] = row.size.z();
    one["elements"] = row.elements;
    one["element_size"] = row.element_size;
    one["card"] = row.card;
    one["point"] = row.point;
    for (std::size_t p = 0; p < table.parameters.size(); ++p)
      one[py::str("card." + table.parameters[p])] = row.parameters[p];
    one["test"] = row.test;
    one["kind"] = std::string(study::name_of(row.kind));
    for (const auto& [key, value] : row.values) one[py::str(key)] = to_python(value);
    list.append(one);
  }
  return list;
}

/// Rows, failed tasks and result.json of what is in the folder now.
py::tuple read(const PlanPointer& plan, const std::filesystem::path& folder) {
  struct Read {
    study::RowTable table;
    nlohmann::ordered_json result;
  };
  const auto found = run_job(py::none(), 1, [&](Job&) {
    if (!std::filesystem::is_directory(folder))
      throw dem::InputError(folder.string(), "there is no such folder",
                            "give the folder that a study has filled");
    study::RowTable table = study::read_rows(*plan, study::StudyFolder(folder));
    nlohmann::ordered_json result = study::result_json(*plan, table);
    return Read{std::move(table), std::move(result)};
  });
  return py::make_tuple(rows_of(found->table), found->table.failed, to_python(found->result));
}

std::size_t run(const PlanPointer& plan, const std::filesystem::path& folder, const std::string& tasks,
                int threads, double memory, bool retry_failed, const py::object& progress) {
  const std::vector<std::size_t> chosen = study::choose_tasks(*plan, tasks, "tasks");
  return *run_job(progress, threads, [&](Job& job) {
    study::RunOptions options;
    options.threads = job.threads();
    options.memory = memory;
    options.retry_failed = retry_failed;
    try {
      return study::run_tasks(*plan, chosen, study::StudyFolder(folder), options, job.progress()).ran;
    } catch (const dem::Interrupted& stop) {
      throw dem::Interrupted(
          fmt::format("{}; what is finished is in {}: the same call goes on", stop.what(), folder.string()));
    }
  });
}

py::dict status_of(const PlanPointer& plan, const std::filesystem::path& folder) {
  const auto status =
      run_job(py::none(), 1, [&](Job&) { return study::status_of(*plan, study::StudyFolder(folder)); });
  py::dict dict;
  dict["done"] = status->done;
  dict["failed"] = status->failed;
  dict["running"] = status->running;
  dict["missing"] = status->missing;
  dict["core_seconds_left"] = status->seconds_left;
  return dict;
}

}  // namespace

void add_study(py::module_& module) {
  py::class_<Plan, PlanPointer>(module, "Plan", "A study that was read, checked and expanded into its tasks.")
      .def_property_readonly("name", [](const Plan& p) { return p.study.name; })
      .def_property_readonly(
          "parameters",
          [](const Plan& p) {
            std::vector<std::string> keys;
            for (const auto& parameter : p.study.parameters) keys.push_back(parameter.key);
            return keys;
          },
          "Keys of the card that vary.")
      .def_property_readonly(
          "tasks", &tasks_of,
          "list of dicts: task, specimen, seed, elements, card, point, card.KEY of what varies "
          "(SI), test, key, seconds, bytes (estimates).")
      .def(
          "__len__", [](const Plan& p) { return p.tasks.size(); }, "Number of tasks.")
      .def("status", &status_of, py::arg("folder"),
           "How far it is: dict of done, failed, running, missing tasks and core_seconds_left.")
      .def("__repr__", [](const Plan& p) {
        return fmt::format("<spall.Plan \"{}\": {} tasks>", p.study.name, p.tasks.size());
      });
  module.def(
      "plan_study",
      [](const std::optional<std::filesystem::path>& file, const std::string& text, const std::string& name) {
        return run_job(py::none(), 0, [&](Job&) {
          return study::make_plan(file ? study::read_study(*file)
                                       : study::study_of(dem::TomlTable::parse(text, name)));
        });
      },
      py::arg("file"), py::arg("text"), py::arg("name"), "See spall.plan_study.");
  module.def("run_study", &run, py::arg("plan"), py::arg("folder"), py::arg("tasks"), py::arg("threads"),
             py::arg("memory"), py::arg("retry_failed"), py::arg("progress"), "See spall.run_study.");
  module.def("read_study", &read, py::arg("plan"), py::arg("folder"), "See spall.read_study.");
}

}  // namespace python
