// The list of virtual tests: every option counts, keys mean one thing, and the documents name them all.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "specimens/virtual_tests/catalogue.h"

using virtual_tests::TestDescription;
using virtual_tests::TestOption;
using virtual_tests::Value;

namespace {

/// A value that the option allows and that is not the one that is set.
Value another(const TestOption& option, const virtual_tests::TestOptions& options) {
  switch (option.kind) {
    case TestOption::Kind::flag:
      return !std::get<bool>(option.get(options));
    case TestOption::Kind::choice:
      return option.choices.front() == std::get<std::string>(option.get(options)) ? option.choices.back()
                                                                                  : option.choices.front();
    default:
      return option.low + 0.321 * (std::min(option.high, 1.0) - option.low);
  }
}

}  // namespace

TEST(Catalogue, EveryOptionCountsInTheTextThatNamesAResult) {
  for (const TestDescription& test : virtual_tests::catalogue()) {
    const std::string usual = virtual_tests::text_of(test.defaults);
    std::set<std::string> texts{usual};
    for (const TestOption& option : test.options) {
      virtual_tests::TestOptions options = test.defaults;
      const Value value = another(option, options);
      option.set(options, value);
      EXPECT_EQ(option.get(options), value) << test.name << " " << option.key;
      EXPECT_TRUE(texts.insert(virtual_tests::text_of(options)).second) << test.name << " " << option.key;
    }
    virtual_tests::TestOptions threads = test.defaults;
    virtual_tests::set_threads(threads, 7);
    EXPECT_EQ(virtual_tests::text_of(threads), usual);
    EXPECT_EQ(virtual_tests::kind_of(test.defaults), test.kind);
    EXPECT_EQ(virtual_tests::find_test(test.name), &test);
  }
}

TEST(Catalogue, AKeyMeansTheSameInEveryTest) {
  std::map<std::string, std::string> units;
  std::map<std::string, std::pair<TestOption::Kind, dem::Quantity>> kinds;
  for (const TestDescription& test : virtual_tests::catalogue()) {
    ASSERT_FALSE(test.measured.empty()) << test.name;
    for (const auto& quantity : test.measured)
      EXPECT_EQ(units.emplace(quantity.key, quantity.unit).first->second, quantity.unit) << quantity.key;
    for (const TestOption& option : test.options) {
      const auto kind = std::pair(option.kind, option.quantity);
      EXPECT_EQ(kinds.emplace(option.key, kind).first->second, kind) << option.key;
    }
  }
}

TEST(Catalogue, TheDocumentNamesEveryTestOptionAndQuantity) {
  std::ifstream in(SPALL_SOURCE_DIR "/docs/virtual-tests.md");
  const std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const auto named = [&](const std::string& key) { return page.find('`' + key + '`') != std::string::npos; };
  for (const TestDescription& test : virtual_tests::catalogue()) {
    for (const TestOption& option : test.options)
      EXPECT_TRUE(named(option.key)) << test.name << " " << option.key;
    for (const auto& quantity : test.measured)
      EXPECT_TRUE(named(quantity.key)) << test.name << " " << quantity.key;
  }
}
