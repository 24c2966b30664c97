#include "specimens/virtual_tests/outcome.h"

#include <limits>

namespace virtual_tests {

double TestOutcome::value(std::string_view name) const {
  for (const auto& [key, number] : measured)
    if (key == name) return number;
  return std::numeric_limits<double>::quiet_NaN();
}

NamedValues values_of(const TestOutcome& outcome) {
  NamedValues values;
  for (const auto& [key, number] : outcome.measured) values.emplace_back(key, number);
  values.insert(values.end(), outcome.setting.begin(), outcome.setting.end());
  if (!outcome.run) return values;
  const StepsTaken& run = *outcome.run;
  const auto whole = [](std::size_t count) { return static_cast<std::int64_t>(count); };
  const double damage =
      run.links == 0 ? 0 : static_cast<double>(run.broken_links) / static_cast<double>(run.links);
  for (std::pair<std::string, Value> value : NamedValues{{"passed_peak", run.passed_peak},
                                                         {"quasi_static", run.quasi_static()},
                                                         {"broken_links", whole(run.broken_links)},
                                                         {"links", whole(run.links)},
                                                         {"damage", damage},
                                                         {"velocity", run.velocity},
                                                         {"damping", run.damping},
                                                         {"steps", std::int64_t{run.steps}},
                                                         {"time_step", run.time_step},
                                                         {"critical_time_step", run.critical_time_step},
                                                         {"energy_balance_error", run.energy_balance_error},
                                                         {"unbalanced_force_ratio", run.unbalanced_force_ratio},
                                                         {"state_sha256", run.state_sha256}})
    if (!run.dynamic ||
        (value.first != "quasi_static" && value.first != "unbalanced_force_ratio" && value.first != "damping"))
      values.push_back(std::move(value));
  return values;
}

}  // namespace virtual_tests
