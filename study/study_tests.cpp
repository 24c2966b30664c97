// tests = ["elastic", "tension"], or [[test]] with options.
#include <fmt/format.h>

#include "study/study_parts.h"

namespace study {
namespace {

using dem::TomlTable;

const std::vector<std::string>& kinds() {
  static const std::vector<std::string> names{"elastic", "tension", "compression"};
  return names;
}

VirtualTest plain_test(const std::string& kind) {
  VirtualTest test;
  test.name = kind;
  test.kind = kind == "elastic"   ? TestKind::elastic
              : kind == "tension" ? TestKind::tension
                                  : TestKind::compression;
  test.options.loading = test.kind == TestKind::compression ? virtual_tests::Loading::compression
                                                            : virtual_tests::Loading::tension;
  return test;
}

double positive(const TomlTable& table, const char* key, dem::Quantity kind) {
  if (!table.has(key)) return 0;
  const double value = table.quantity(key, kind);
  if (!(value > 0)) table.fail(key, fmt::format("is {:.4g}", value), "it must be greater than 0");
  return value;
}

double within(const TomlTable& table, const char* key, double fallback, double low, double high) {
  const double value = table.number(key, fallback);
  if (table.has(key) && !(value >= low && value <= high))
    table.fail(key, fmt::format("is {}", value), fmt::format("allowed: {} to {}", low, high));
  return value;
}

VirtualTest read_test(const TomlTable& table) {
  table.allow_only({"name", "kind", "ends", "platen_friction", "axis", "velocity", "rate", "expected_strength",
                    "damping", "stop_at", "max_strain"});
  const std::string kind = table.choice("kind", kinds());
  VirtualTest test = plain_test(kind);
  test.name = table.text("name", kind);
  if (test.name.empty()) table.fail("name", "is empty", "give the test a name, or leave the key out");
  virtual_tests::UniaxialOptions& options = test.options;
  if (table.has("axis")) options.axis = table.choice("axis", {"x", "y", "z"})[0] - 'x';
  if (test.kind == TestKind::elastic) {
    for (const char* key : {"ends", "platen_friction", "velocity", "rate", "expected_strength", "damping",
                            "stop_at", "max_strain"})
      if (table.has(key))
        table.fail(key, "has no meaning for an elastic test", "its options are name and axis");
    return test;
  }
  options.ends = dem::end_condition(table.choice("ends", dem::end_condition_names(), "free"));
  options.platen_friction = within(table, "platen_friction", options.platen_friction, 0, 2);
  if (table.has("velocity") && table.has("rate"))
    table.fail("rate", "stands beside velocity", "give one of them: both set the speed of the platens");
  options.velocity = positive(table, "velocity", dem::Quantity::velocity);
  options.rate = within(table, "rate", options.rate, 1e-6, 1);
  options.expected_strength = positive(table, "expected_strength", dem::Quantity::stress);
  options.damping = within(table, "damping", options.damping, 0, 0.99);
  options.stop_at = within(table, "stop_at", options.stop_at, 0.001, 0.999);
  options.max_strain = positive(table, "max_strain", dem::Quantity::ratio);
  told_about(table, "max_strain", [&] { options.validate(); });
  return test;
}

}  // namespace

void read_tests(const TomlTable& root, Study& study) {
  const std::vector<TomlTable> tables = root.tables("test");
  if (root.has("tests") && !tables.empty())
    root.fail("tests", "stands beside [[test]]", "give either the list or the tables");
  if (root.has("tests")) {
    for (const std::string& kind : one_or_more_texts(root, "tests")) {
      bool known = false;
      for (const std::string& name : kinds()) known = known || name == kind;
      if (!known)
        root.fail("tests", fmt::format("\"{}\" is no test", kind), "allowed: elastic, tension, compression");
      study.tests.push_back(plain_test(kind));
    }
  }
  for (const TomlTable& table : tables) study.tests.push_back(read_test(table));
  if (study.tests.empty())
    root.fail("tests", "the key is missing",
              "write it as in tests = [\"elastic\", \"tension\", \"compression\"]");
  for (std::size_t a = 0; a < study.tests.size(); ++a)
    for (std::size_t b = 0; b < a; ++b)
      if (study.tests[a].name == study.tests[b].name)
        (tables.empty() ? root : tables[a])
            .fail(tables.empty() ? "tests" : "name", fmt::format("\"{}\" stands twice", study.tests[a].name),
                  "rows are told apart by the test's name: give each its own");
}

}  // namespace study
