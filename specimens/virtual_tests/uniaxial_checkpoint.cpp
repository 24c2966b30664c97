#include "specimens/virtual_tests/uniaxial_checkpoint.h"

#include <fmt/format.h>

#include <type_traits>

#include "libdem/core/sha256.h"

namespace virtual_tests {
namespace {

/// All but the number of threads, on which the bits do not depend.
std::string sha256_of(const UniaxialOptions& o) {
  return dem::sha256_of(fmt::format("{}|{}|{}|{:a}|{:a}|{:a}|{:a}|{:a}|{:a}|{:a}|{:a}", name_of(o.loading),
                                    dem::name_of(o.ends), o.axis, o.platen_friction, o.expected_strength,
                                    o.velocity, o.rate, o.damping, o.time_step_fraction, o.stop_at,
                                    o.max_strain));
}

/// Calls `visit(name, number)` for each number of the record: one list, for writing and for reading.
template <class Record, class Visit>
void for_each_number(Record& r, Visit&& visit) {
  visit("steps", r.steps);
  visit("window_steps", r.window_steps);
  visit("low", r.low);
  visit("high", r.high);
  visit("previous_reaction", r.previous_reaction);
  visit("friction_work", r.friction_work);
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

void append(std::vector<double>& column, const CurvePoint& p) {
  column.insert(column.end(), {p.strain, p.stress, p.strain_axial, p.strain_lateral, p.broken, p.unbalanced});
}

}  // namespace

dem::Belonging belonging_of(const CheckpointPolicy& policy, const specimens::Specimen& specimen,
                            const dem::MaterialCard& card, const UniaxialOptions& options) {
  if (policy.file.empty()) return {};
  return {{"specimen", specimen.sha256()}, {"card", sha256_of(card)}, {"options", sha256_of(options)}};
}

dem::NamedNumbers numbers_of(const UniaxialRecord& record, int rebuilds) {
  dem::NamedNumbers numbers;
  for_each_number(record, [&](const char* name, auto value) { numbers[name] = {static_cast<double>(value)}; });
  append(numbers["point"], record.point);
  numbers["platen_friction"] = record.friction.memory();
  std::vector<double>& curve = numbers["curve"];
  for (const CurvePoint& point : record.curve) append(curve, point);
  record.film.keep_in(numbers);
  numbers["rebuilds"] = {static_cast<double>(record.rebuilds + rebuilds)};
  numbers["wall_seconds"] = {record.wall.seconds()};
  numbers["loop_seconds"] = {record.loop.seconds()};
  return numbers;
}

void set_from(UniaxialRecord& record, const dem::NamedNumbers& numbers, const std::filesystem::path& file) {
  const auto column = [&](const char* name) -> const std::vector<double>& {
    return column_of(numbers, name, file);
  };
  for_each_number(record, [&](const char* name, auto& value) {
    value = static_cast<std::remove_reference_t<decltype(value)>>(column(name)[0]);
  });
  record.friction.restore(column_of(numbers, "platen_friction", file, true));
  const auto point_from = [](const std::vector<double>& v, std::size_t k) {
    return CurvePoint{v[k], v[k + 1], v[k + 2], v[k + 3], v[k + 4], v[k + 5]};
  };
  record.point = point_from(column("point"), 0);
  const std::vector<double>& curve = column_of(numbers, "curve", file, true);
  record.curve.clear();
  for (std::size_t k = 0; k + 5 < curve.size(); k += 6) record.curve.push_back(point_from(curve, k));
  record.film.restore(numbers, file);
  record.rebuilds = static_cast<int>(column("rebuilds")[0]);
  record.wall.before = column("wall_seconds")[0];
  record.loop.before = column("loop_seconds")[0];
}

}  // namespace virtual_tests
