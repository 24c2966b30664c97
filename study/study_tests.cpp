// tests = ["elastic", "tension"], or [[test]] with options.
#include <fmt/format.h>

#include "specimens/virtual_tests/test_table.h"
#include "study/study_parts.h"

namespace study {
namespace {

using dem::TomlTable;

VirtualTest plain_test(const std::string& name) {
  const virtual_tests::TestDescription& found = *virtual_tests::find_test(name);
  return {name, found.kind, found.defaults};
}

VirtualTest read_test(const TomlTable& table) {
  static const std::vector<std::string> own{"name", "kind"};
  std::vector<std::string> known = virtual_tests::all_option_keys();
  known.insert(known.begin(), own.begin(), own.end());
  table.allow_only(known);
  const std::string kind = table.choice("kind", virtual_tests::names_of_tests());
  VirtualTest test = plain_test(kind);
  test.name = table.text("name", kind);
  if (test.name.empty()) table.fail("name", "is empty", "give the test a name, or leave the key out");
  test.options = virtual_tests::read_options(table, *virtual_tests::find_test(kind), own);
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
