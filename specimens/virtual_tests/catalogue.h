// The list of virtual tests.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/virtual_tests/test_description.h"

namespace virtual_tests {

/// All tests, in the order in which people meet them.
const std::vector<TestDescription>& catalogue();
const TestDescription& description_of(TestKind kind);
const TestDescription& description_of(const TestOptions& options);
/// null if there is no test of that name.
const TestDescription* find_test(std::string_view name);
std::vector<std::string> names_of_tests();
std::string_view name_of(TestKind kind);

/// Everything in the options on which a test's bits depend, as text: "splitting|axis=x|strip_width=0x1p-6".
std::string text_of(const TestOptions& options);

/// The quantity of that key in any of the tests; null if there is none.
const MeasuredQuantity* find_measured(std::string_view key);

/// The option of that key in any of the tests; null if there is none.
const TestOption* find_option(std::string_view key);

/// Threads that the test may use; the bits do not depend on it.
void set_threads(TestOptions& options, int threads);

/// Runs a test. Throws what the test throws.
TestOutcome run_test(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                     const TestOptions& options, const dem::ProgressCallback& progress = {},
                     const CheckpointPolicy& checkpoint = {});

/// What a test's main quantity does at half the speed.
struct RateCheck {
  std::string quantity;
  double velocity = 0;  ///< half of the outcome's [m/s]
  double value = 0;     ///< the quantity at that speed
  double change = 0;    ///< value over the outcome's, minus 1 [-]
};
/// Runs the test once more at half the speed of `outcome`; nothing for a test without time steps.
std::optional<RateCheck> check_rate(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                                    const TestOptions& options, const TestOutcome& outcome,
                                    const dem::ProgressCallback& progress = {},
                                    const CheckpointPolicy& checkpoint = {});

}  // namespace virtual_tests
