// [[test]]: laboratory tests beside tension and compression whose results are targets too.
#include <fmt/format.h>

#include <algorithm>

#include "calibrate/case_parts.h"
#include "libdem/config/nearest_name.h"
#include "specimens/virtual_tests/test_table.h"

namespace calibrate {
namespace {

using dem::TomlTable;
using virtual_tests::MeasuredQuantity;
using virtual_tests::TestDescription;

struct Unit {
  std::string_view si;
  dem::Quantity kind;
  const char* shown;
  double scale;
};

/// What the units of measured quantities are on the way in, and for people.
const Unit& unit_of(const std::string& si) {
  static const std::vector<Unit> units{{"Pa", dem::Quantity::stress, "MPa", 1e6},
                                       {"J/m2", dem::Quantity::fracture_energy, "J/m2", 1},
                                       {"m", dem::Quantity::length, "mm", 1e-3},
                                       {"m/s", dem::Quantity::velocity, "m/s", 1},
                                       {"-", dem::Quantity::ratio, "-", 1}};
  for (const Unit& unit : units)
    if (unit.si == si) return unit;
  return units.back();
}

std::vector<std::string> names_of_other_tests() {
  std::vector<std::string> names;
  for (const TestDescription& test : virtual_tests::catalogue())
    if (test.name != "elastic" && test.name != "tension" && test.name != "compression")
      names.push_back(test.name);
  return names;
}

/// The targets of one test, with their tolerances.
void read_its_targets(const TomlTable& table, const TestDescription& description, LaboratoryTest& test,
                      CalibrationCase& result) {
  std::vector<std::string> keys;
  for (const MeasuredQuantity& quantity : description.measured) keys.push_back(quantity.key);
  const auto wanted = table.optional_table("targets");
  if (!wanted || wanted->keys().empty())
    table.fail("targets", "is missing",
               fmt::format("write it as in targets = {{ {} = \"...\" }}; {} measures {}", keys.front(),
                           description.name, fmt::join(keys, ", ")));
  wanted->allow_only(keys);
  const auto tolerances = table.optional_table("tolerance");
  if (tolerances) tolerances->allow_only(wanted->keys());
  for (const MeasuredQuantity& quantity : description.measured) {
    if (!wanted->has(quantity.key)) continue;
    const Unit& unit = unit_of(quantity.unit);
    const double value = wanted->quantity(quantity.key, unit.kind);
    if (!(value > 0)) wanted->fail(quantity.key, fmt::format("is {:.4g}", value), "it must be greater than 0");
    double tolerance = 0.05;
    if (tolerances && tolerances->has(quantity.key)) {
      tolerance = tolerances->quantity(quantity.key, dem::Quantity::ratio);
      if (!(tolerance > 0 && tolerance < 1))
        tolerances->fail(quantity.key, fmt::format("is {}", tolerance),
                         "allowed: above 0, below 1 (relative: 0.02 is 2%)");
    }
    Target target{Quantity::laboratory, value, tolerance, "given", {}};
    target.laboratory = {
        result.laboratory.size(),
        fmt::format("{}.{}", test.name, quantity.key),
        test.quantities.size(),
        test.name == description.name ? quantity.words : fmt::format("{} of {}", quantity.words, test.name),
        unit.shown,
        unit.scale};
    result.targets.push_back(std::move(target));
    test.quantities.push_back(quantity.key);
  }
}

}  // namespace

void read_laboratory_tests(const TomlTable& root, CalibrationCase& result) {
  static const std::vector<std::string> specimen_keys{"shape", "size", "elements", "size_ratio"};
  std::vector<std::string> own{"name", "kind", "targets", "tolerance"};
  own.insert(own.end(), specimen_keys.begin(), specimen_keys.end());
  std::vector<std::string> known = virtual_tests::all_option_keys();
  known.insert(known.begin(), own.begin(), own.end());
  for (const TomlTable& table : root.tables("test")) {
    table.allow_only(known);
    const std::string kind = table.choice("kind", names_of_other_tests());
    const TestDescription& description = *virtual_tests::find_test(kind);
    LaboratoryTest test;
    test.name = table.text("name", kind);
    for (const LaboratoryTest& other : result.laboratory)
      if (other.name == test.name)
        table.fail("name", fmt::format("\"{}\" stands twice", test.name), "give each test its own name");
    test.options = virtual_tests::read_options(table, description, own);
    const bool has_specimen = std::any_of(specimen_keys.begin(), specimen_keys.end(),
                                          [&](const std::string& key) { return table.has(key); });
    if (has_specimen) {
      if (!result.structure.empty())
        table.fail("size", "has no meaning beside cut_from",
                   "specimens that are cut out serve all tests; leave the key out");
      test.packing = read_packing(table);
    }
    read_its_targets(table, description, test, result);
    result.laboratory.push_back(std::move(test));
  }
}

}  // namespace calibrate
