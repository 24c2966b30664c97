#include "specimens/virtual_tests/uniaxial_checkpoint.h"

#include <fmt/format.h>

#include <type_traits>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/sha256.h"

namespace virtual_tests {
namespace {

std::string sha256_of(const dem::MaterialCard& card) { return dem::sha256_of(dem::identity_text(card)); }

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

dem::NamedNumbers numbers_of(const UniaxialRecord& record, int rebuilds) {
  dem::NamedNumbers numbers;
  for_each_number(record, [&](const char* name, auto value) { numbers[name] = {static_cast<double>(value)}; });
  append(numbers["point"], record.point);
  numbers["platen_friction"] = record.friction.memory();
  std::vector<double>& curve = numbers["curve"];
  for (const CurvePoint& point : record.curve) append(curve, point);
  numbers["rebuilds"] = {static_cast<double>(record.rebuilds + rebuilds)};
  numbers["wall_seconds"] = {record.wall.seconds()};
  numbers["loop_seconds"] = {record.loop.seconds()};
  return numbers;
}

void set_from(UniaxialRecord& record, const dem::NamedNumbers& numbers, const std::filesystem::path& file) {
  const auto column = [&](const std::string& name) -> const std::vector<double>& {
    const auto found = numbers.find(name);
    if (found == numbers.end() || (found->second.empty() && name != "curve"))
      throw dem::InputError(file.string(), fmt::format("lacks the number {}", name), "start anew without it");
    return found->second;
  };
  for_each_number(record, [&](const char* name, auto& value) {
    value = static_cast<std::remove_reference_t<decltype(value)>>(column(name)[0]);
  });
  record.friction.restore(column("platen_friction"));
  const auto point_from = [](const std::vector<double>& v, std::size_t k) {
    return CurvePoint{v[k], v[k + 1], v[k + 2], v[k + 3], v[k + 4], v[k + 5]};
  };
  record.point = point_from(column("point"), 0);
  const std::vector<double>& curve = column("curve");
  record.curve.clear();
  for (std::size_t k = 0; k + 5 < curve.size(); k += 6) record.curve.push_back(point_from(curve, k));
  record.rebuilds = static_cast<int>(column("rebuilds")[0]);
  record.wall.before = column("wall_seconds")[0];
  record.loop.before = column("loop_seconds")[0];
}

}  // namespace

CheckpointKeeper::CheckpointKeeper(const CheckpointPolicy& wanted, const specimens::Specimen& specimen,
                                   const dem::MaterialCard& card, const UniaxialOptions& options)
    : policy(wanted) {
  if (policy.file.empty()) return;
  belonging = {{"specimen", specimen.sha256()}, {"card", sha256_of(card)}, {"options", sha256_of(options)}};
}

void CheckpointKeeper::restore(dem::Assembly& assembly, dem::StepRoom& room, UniaxialRecord& record) const {
  if (!policy.resume || policy.file.empty() || !std::filesystem::exists(policy.file)) return;
  set_from(record, dem::read_checkpoint(policy.file, belonging, assembly, room), policy.file);
}

void CheckpointKeeper::look(dem::Assembly& assembly, const dem::StepRoom& room, const UniaxialRecord& record) {
  const bool stop = dem::interrupt_requested() || record.steps == policy.stop_after;
  if (!policy.file.empty() && (stop || since_written.seconds() >= policy.seconds_between)) {
    write(assembly, room, record);
    since_written = {};
  }
  if (!stop) return;
  throw dem::Interrupted(policy.file.empty() ? "stopped by a signal"
                                             : fmt::format("stopped by a signal at step {}", record.steps));
}

void CheckpointKeeper::write(dem::Assembly& assembly, const dem::StepRoom& room,
                             const UniaxialRecord& record) const {
  dem::write_checkpoint(policy.file, belonging, assembly, room, numbers_of(record, room.detector.rebuilds()));
}

}  // namespace virtual_tests
