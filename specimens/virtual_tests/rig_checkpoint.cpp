// What a laboratory test's checkpoint keeps besides the assembly.
#include <type_traits>

#include "specimens/virtual_tests/checkpoint_keeper.h"
#include "specimens/virtual_tests/rig_record.h"

namespace virtual_tests {
namespace {

/// Calls `visit(name, number)` for each number of the record: one list, for writing and for reading.
template <class Record, class Visit>
void for_each_number(Record& r, Visit&& visit) {
  visit("steps", r.steps);
  visit("window_steps", r.window_steps);
  visit("force", r.force);
  visit("opposing", r.opposing);
  visit("control", r.control);
  visit("broken", r.broken);
  visit("worst_imbalance", r.worst_imbalance);
  visit("peak", r.peak);
  visit("peak_index", r.peak_index);
  visit("ledger_external", r.ledger.external);
  visit("ledger_initial", r.ledger.initial);
  visit("ledger_kinetic", r.ledger.kinetic);
  visit("ledger_elastic", r.ledger.elastic);
  visit("ledger_softening", r.ledger.softening);
  visit("ledger_sliding", r.ledger.sliding);
  visit("ledger_damping", r.ledger.damping);
}

}  // namespace

dem::NamedNumbers numbers_of(const RigRecord& record, Rig& rig, const dem::Particles& particles, int rebuilds) {
  dem::NamedNumbers numbers;
  for_each_number(record, [&](const char* name, auto value) { numbers[name] = {static_cast<double>(value)}; });
  numbers["extra"] = record.extra;
  numbers["curve"] = record.curve.values;
  for (const CurvePoint& point : record.shape) {
    numbers["shape"].insert(numbers["shape"].end(), {point.strain, point.stress, point.unbalanced});
  }
  if (record.shape.empty()) numbers["shape"] = {};
  std::vector<double>& force = numbers["held_force"];
  for (std::size_t i = 0; i < particles.count; ++i)
    if (particles.prescribed[i] != 0)
      force.insert(force.end(), particles.force[i].value, particles.force[i].value + 6);
  for (const auto& [name, value] : rig.numbers()) numbers["rig_" + name] = {*value};
  record.film.keep_in(numbers);
  numbers["rebuilds"] = {static_cast<double>(record.rebuilds + rebuilds)};
  numbers["wall_seconds"] = {record.wall.seconds()};
  numbers["loop_seconds"] = {record.loop.seconds()};
  return numbers;
}

void set_from(RigRecord& record, Rig& rig, dem::Particles& particles, const dem::NamedNumbers& numbers,
              const std::filesystem::path& file) {
  const auto column = [&](const std::string& name, bool may_be_empty = false) -> const std::vector<double>& {
    return column_of(numbers, name, file, may_be_empty);
  };
  for_each_number(record, [&](const char* name, auto& value) {
    value = static_cast<std::remove_reference_t<decltype(value)>>(column(name)[0]);
  });
  record.extra = column("extra", true);
  record.curve.values = column("curve", true);
  const std::vector<double>& shape = column("shape", true);
  record.shape.clear();
  for (std::size_t k = 0; k + 2 < shape.size(); k += 3) {
    CurvePoint point;
    point.strain = shape[k], point.stress = shape[k + 1], point.unbalanced = shape[k + 2];
    record.shape.push_back(point);
  }
  const std::vector<double>& force = column("held_force", true);
  std::size_t at = 0;
  for (std::size_t i = 0; i < particles.count && at + 5 < force.size(); ++i)
    if (particles.prescribed[i] != 0)
      for (int c = 0; c < 6; ++c) particles.force[i].value[c] = force[at++];
  for (const auto& [name, value] : rig.numbers()) *value = column("rig_" + name)[0];
  record.film.restore(numbers, file);
  record.rebuilds = static_cast<int>(column("rebuilds")[0]);
  record.wall.before = column("wall_seconds")[0];
  record.loop.before = column("loop_seconds")[0];
}

}  // namespace virtual_tests
