// The elastic test and the uniaxial ones as the catalogue shows them.
#include "specimens/virtual_tests/descriptions.h"
#include "specimens/virtual_tests/setup.h"

namespace virtual_tests {
namespace {

std::string letter_of(int axis) { return std::string(1, "xyz"[axis]); }

constexpr const char* small_prism = "--size \"0.4x0.2x0.2 m\" --elements 1400 --seed 1";

TestOutcome run_elastic_test(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                             const TestOptions& options, const dem::ProgressCallback&,
                             const CheckpointPolicy&) {
  ElasticOptions asked = std::get<ElasticOptions>(options);
  asked.axis = loading_axis(specimen, asked.axis);
  const ElasticResult found = run_elastic(specimen, card, asked);
  TestOutcome outcome;
  outcome.measured = {{"E", found.young_modulus}, {"nu", found.poisson_ratio}};
  outcome.setting = {{"links", static_cast<std::int64_t>(specimen.links.size())},
                     {"axis", letter_of(asked.axis)},
                     {"iterations", std::int64_t{found.iterations}}};
  outcome.wall_seconds = found.wall_seconds;
  return outcome;
}

TestOutcome run_uniaxial_test(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                              const TestOptions& options, const dem::ProgressCallback& progress,
                              const CheckpointPolicy& checkpoint) {
  UniaxialOptions asked = std::get<UniaxialOptions>(options);
  asked.axis = loading_axis(specimen, asked.axis);
  UniaxialResult found = run_uniaxial(specimen, card, asked, progress, checkpoint);
  TestOutcome outcome;
  outcome.setting = {{"ends", std::string(dem::name_of(asked.ends))}, {"axis", letter_of(asked.axis)}};
  if (asked.ends == dem::EndCondition::rough)
    outcome.setting.emplace_back("platen_friction", asked.platen_friction);
  outcome.measured = {{"peak_stress", found.peak_stress},
                      {"peak_strain", found.peak_strain},
                      {"E", found.young_modulus},
                      {"nu", found.poisson_ratio},
                      {"work_of_fracture", found.work_of_fracture}};
  outcome.curve = table_of(found.curve);
  StepsTaken& run = outcome.run.emplace();
  run.steps = found.steps;
  run.time_step = found.time_step;
  run.critical_time_step = found.critical_time_step;
  run.velocity = found.velocity;
  run.damping = asked.damping;
  run.energy_balance_error = found.energy_balance_error;
  run.unbalanced_force_ratio = found.unbalanced_force_ratio;
  run.passed_peak = found.passed_peak;
  run.links = found.links;
  run.broken_links = found.broken_links;
  run.step_loop_seconds = found.step_loop_seconds;
  run.state_sha256 = found.state_sha256;
  outcome.wall_seconds = found.wall_seconds;
  outcome.fields = std::move(static_cast<FinalFields&>(found));
  return outcome;
}

}  // namespace

TestDescription elastic_description() {
  TestDescription test;
  test.kind = TestKind::elastic;
  test.name = "elastic";
  test.summary = "Young's modulus and Poisson's ratio, by one static solve";
  test.defaults = ElasticOptions{};
  test.options = {axis_option<ElasticOptions>("the specimen's long axis", "Loading axis")};
  test.measured = {{"E", "Pa", "Young's modulus E"}, {"nu", "-", "Poisson's ratio ν"}};
  test.example_specimen = small_prism;
  test.check = [](const specimens::Specimen& specimen, const dem::MaterialCard&, const TestOptions& options) {
    gauge_elements(specimen, loading_axis(specimen, std::get<ElasticOptions>(options).axis));
  };
  test.run = run_elastic_test;
  return test;
}

TestDescription uniaxial_description(Loading loading) {
  const bool tension = loading == Loading::tension;
  using O = UniaxialOptions;
  TestDescription test;
  test.kind = tension ? TestKind::tension : TestKind::compression;
  test.name = std::string(name_of(loading));
  test.summary = std::string("Uniaxial ") + test.name + " to past the peak, quasi-static";
  O defaults;
  defaults.loading = loading;
  test.defaults = defaults;
  test.options = {
      axis_option<O>("the specimen's long axis", "Loading axis"),
      choice_option<O>(
          "ends", tension ? std::vector<std::string>{"free", "fixed"} : dem::end_condition_names(), "free",
          tension ? "Ends: free or fixed laterally" : "Platens: free, fixed (glued) or rough (dry friction)",
          [](auto& o) -> auto& { return o.ends; }),
      quantity_option<O>(
          "velocity", dem::Quantity::velocity, "slow enough for the card",
          "Speed at which the platens approach or part", [](auto& o) -> auto& { return o.velocity; }),
      number_option<O>(
          "rate", 1e-6, 1, tension ? "0.03" : "0.01",
          "Sound's time through the specimen over the time to the elastic peak",
          [](auto& o) -> auto& { return o.rate; }),
      quantity_option<O>(
          "expected_strength", dem::Quantity::stress, "guessed from the card",
          "Strength that sets speed and sampling where the guess will not do",
          [](auto& o) -> auto& { return o.expected_strength; }),
      number_option<O>(
          "damping", 0, 0.99, "0.3", "Local damping", [](auto& o) -> auto& { return o.damping; }),
      number_option<O>(
          "time_step_fraction", 0.01, 0.99, "0.7", "Time step over the critical one",
          [](auto& o) -> auto& { return o.time_step_fraction; }),
      number_option<O>(
          "stop_at", 0.001, 0.999, tension ? "0.15" : "0.6",
          "End when the stress has fallen to this part of the peak",
          [](auto& o) -> auto& { return o.stop_at; }),
      quantity_option<O>(
          "max_strain", dem::Quantity::ratio, "chosen from the expected strength",
          "End at this strain at the latest", [](auto& o) -> auto& { return o.max_strain; })};
  test.options.back().high = 0.5;
  if (!tension)
    test.options.insert(test.options.begin() + 2,
                        number_option<O>(
                            "platen_friction", 0, 2, "0.1", "Coefficient of friction of rough platens",
                            [](auto& o) -> auto& { return o.platen_friction; }));
  test.measured = {{"peak_stress", "Pa", "peak stress"},
                   {"peak_strain", "-", "strain at the peak"},
                   {"E", "Pa", "Young's modulus E"},
                   {"nu", "-", "Poisson's ratio ν"},
                   {"work_of_fracture", "J/m2", "work after the peak per area"}};
  test.example_specimen = small_prism;
  test.usual_rate = tension ? 0.03 : 0.01;
  test.check = [](const specimens::Specimen& specimen, const dem::MaterialCard&, const TestOptions& options) {
    const O& asked = std::get<O>(options);
    asked.validate();
    gauge_elements(specimen, loading_axis(specimen, asked.axis));
  };
  test.run = run_uniaxial_test;
  return test;
}

}  // namespace virtual_tests
