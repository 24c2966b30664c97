// tests = ["elastic", "tension"], or [[test]] with options.
#include <fmt/format.h>

#include <algorithm>

#include "study/study_parts.h"

namespace study {
namespace {

using dem::TomlTable;
using virtual_tests::TestOption;

VirtualTest plain_test(const std::string& name) {
  const virtual_tests::TestDescription& found = *virtual_tests::find_test(name);
  return {name, found.kind, found.defaults};
}

std::vector<std::string> keys_of(const virtual_tests::TestDescription& test) {
  std::vector<std::string> keys{"name", "kind"};
  for (const TestOption& option : test.options) keys.push_back(option.key);
  return keys;
}

/// Every key that some test has.
std::vector<std::string> all_keys() {
  std::vector<std::string> all;
  for (const virtual_tests::TestDescription& test : virtual_tests::catalogue())
    for (const std::string& key : keys_of(test))
      if (std::find(all.begin(), all.end(), key) == all.end()) all.push_back(key);
  return all;
}

/// Refuses what other tests have.
void require_own_keys(const TomlTable& table, const virtual_tests::TestDescription& test) {
  const std::vector<std::string> own = keys_of(test);
  for (const std::string& key : table.keys())
    if (std::find(own.begin(), own.end(), key) == own.end())
      table.fail(key,
                 fmt::format("has no meaning for {} {} test", test.name == "elastic" ? "an" : "a", test.name),
                 fmt::format("its options are {}", fmt::join(own, ", ")));
}

virtual_tests::Value value_of(const TomlTable& table, const TestOption& option) {
  switch (option.kind) {
    case TestOption::Kind::quantity: {
      const double value = table.quantity(option.key, option.quantity);
      if (!(value > option.low))
        table.fail(option.key, fmt::format("is {:.4g}", value),
                   fmt::format("it must be greater than {:.4g}", option.low));
      if (!(value <= option.high))
        table.fail(option.key, fmt::format("is {:.4g}", value),
                   fmt::format("it must be at most {:.4g}", option.high));
      return value;
    }
    case TestOption::Kind::number: {
      const double value = table.number(option.key);
      if (!(value >= option.low && value <= option.high))
        table.fail(option.key, fmt::format("is {}", value),
                   fmt::format("allowed: {} to {}", option.low, option.high));
      return value;
    }
    case TestOption::Kind::choice:
      return table.choice(option.key, option.choices);
    case TestOption::Kind::flag:
      break;
  }
  return table.boolean(option.key);
}

VirtualTest read_test(const TomlTable& table) {
  table.allow_only(all_keys());
  const std::string kind = table.choice("kind", virtual_tests::names_of_tests());
  const virtual_tests::TestDescription& description = *virtual_tests::find_test(kind);
  require_own_keys(table, description);
  VirtualTest test = plain_test(kind);
  test.name = table.text("name", kind);
  if (test.name.empty()) table.fail("name", "is empty", "give the test a name, or leave the key out");
  for (const TestOption& option : description.options)
    if (table.has(option.key)) option.set(test.options, value_of(table, option));
  if (table.has("velocity") && table.has("rate"))
    table.fail("rate", "stands beside velocity", "give one of them: both set the speed");
  return test;
}

}  // namespace

void read_tests(const TomlTable& root, Study& study) {
  const std::vector<TomlTable> tables = root.tables("test");
  if (root.has("tests") && !tables.empty())
    root.fail("tests", "stands beside [[test]]", "give either the list or the tables");
  if (root.has("tests")) {
    for (const std::string& kind : one_or_more_texts(root, "tests")) {
      if (virtual_tests::find_test(kind) == nullptr)
        root.fail("tests", fmt::format("\"{}\" is no test", kind),
                  fmt::format("allowed: {}", fmt::join(virtual_tests::names_of_tests(), ", ")));
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
