// What any virtual test comes to: measured quantities, curve, fields at the end, and how it went.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "specimens/specimen.h"
#include "specimens/virtual_tests/curve_table.h"
#include "specimens/virtual_tests/final_fields.h"

namespace virtual_tests {

/// One value of a result, for files and tables.
using Value = std::variant<bool, std::int64_t, double, std::string>;
using NamedValues = std::vector<std::pair<std::string, Value>>;

/// How the steps of a test went; a static solve has none.
struct StepsTaken {
  long steps = 0;
  double time_step = 0, critical_time_step = 0;  ///< [s]
  double velocity = 0;                           ///< of what is driven [m/s]
  double damping = 0;
  double energy_balance_error = 0;  ///< largest imbalance over the work from outside
  /// Largest difference of the main force and the one opposing it over their mean, half peak to peak.
  double unbalanced_force_ratio = 0;
  bool dynamic = false;      ///< waves are the test's matter: nothing has to balance
  bool passed_peak = false;  ///< false: the limit of the displacement came first
  std::size_t links = 0, broken_links = 0;
  double step_loop_seconds = 0;
  std::string state_sha256;

  /// Quasi-static if the two forces agree within 5% up to the peak.
  bool quasi_static() const { return unbalanced_force_ratio <= 0.05; }
  /// Balanced if the ledger closes within 1%; a sound run's does within a few tenths.
  bool energy_balanced() const { return energy_balance_error <= 0.01; }
};

struct TestOutcome {
  NamedValues setting;                                   ///< what was settled: axis, ends, ...
  std::vector<std::pair<std::string, double>> measured;  ///< SI, the main quantity first
  CurveTable curve;                                      ///< empty where there is none
  FinalFields fields;                                    ///< empty where there are none
  /// The specimen as it was tested, where it is not the one that was given: cut, for one.
  std::optional<specimens::Specimen> tested;
  std::optional<StepsTaken> run;  ///< none after a static solve
  double wall_seconds = 0;        ///< of all parts of a test that was stopped

  /// A measured quantity; NaN if there is none of that name.
  double value(std::string_view name) const;
};

/// The keys of result.json in their order, without the seconds: the same bits whenever and wherever it ran.
NamedValues values_of(const TestOutcome& outcome);

}  // namespace virtual_tests
