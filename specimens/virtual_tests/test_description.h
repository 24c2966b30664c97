// How a virtual test presents itself: its name, its options, what it measures. One table serves the command
// line, study files and the hashes that name results.
#pragma once
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "libdem/core/progress.h"
#include "libdem/core/units.h"
#include "libdem/material/material_card.h"
#include "specimens/virtual_tests/checkpoint_policy.h"
#include "specimens/virtual_tests/outcome.h"
#include "specimens/virtual_tests/test_options.h"

namespace virtual_tests {

/// One option of a test.
struct TestOption {
  enum class Kind { quantity, number, choice, flag };

  std::string key;  ///< as in a study file; the command line writes '-' for its '_'
  Kind kind = Kind::quantity;
  dem::Quantity quantity = dem::Quantity::ratio;
  double low = 0, high = std::numeric_limits<double>::infinity();  ///< a quantity must be above `low`
  std::vector<std::string> choices;
  std::string fallback;  ///< what holds where it is not given, in words
  std::string help;
  /// A double (SI), a bool or one of the choices, by kind. `get` gives what is set now: 0 or "" where the test
  /// chooses.
  std::function<void(TestOptions&, const Value&)> set;
  std::function<Value(const TestOptions&)> get;
};

/// A quantity that a test measures, as a key of result.json.
struct MeasuredQuantity {
  std::string key;
  std::string unit;   ///< SI: "Pa", "J/m2", "m", "-"
  std::string words;  ///< "splitting strength"
};

struct TestDescription {
  TestKind kind = TestKind::elastic;
  std::string name;     ///< of `spall test NAME` and of kind = "NAME"
  std::string summary;  ///< one line
  TestOptions defaults;
  std::vector<TestOption> options;
  std::vector<MeasuredQuantity> measured;  ///< the main one first
  std::string example_specimen;            ///< arguments of `spall specimen make` for the example in --help
  std::string example_options{};           ///< options of the test in that example: "", or " --rate 0.05"
  /// Raise it whenever the same options give other numbers: what is kept of before is then not taken for now.
  int version = 1;
  double usual_rate = 0;  ///< QuasiStaticOptions::rate where nothing is given; 0: there is none
  bool dynamic = false;   ///< waves are its matter: it has time steps, but no rate
  double usual_end = 2;   ///< in displacements of the elastic peak, for estimates

  /// Throws InputError where the test cannot be done on the specimen; computes little.
  std::function<void(const specimens::Specimen&, const dem::MaterialCard&, const TestOptions&)> check;
  std::function<TestOutcome(const specimens::Specimen&, const dem::MaterialCard&, const TestOptions&,
                            const dem::ProgressCallback&, const CheckpointPolicy&)>
      run;
};

/// Builders of options. `access(options)` names the member.
template <class Options, class Access>
TestOption quantity_option(std::string key, dem::Quantity quantity, std::string fallback, std::string help,
                           Access access) {
  TestOption option;
  option.key = std::move(key);
  option.quantity = quantity;
  option.fallback = std::move(fallback);
  option.help = std::move(help);
  option.set = [access](TestOptions& o, const Value& value) {
    access(std::get<Options>(o)) = std::get<double>(value);
  };
  option.get = [access](const TestOptions& o) { return Value(double{access(std::get<Options>(o))}); };
  return option;
}

template <class Options, class Access>
TestOption number_option(std::string key, double low, double high, std::string fallback, std::string help,
                         Access access) {
  TestOption option = quantity_option<Options>(std::move(key), dem::Quantity::ratio, std::move(fallback),
                                               std::move(help), access);
  option.kind = TestOption::Kind::number;
  option.low = low, option.high = high;
  return option;
}

template <class Options, class Access>
TestOption flag_option(std::string key, std::string help, Access access) {
  TestOption option;
  option.key = std::move(key);
  option.kind = TestOption::Kind::flag;
  option.fallback = "no";
  option.help = std::move(help);
  option.set = [access](TestOptions& o, const Value& value) {
    access(std::get<Options>(o)) = std::get<bool>(value);
  };
  option.get = [access](const TestOptions& o) { return Value(bool{access(std::get<Options>(o))}); };
  return option;
}

/// `access` names an int that counts through the choices; -1 where the test chooses.
template <class Options, class Access>
TestOption choice_option(std::string key, const std::vector<std::string>& choices, std::string fallback,
                         std::string help, Access access) {
  TestOption option;
  option.key = std::move(key);
  option.kind = TestOption::Kind::choice;
  option.choices = choices;
  option.fallback = std::move(fallback);
  option.help = std::move(help);
  option.set = [access, choices](TestOptions& o, const Value& value) {
    for (std::size_t k = 0; k < choices.size(); ++k)
      if (choices[k] == std::get<std::string>(value))
        access(std::get<Options>(o)) =
            static_cast<std::remove_reference_t<decltype(access(std::get<Options>(o)))>>(k);
  };
  option.get = [access, choices](const TestOptions& o) {
    const auto k = static_cast<int>(access(std::get<Options>(o)));
    return Value(k < 0 ? std::string() : choices[static_cast<std::size_t>(k)]);
  };
  return option;
}

/// The options of QuasiStaticOptions, which `Options` holds as `run`. `control`: the key of its largest
/// control, "max_displacement" with a length or "max_strain" with a ratio.
template <class Options>
std::vector<TestOption> quasi_static_options(const std::string& rate, const std::string& stop_at,
                                             const std::string& control = "max_displacement",
                                             dem::Quantity quantity = dem::Quantity::length) {
  return {quantity_option<Options>(
              "velocity", dem::Quantity::velocity, "slow enough for the card",
              "Speed of what is driven, in place of a rate", [](auto& o) -> auto& { return o.run.velocity; }),
          number_option<Options>(
              "rate", 1e-6, 1, rate, "Sound's time through the specimen over the time to the elastic peak",
              [](auto& o) -> auto& { return o.run.rate; }),
          quantity_option<Options>(
              "expected_strength", dem::Quantity::stress, "guessed from the card",
              "Strength that sets speed and sampling where the guess will not do",
              [](auto& o) -> auto& { return o.run.expected_strength; }),
          number_option<Options>(
              "damping", 0, 0.99, "0.3", "Local damping", [](auto& o) -> auto& { return o.run.damping; }),
          number_option<Options>(
              "time_step_fraction", 0.01, 0.99, "0.7", "Time step over the critical one",
              [](auto& o) -> auto& { return o.run.time_step_fraction; }),
          number_option<Options>(
              "stop_at", 0.001, 0.999, stop_at, "End when the stress has fallen to this part of the peak",
              [](auto& o) -> auto& { return o.run.stop_at; }),
          quantity_option<Options>(
              control, quantity, "chosen from the expected strength", "End there at the latest",
              [](auto& o) -> auto& { return o.run.max_control; })};
}

template <class Options>
TestOption axis_option(std::string fallback, std::string help) {
  return choice_option<Options>(
      "axis", {"x", "y", "z"}, std::move(fallback), std::move(help), [](auto& o) -> auto& { return o.axis; });
}

}  // namespace virtual_tests
