#include "study/rows.h"

#include <cmath>
#include <map>

namespace study {
namespace {

Row inputs_of(const Plan& plan, const Task& task) {
  const SpecimenRecipe& recipe = plan.specimen_of(task);
  const DesignPoint& point = plan.points[task.point];
  specimens::Specimen nominal;
  nominal.shape = recipe.packing.shape;
  nominal.size = recipe.packing.size;
  Row row;
  row.task = task.number;
  row.key = task.key;
  row.specimen = recipe.group;
  row.seed = recipe.packing.seed;
  row.shape = std::string(specimens::name_of(recipe.packing.shape));
  row.size = recipe.packing.size;
  row.elements = recipe.packing.elements;
  row.element_size = std::cbrt(nominal.volume() / static_cast<double>(recipe.packing.elements));
  row.card = plan.study.cards[task.card].name;
  row.point = task.point + 1;
  row.block = point.block;
  row.base = point.base;
  row.parameters = point.values;
  row.test = plan.test_of(task).name;
  row.kind = plan.test_of(task).kind;
  return row;
}

}  // namespace

double Row::number(const std::string& name) const { return number_of(values, name); }

RowTable read_rows(const Plan& plan, const StudyFolder& folder) {
  RowTable table;
  table.tasks = plan.tasks.size();
  for (const Parameter& parameter : plan.study.parameters) table.parameters.push_back(parameter.key);
  std::map<std::string, std::vector<std::pair<std::string, Value>>> known;  // tasks may share a result
  for (const Task& task : plan.tasks) {
    if (!folder.has_result(task.key)) {
      if (folder.has_failure(task.key)) table.failed.emplace_back(task.number, folder.read_failure(task.key));
      continue;
    }
    auto found = known.find(task.key);
    if (found == known.end()) found = known.emplace(task.key, folder.read_result(task.key).values).first;
    table.rows.push_back(inputs_of(plan, task));
    table.rows.back().values = found->second;
  }
  return table;
}

std::vector<Quantity> quantities_of(const Study& study) {
  std::vector<Quantity> list;
  for (const VirtualTest& test : study.tests) {
    const bool plain = test.name == name_of(test.kind);
    const auto add = [&](const char* key, const char* short_name) {
      list.push_back(
          {plain && *short_name != 0 ? std::string(short_name) : test.name + "." + key, test.name, key});
    };
    const auto short_name = [&](const std::string& key) {
      if (test.kind == TestKind::elastic) return key.c_str();
      if (key != "peak_stress") return "";
      return test.kind == TestKind::tension ? "ft" : test.kind == TestKind::compression ? "fc" : "";
    };
    const virtual_tests::TestDescription& description = virtual_tests::description_of(test.kind);
    for (const virtual_tests::MeasuredQuantity& measured : description.measured)
      add(measured.key.c_str(), short_name(measured.key));
    if (description.usual_rate > 0 || description.dynamic) add("damage", "");
  }
  return list;
}

Sample sample_of(const std::vector<const Row*>& rows, const Quantity& quantity) {
  Sample sample;
  for (const Row* row : rows) {
    if (row->test != quantity.test) continue;
    const double value = row->number(quantity.key);
    if (!std::isfinite(value)) continue;
    sample.rows.push_back(row);
    sample.values.push_back(value);
  }
  return sample;
}

Sample sample_of(const RowTable& table, const Quantity& quantity) {
  std::vector<const Row*> all;
  for (const Row& row : table.rows) all.push_back(&row);
  return sample_of(all, quantity);
}

std::vector<std::vector<const Row*>> rows_by_setting(const Plan& plan, const RowTable& table) {
  std::vector<std::vector<const Row*>> settings(plan.cards.size());
  for (const Row& row : table.rows) {
    const Task& task = plan.tasks[row.task - 1];
    settings[task.card * plan.points.size() + task.point].push_back(&row);
  }
  return settings;
}

}  // namespace study
