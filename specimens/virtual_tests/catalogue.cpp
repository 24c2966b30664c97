#include "specimens/virtual_tests/catalogue.h"

#include <fmt/format.h>

#include <algorithm>

#include "libdem/core/error.h"
#include "specimens/virtual_tests/descriptions.h"

namespace virtual_tests {

TestKind kind_of(const TestOptions& options) {
  struct Kind {
    TestKind operator()(const ElasticOptions&) const { return TestKind::elastic; }
    TestKind operator()(const UniaxialOptions& o) const {
      return o.loading == Loading::tension ? TestKind::tension : TestKind::compression;
    }
    TestKind operator()(const SplittingOptions&) const { return TestKind::splitting; }
    TestKind operator()(const BendingOptions&) const { return TestKind::bending; }
    TestKind operator()(const ShearOptions&) const { return TestKind::shear; }
    TestKind operator()(const TriaxialOptions&) const { return TestKind::triaxial; }
    TestKind operator()(const BiaxialOptions&) const { return TestKind::biaxial; }
    TestKind operator()(const CyclicOptions&) const { return TestKind::cyclic; }
    TestKind operator()(const SpallingOptions&) const { return TestKind::spalling; }
  };
  return std::visit(Kind{}, options);
}

const std::vector<TestDescription>& catalogue() {
  static const std::vector<TestDescription> tests{elastic_description(),
                                                  uniaxial_description(Loading::tension),
                                                  uniaxial_description(Loading::compression),
                                                  splitting_description(),
                                                  bending_description(),
                                                  shear_description(),
                                                  triaxial_description(),
                                                  biaxial_description(),
                                                  cyclic_description(),
                                                  spalling_description()};
  return tests;
}

const TestDescription& description_of(TestKind kind) {
  const std::vector<TestDescription>& tests = catalogue();
  return *std::find_if(tests.begin(), tests.end(), [&](const TestDescription& t) { return t.kind == kind; });
}

const TestDescription& description_of(const TestOptions& options) { return description_of(kind_of(options)); }

const TestDescription* find_test(std::string_view name) {
  for (const TestDescription& test : catalogue())
    if (test.name == name) return &test;
  return nullptr;
}

std::vector<std::string> names_of_tests() {
  std::vector<std::string> names;
  for (const TestDescription& test : catalogue()) names.push_back(test.name);
  return names;
}

std::string_view name_of(TestKind kind) { return description_of(kind).name; }

std::string text_of(const TestOptions& options) {
  const TestDescription& test = description_of(options);
  std::string text = test.name;
  if (test.version > 1) text += fmt::format(" {}", test.version);
  for (const TestOption& option : test.options) {
    const Value value = option.get(options);
    text += fmt::format("|{}=", option.key);
    if (const double* number = std::get_if<double>(&value)) text += fmt::format("{:a}", *number);
    if (const bool* yes = std::get_if<bool>(&value)) text += *yes ? "yes" : "no";
    if (const std::string* word = std::get_if<std::string>(&value)) text += *word;
  }
  return text;
}

const MeasuredQuantity* find_measured(std::string_view key) {
  for (const TestDescription& test : catalogue())
    for (const MeasuredQuantity& quantity : test.measured)
      if (quantity.key == key) return &quantity;
  return nullptr;
}

const TestOption* find_option(std::string_view key) {
  for (const TestDescription& test : catalogue())
    for (const TestOption& option : test.options)
      if (option.key == key) return &option;
  return nullptr;
}

void set_threads(TestOptions& options, int threads) {
  std::visit(
      [threads](auto& o) {
        if constexpr (requires { o.run.threads; })
          o.run.threads = threads;
        else if constexpr (requires { o.threads; })
          o.threads = threads;
      },
      options);
}

TestOutcome run_test(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                     const TestOptions& options, const dem::ProgressCallback& progress,
                     const CheckpointPolicy& checkpoint) {
  return description_of(options).run(specimen, card, options, progress, checkpoint);
}

std::optional<RateCheck> check_rate(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                    const TestOptions& options, const TestOutcome& outcome,
                                    const dem::ProgressCallback& progress, const CheckpointPolicy& checkpoint) {
  if (!outcome.run || description_of(options).usual_rate == 0) return {};
  RateCheck check;
  check.velocity = 0.5 * outcome.run->velocity;
  TestOptions slower = options;
  std::visit(
      [&](auto& o) {
        if constexpr (requires { o.run.velocity; })
          o.run.velocity = check.velocity;
        else if constexpr (requires { o.velocity; })
          o.velocity = check.velocity;
      },
      slower);
  const TestOutcome slow = run_test(specimen, card, slower, progress, checkpoint);
  check.quantity = outcome.measured.front().first;
  check.value = slow.measured.front().second;
  check.change = check.value / outcome.measured.front().second - 1;
  return check;
}

}  // namespace virtual_tests
