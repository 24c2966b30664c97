#include "app/report_words.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "libdem/core/units.h"
#include "report/html.h"
#include "specimens/virtual_tests/catalogue.h"

namespace app {

namespace {

/// In the unit that people use for one of SI.
Label label_with_unit(const std::string& words, const std::string& key, const std::string& unit) {
  if (unit == "Pa") return {words, "MPa", 1e-6};
  if (unit == "N") return {words, "kN", 1e-3};
  if (unit == "m") return {words, "mm", 1e3};
  if (unit == "-" && key.rfind("strain", 0) == 0) return {words, "‰", 1e3};
  return {words, people_unit(unit), 1};
}

}  // namespace

Label label_of(const std::string& key) {
  constexpr double degrees = 180 / 3.14159265358979323846;
  static const std::map<std::string, Label> known{
      {"E", {"Young's modulus E", "GPa", 1e-9}},
      {"nu", {"Poisson's ratio ν", "", 1}},
      {"density", {"density", "kg/m³", 1}},
      {"T", {"local tensile strength T", "MPa", 1e-6}},
      {"Co", {"local cohesion Co", "MPa", 1e-6}},
      {"zeta", {"softening ζ", "", 1}},
      {"phi_i", {"friction angle of intact links φi", "°", degrees}},
      {"phi_c", {"friction angle of broken links φc", "°", degrees}},
      {"alpha", {"α of Eq. 1", "", 1}},
      {"beta", {"β of Eq. 1", "", 1}},
      {"gamma", {"γ of Eq. 1", "", 1}},
      {"link_law", {"law of the links", "", 1}},
      {"slip_softening", {"slip softening of the cohesion ζs", "", 1}},
      {"rolling_stiffness", {"rolling stiffness over Kn R²", "", 1}},
      {"rolling_limit", {"rolling limit over R Fn", "", 1}},
      {"twisting_stiffness", {"twisting stiffness over Kn R²", "", 1}},
      {"twisting_limit", {"twisting limit over R Fn", "", 1}},
      {"unloading", {"unloading in the softening branch", "", 1}},
      {"cohesion_during_softening", {"cohesion during softening", "", 1}},
      {"broken_link_contact", {"contact distance of broken links", "", 1}},
      {"peak_stress", {"peak stress", "MPa", 1e-6}},
      {"peak_strain", {"strain at the peak", "‰", 1e3}},
      {"work_of_fracture", {"work after the peak per area", "J/m²", 1}},
      {"damage", {"links broken, part of all", "%", 100}},
      {"energy_balance_error", {"error of the energy balance", "%", 100}},
      {"unbalanced_force_ratio", {"difference of the forces that balance", "%", 100}},
      {"passed_peak", {"peak passed", "", 1}},
      {"quasi_static", {"quasi-static", "", 1}},
      {"broken_links", {"links broken", "", 1}},
      {"fe_nodes", {"nodes of finite elements", "", 1}},
      {"contacts", {"contacts between elements, at the end", "", 1}},
      {"simulated_time", {"simulated time", "ms", 1e3}},
      {"peak_force", {"peak of the contact force", "kN", 1e-3}},
      {"impulse", {"impulse on the impactor", "N s", 1}},
      {"residual_velocity", {"velocity of the impactor at the end, along its approach", "m/s", 1}},
      {"damage_volume", {"volume of concrete that lost more than half its links", "dm³", 1e3}},
      {"ends", {"ends of the specimen", "", 1}},
      {"axis", {"loading axis", "", 1}},
      {"velocity", {"speed of loading", "m/s", 1}},
      {"damping", {"local damping", "", 1}},
      {"time_step", {"time step", "µs", 1e6}},
      {"critical_time_step", {"critical time step", "µs", 1e6}},
      {"iterations", {"iterations of the solver", "", 1}},
      {"virtual_tests", {"virtual tests", "", 1}},
      {"step_loop_seconds", {"time in the step loop", "s", 1}},
      {"overlap_solve_seconds", {"time in the coupling", "s", 1}},
      {"wall_seconds", {"time, all together", "s", 1}},
      {"memory_bytes", {"memory", "GiB", std::pow(2.0, -30)}},
      {"state_sha256", {"SHA-256 of the final state", "", 1}},
      {"command_line", {"command", "", 1}},
      {"cpu", {"processor", "", 1}},
      {"arch", {"architecture", "", 1}}};
  if (const auto found = known.find(key); found != known.end()) return found->second;
  if (const virtual_tests::MeasuredQuantity* found = virtual_tests::find_measured(key))
    return label_with_unit(found->words, key, found->unit);
  std::string words = key;
  std::replace(words.begin(), words.end(), '_', ' ');
  if (const virtual_tests::TestOption* option = virtual_tests::find_option(key))
    return label_with_unit(words, key, std::string(dem::si_unit(option->quantity)));
  return {words, "", 1};
}

std::string with_unit(double value, const std::string& unit, int digits) {
  std::string shown = report::number_text(value, digits);
  if (unit.empty() || !std::isfinite(value)) return shown;
  return shown + (unit == "°" ? "" : " ") + unit;
}

std::string value_words(const std::string& key, const Json& value) {
  if (value.is_null()) return "–";
  if (value.is_string()) {
    std::string words = value.get<std::string>();
    if (key == "link_law" || key == "unloading" || key == "cohesion_during_softening" ||
        key == "broken_link_contact")
      std::replace(words.begin(), words.end(), '_', ' ');
    return words;
  }
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  if (!value.is_number()) return value.dump();
  const Label label = label_of(key);
  // Counts are shown to the last digit, unless they have a unit of their own.
  if (!value.is_number_float() && label.factor == 1) return with_unit(value.get<double>(), label.unit, 15);
  return with_unit(label.factor * value.get<double>(), label.unit);
}

std::string capital(const std::string& words) {
  if (words.empty() || words[0] < 'a' || words[0] > 'z') return words;
  return static_cast<char>(words[0] - 'a' + 'A') + words.substr(1);
}

std::string people_unit(const std::string& unit) {
  if (unit == "-") return "";
  if (unit == "permil") return "‰";
  if (unit == "J/m2") return "J/m²";
  return unit;
}

double number(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>()
                                                     : std::numeric_limits<double>::quiet_NaN();
}

std::string text(const Json& object, const std::string& key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

const Json& list_of(const Json& object, const std::string& key) {
  static const Json none = Json::array();
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : none;
}

report::KeyValues rows_of(const Json& object, std::initializer_list<const char*> keys) {
  report::KeyValues table;
  for (const char* key : keys)
    if (const auto found = object.find(key); found != object.end() && found->is_primitive())
      table.rows.emplace_back(capital(label_of(key).words), value_words(key, *found));
  return table;
}

}  // namespace app
