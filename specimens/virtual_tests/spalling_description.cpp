// The spalling bar as the catalogue shows it.
#include "libdem/core/sha256.h"
#include "specimens/virtual_tests/catalogue.h"
#include "specimens/virtual_tests/descriptions.h"

namespace virtual_tests {

TestDescription spalling_description() {
  using O = SpallingOptions;
  TestDescription test;
  test.kind = TestKind::spalling;
  test.name = "spalling";
  test.summary = "Spalling bar (Hopkinson): a pulse comes back as tension; dynamic tensile strength";
  test.defaults = O{};
  test.options = {
      axis_option<O>("the specimen's long axis", "Axis of the bar; its low end is struck"),
      choice_option<O>(
          "pulse", {"half-sine", "trapezoid"}, "half-sine", "Shape of the pulse over time",
          [](auto& o) -> auto& { return o.pulse; }),
      quantity_option<O>(
          "pulse_stress", dem::Quantity::stress, "four times the card's T", "Peak of the compressive pulse",
          [](auto& o) -> auto& { return o.incident_stress; }),
      quantity_option<O>(
          "velocity", dem::Quantity::velocity, "from the incident stress",
          "Peak velocity of the struck end, in place of a stress", [](auto& o) -> auto& { return o.velocity; }),
      quantity_option<O>(
          "pulse_duration", dem::Quantity::time, "sound's time through 0.4 of the bar", "Duration of the pulse",
          [](auto& o) -> auto& { return o.duration; }),
      number_option<O>(
          "rise", 0.01, 0.5, "0.25", "Rise of a trapezoid, part of its duration; it falls as long",
          [](auto& o) -> auto& { return o.rise; }),
      quantity_option<O>(
          "static_strength", dem::Quantity::stress, "not known",
          "Static tensile strength, that the dynamic increase factor refers to",
          [](auto& o) -> auto& { return o.static_strength; }),
      quantity_option<O>(
          "end_time", dem::Quantity::time, "three times sound's time through the bar", "End of the run",
          [](auto& o) -> auto& { return o.end_time; }),
      number_option<O>(
          "time_step_fraction", 0.01, 0.99, "0.7", "Time step over the critical one",
          [](auto& o) -> auto& { return o.time_step_fraction; })};
  test.measured = {{"spall_strength", "Pa", "spall strength, from the pull-back"},
                   {"fracture_stress", "Pa", "highest tension across the section that broke"},
                   {"strain_rate", "1/s", "strain rate there, while the tension grew"},
                   {"fracture_position", "m", "distance of that section from the free end"},
                   {"fracture_damage", "-", "broken part of the links across it"},
                   {"pull_back_velocity", "m/s", "pull-back of the free end"},
                   {"free_end_velocity", "m/s", "highest velocity of the free end"},
                   {"incident_velocity", "m/s", "highest velocity in the pulse"},
                   {"incident_stress", "Pa", "highest stress in the pulse"},
                   {"reflected_stress", "Pa", "highest tension that comes back to the middle"},
                   {"wave_speed", "m/s", "speed of the pulse"},
                   {"dynamic_increase_factor", "-", "spall over static strength"}};
  test.dynamic = true;
  test.usual_end = 3;
  test.example_specimen = "--size \"0.5x0.1x0.1 m\" --elements 3200 --seed 1";
  test.check = [](const specimens::Specimen& specimen, const dem::MaterialCard& card,
                  const TestOptions& options) { check_spalling(specimen, card, std::get<O>(options)); };
  test.run = [](const specimens::Specimen& specimen, const dem::MaterialCard& card, const TestOptions& options,
                const dem::ProgressCallback& progress, const CheckpointPolicy& checkpoint) {
    return run_spalling(specimen, card, std::get<O>(options), dem::sha256_of(text_of(options)), progress,
                        checkpoint);
  };
  return test;
}

}  // namespace virtual_tests
