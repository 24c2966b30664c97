#include "specimens/virtual_tests/test_table.h"

#include <fmt/format.h>

#include <algorithm>

namespace virtual_tests {
namespace {

using dem::TomlTable;

bool has(const std::vector<std::string>& list, const std::string& key) {
  return std::find(list.begin(), list.end(), key) != list.end();
}

Value value_of(const TomlTable& table, const TestOption& option) {
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

}  // namespace

std::vector<std::string> option_keys(const TestDescription& test) {
  std::vector<std::string> keys;
  for (const TestOption& option : test.options) keys.push_back(option.key);
  return keys;
}

std::vector<std::string> all_option_keys() {
  std::vector<std::string> all;
  for (const TestDescription& test : catalogue())
    for (const std::string& key : option_keys(test))
      if (!has(all, key)) all.push_back(key);
  return all;
}

TestOptions read_options(const TomlTable& table, const TestDescription& test,
                         const std::vector<std::string>& beside) {
  std::vector<std::string> own = beside;
  for (const std::string& key : option_keys(test)) own.push_back(key);
  for (const std::string& key : table.keys())
    if (!has(own, key))
      table.fail(key,
                 fmt::format("has no meaning for {} {} test", test.name == "elastic" ? "an" : "a", test.name),
                 fmt::format("its options are {}", fmt::join(own, ", ")));
  TestOptions options = test.defaults;
  for (const TestOption& option : test.options)
    if (table.has(option.key)) option.set(options, value_of(table, option));
  if (table.has("velocity") && table.has("rate"))
    table.fail("rate", "stands beside velocity", "give one of them: both set the speed");
  return options;
}

}  // namespace virtual_tests
