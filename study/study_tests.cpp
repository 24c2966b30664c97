// tests = ["elastic", "tension"], or [[test]] with options.
#include <fmt/format.h>

#include <algorithm>

#include "libdem/config/nearest_name.h"
#include "specimens/virtual_tests/test_table.h"
#include "study/study_parts.h"

namespace study {
namespace {

using dem::TomlTable;

VirtualTest plain_test(const std::string& name) {
  const virtual_tests::TestDescription& found = *virtual_tests::find_test(name);
  return {name, found.kind, found.defaults};
}

/// The groups that a test names are there.
void require_groups(const TomlTable& table, const VirtualTest& test, const Study& study) {
  std::vector<std::string> known;
  for (const SpecimenRecipe& recipe : study.specimens)
    if (known.empty() || known.back() != recipe.group) known.push_back(recipe.group);
  for (const std::string& group : test.groups)
    if (std::find(known.begin(), known.end(), group) == known.end())
      table.fail("specimens", fmt::format("no [[specimen]] has the name \"{}\"", group),
                 dem::suggestion(group, known));
}

VirtualTest read_test(const TomlTable& table) {
  static const std::vector<std::string> own{"name", "kind", "specimens"};
  std::vector<std::string> known = virtual_tests::all_option_keys();
  known.insert(known.begin(), own.begin(), own.end());
  table.allow_only(known);
  const std::string kind = table.choice("kind", virtual_tests::names_of_tests());
  VirtualTest test = plain_test(kind);
  test.name = table.text("name", kind);
  if (test.name.empty()) table.fail("name", "is empty", "give the test a name, or leave the key out");
  test.options = virtual_tests::read_options(table, *virtual_tests::find_test(kind), own);
  if (table.has("specimens")) test.groups = one_or_more_texts(table, "specimens");
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
  for (const TomlTable& table : tables) {
    study.tests.push_back(read_test(table));
    require_groups(table, study.tests.back(), study);
  }
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
