// design, points, sensitivity and [vary].
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/config/nearest_name.h"
#include "study/design.h"
#include "study/study_parts.h"

namespace study {
namespace {

using dem::TomlTable;
using Kind = TomlTable::Kind;

std::vector<dem::CardNumber> known_numbers() {
  std::vector<dem::CardNumber> numbers = dem::numbers_of(dem::MaterialCard{});
  numbers.push_back({stiffness_ratio_key, 1, dem::Quantity::ratio, "Ks/Kn of the links, at unchanged Kn"});
  return numbers;
}

/// The bounds that hold for the number alone; what ties numbers together is checked when the cards are made.
void require_allowed(const TomlTable& vary, const Parameter& parameter, double value) {
  if (parameter.key == stiffness_ratio_key && !(value > 0 && value <= 1))
    vary.fail(parameter.key, fmt::format("{} is out of bounds", value),
              "Ks/Kn is above 0 and at most 1, where nu is 0");
}

void read_range(const TomlTable& range, const char* key_of_count, Parameter& parameter) {
  parameter.from = range.quantity("from", parameter.kind);
  parameter.to = range.quantity("to", parameter.kind);
  parameter.logarithmic = range.choice("spacing", {"linear", "logarithmic"}, "linear") == "logarithmic";
  if (!(parameter.from < parameter.to))
    range.fail("to", fmt::format("{:.6g} is not above from, {:.6g}", parameter.to, parameter.from),
               "a range runs from the smaller to the larger value");
  if (parameter.logarithmic && !(parameter.from > 0))
    range.fail("spacing", "is logarithmic, and from is not positive", "begin above 0, or space it linearly");
  if (key_of_count == nullptr) return;
  const std::int64_t count = range.integer(key_of_count, 2, 10'000);
  for (std::int64_t k = 0; k < count; ++k)
    parameter.values.push_back(
        within_range(parameter, static_cast<double>(k) / static_cast<double>(count - 1)));
}

Parameter read_parameter(const TomlTable& vary, const dem::CardNumber& number, bool sobol) {
  Parameter parameter;
  parameter.key = std::string(number.key);
  parameter.kind = number.kind;
  const std::string key = parameter.key;
  const std::string listed = fmt::format("{} = [\"{}\"]", key, dem::example(parameter.kind));
  const std::string ranged =
      fmt::format("{} = {{ from = \"...\", to = \"...\"{} }}", key, sobol ? "" : ", count = 5");
  if (vary.kind(key) == Kind::table) {
    const TomlTable range = vary.table(key);
    if (sobol && range.has("count"))
      range.fail("count", "has no meaning in a Sobol design",
                 "points = N sets how many there are; leave it out");
    range.allow_only(sobol ? std::vector<std::string>{"from", "to", "spacing"}
                           : std::vector<std::string>{"from", "to", "spacing", "count"});
    read_range(range, sobol ? nullptr : "count", parameter);
    require_allowed(vary, parameter, parameter.from);
    require_allowed(vary, parameter, parameter.to);
    return parameter;
  }
  if (sobol) vary.fail(key, "is no range", "a Sobol design fills ranges: write " + ranged);
  if (vary.kind(key) != Kind::list)
    vary.fail(key, "is neither a list nor a range", "write " + listed + " or " + ranged);
  parameter.values = vary.quantities(key, parameter.kind);
  if (parameter.values.empty()) vary.fail(key, "the list is empty", "write " + listed);
  for (std::size_t k = 0; k < parameter.values.size(); ++k) {
    require_allowed(vary, parameter, parameter.values[k]);
    if (std::find(parameter.values.begin(), parameter.values.begin() + static_cast<std::ptrdiff_t>(k),
                  parameter.values[k]) != parameter.values.begin() + static_cast<std::ptrdiff_t>(k))
      vary.fail(key, fmt::format("the value {:.6g} stands twice", parameter.values[k]), "name each value once");
  }
  return parameter;
}

void read_vary(const TomlTable& vary, Study& study) {
  const std::vector<dem::CardNumber> numbers = known_numbers();
  std::vector<std::string> names;
  for (const dem::CardNumber& number : numbers) names.emplace_back(number.key);
  vary.allow_only(names);
  for (const std::string& key : vary.keys()) {
    const auto number =
        std::find_if(numbers.begin(), numbers.end(), [&](const dem::CardNumber& n) { return n.key == key; });
    study.parameters.push_back(read_parameter(vary, *number, study.design == DesignKind::sobol));
  }
  if (vary.has(stiffness_ratio_key))
    for (const char* key : {"E", "nu"})
      if (vary.has(key))
        vary.fail(key, fmt::format("stands beside {}", stiffness_ratio_key),
                  "Ks/Kn sets E and nu by Eq. 1: vary one or the other");
}

}  // namespace

void read_design(const TomlTable& root, Study& study) {
  study.design = root.choice("design", {"factorial", "sobol"}, "factorial") == "sobol" ? DesignKind::sobol
                                                                                       : DesignKind::factorial;
  const bool sobol = study.design == DesignKind::sobol;
  for (const char* key : {"points", "sensitivity"})
    if (!sobol && root.has(key))
      root.fail(key, "has no meaning in a factorial design", "write design = \"sobol\", or leave this key out");
  if (const auto vary = root.optional_table("vary")) read_vary(*vary, study);
  if (!sobol) return;
  study.points = static_cast<std::size_t>(root.integer("points", 1, 100'000));
  study.sensitivity = root.boolean("sensitivity", false);
  if (study.parameters.empty())
    root.fail("design", "is sobol, and nothing varies",
              "name ranges under [vary], as in T = { from = \"2 MPa\", to = \"4 MPa\" }");
  const std::size_t dimensions = study.parameters.size() * (study.sensitivity ? 2 : 1);
  if (dimensions > most_sobol_dimensions)
    root.fail("vary", fmt::format("needs a Sobol sequence of {} dimensions", dimensions),
              fmt::format("at most {} parameters{}", most_sobol_dimensions / (study.sensitivity ? 2 : 1),
                          study.sensitivity ? " where sensitivity is asked for" : ""));
  if (study.sensitivity && study.cards.size() > 1)
    root.fail("sensitivity", "is asked for with several cards", "indices belong to one card: name one");
}

}  // namespace study
