#include "specimens/virtual_tests/triaxial.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libdem/probe/strain_gauge.h"
#include "specimens/virtual_tests/descriptions.h"
#include "specimens/virtual_tests/floating_platen.h"
#include "specimens/virtual_tests/membrane.h"
#include "specimens/virtual_tests/rig_test.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/slope.h"

namespace virtual_tests {
namespace {

using specimens::Specimen;

constexpr double usual_rate = 0.01, usual_confinement = 4.5e6;

/// Columns of the curve.
enum Column : std::size_t { closing, force, stress, strain, pressure_now, strain_axial, strain_lateral };

class TriaxialRig final : public Rig {
 public:
  TriaxialRig(const Specimen& given, const dem::MaterialCard& card, const TriaxialOptions& options)
      : tested(given),
        axis(loading_axis(given, options.axis)),
        pressure(options.confinement > 0 ? options.confinement : usual_confinement),
        uniaxial_strength(options.uniaxial_strength),
        ends(options.ends),
        damping(options.run.damping),
        section(given.section(axis)),
        membrane(given, axis),
        gauge(given.centres, gauge_elements(given, axis)) {
    const dem::Particles particles(given.centres, given.radii, 1);
    platens = dem::find_platens(particles, axis, given.size[axis], given.element_size());
    own.name = "triaxial";
    own.control = {"closing", "m"};
    own.stress_per_force = 1 / section;
    own.extra = {{"strain", "-"}, {"pressure", "Pa"}, {"strain_axial", "-"}, {"strain_lateral", "-"}};
    own.expected_strength = 6 * card.tensile_strength + 4 * pressure;
    own.least_peak = 1.2 * pressure + 0.2 * card.tensile_strength;
    own.length = given.size[axis];
    own.rate = usual_rate;
    own.stop_at = 0.85;
    own.likely_end = 3;
    own.furthest = 10;
    own.starts_at_rest = true;
    confined_part = std::clamp(pressure / own.expected_strength, 0.15, 1.0);
  }

  const RigFacts& facts() const override { return own; }
  const Specimen& specimen() const override { return tested; }
  NamedValues setting() const override {
    return {{"axis", std::string(1, "xyz"[axis])},
            {"ends", std::string(dem::name_of(ends))},
            {"confinement", pressure}};
  }

  void hold(dem::Particles& particles) const override {
    for (const auto& [layer, velocity] : {std::pair(&platens.low, 0.5), std::pair(&platens.high, -0.5)})
      for (const std::int32_t i : *layer)
        for (int c = 0; c < 3; ++c)
          if (c == axis || ends == dem::EndCondition::fixed)
            particles.prescribe(static_cast<std::size_t>(i), c, c == axis ? velocity : 0);
  }

  bool steers() const override { return true; }

  bool steer(dem::Particles& particles, const Moment& moment) override {
    const double confined = confined_part * moment.rise_time, starting = 0.1 * moment.rise_time;
    const double since = moment.time() - confined;
    if (since < 0) {
      const double applied = pressure_at(moment) * section, slow = 1e-3 * moment.velocity;
      move_floating(particles, platens.low, axis, applied, moment.time_step, damping, slow);
      move_floating(particles, platens.high, axis, -applied, moment.time_step, damping, slow);
      return false;
    }
    // From the speed that a platen has to its share of the closing speed.
    const double share = std::min(1.0, moment.time_step / std::max(starting - since, moment.time_step));
    for (const auto& [layer, wanted] :
         {std::pair(&platens.low, 0.5 * moment.velocity), std::pair(&platens.high, -0.5 * moment.velocity)})
      for (const std::int32_t i : *layer) {
        double& velocity = particles.kinematics[static_cast<std::size_t>(i)].rate(axis);
        velocity += share * (wanted - velocity);
      }
    return false;
  }

  std::span<const dem::ElementLoad> loads(const dem::Particles& particles, const Moment& moment) override {
    now = pressure_at(moment);
    return membrane.push(particles, now);
  }

  Reading read(const dem::Particles& particles) const override {
    return {platens.high_reaction(particles), platens.low_reaction(particles), closing_of(particles)};
  }

  void sample(const dem::Particles& particles, std::span<double> extra) const override {
    const dem::AxialStrains inside = gauge.measure(particles);
    const auto a = static_cast<std::size_t>(axis);
    extra[0] = closing_of(particles) / platens.gauge_length;
    extra[1] = now;
    extra[2] = -inside[a];
    extra[3] = -0.5 * (inside[(a + 1) % 3] + inside[(a + 2) % 3]);
  }

  std::vector<std::pair<std::string, double>> measure(const CurveTable& curve) const override;

  std::vector<std::pair<std::string, double*>> numbers() override { return {{"pressure", &now}}; }

 private:
  /// Grows smoothly, so that nothing rings.
  double pressure_at(const Moment& moment) const {
    const double part = std::min(1.0, moment.time() / (0.95 * confined_part * moment.rise_time));
    return pressure * 0.5 * (1 - std::cos(std::numbers::pi * part));
  }
  double closing_of(const dem::Particles& particles) const {
    const dem::Vec3 along = dem::Vec3::Unit(axis);
    return displacement_along(particles, platens.low, along) -
           displacement_along(particles, platens.high, along);
  }

  const Specimen& tested;
  int axis;
  double pressure, uniaxial_strength;
  dem::EndCondition ends;
  double damping, section;
  Membrane membrane;
  dem::StrainGauge gauge;
  dem::Platens platens;
  RigFacts own;
  double confined_part = 0;  ///< the first phase's time over the rise time
  double now = 0;            ///< pressure [Pa]
};

std::vector<std::pair<std::string, double>> TriaxialRig::measure(const CurveTable& curve) const {
  const std::size_t peak = row_of_peak(curve, "stress");
  std::vector<double> pressures, volumes, axial, lateral, deviators;
  std::size_t first = 0;  // of the second phase
  while (first + 1 < curve.rows() && curve.at(first, pressure_now) < 0.999 * pressure) ++first;
  for (std::size_t r = 0; r < first; ++r) {
    pressures.push_back(curve.at(r, pressure_now));
    volumes.push_back(curve.at(r, strain_axial) + 2 * curve.at(r, strain_lateral));
  }
  const double highest = curve.at(peak, stress) - pressure;
  for (std::size_t r = first; r <= peak; ++r) {
    const double deviator = curve.at(r, stress) - pressure;
    if (deviator < 0.1 * highest || deviator > highest / 3) continue;
    deviators.push_back(deviator);
    axial.push_back(curve.at(r, strain_axial));
    lateral.push_back(-curve.at(r, strain_lateral));
  }
  std::vector<std::pair<std::string, double>> measured{
      {"peak_stress", curve.at(peak, stress)},
      {"peak_deviator", highest},
      {"peak_strain", curve.at(peak, strain) - curve.at(first, strain)},
      {"E", slope_of(axial, deviators)},
      {"nu", slope_of(axial, lateral)},
      {"bulk_modulus", slope_of(volumes, pressures)}};
  if (uniaxial_strength > 0) {
    measured.emplace_back("strength_ratio", curve.at(peak, stress) / uniaxial_strength);
    measured.emplace_back("confinement_factor", (curve.at(peak, stress) - uniaxial_strength) / pressure);
  }
  return measured;
}

}  // namespace

std::unique_ptr<Rig> make_triaxial_rig(const Specimen& specimen, const dem::MaterialCard& card,
                                       const TriaxialOptions& options) {
  return std::make_unique<TriaxialRig>(specimen, card, options);
}

TestDescription triaxial_description() {
  using O = TriaxialOptions;
  TestDescription test = rig_test<O>(make_triaxial_rig);
  test.kind = TestKind::triaxial;
  test.name = "triaxial";
  test.summary = "Triaxial compression under a constant pressure on the sides: confined strength";
  test.options = quasi_static_options<O>("0.01", "0.85");
  test.options.insert(test.options.begin(),
                      {axis_option<O>("the specimen's long axis", "Loading axis"),
                       quantity_option<O>(
                           "confinement", dem::Quantity::stress, "4.5 MPa", "Pressure on the sides",
                           [](auto& o) -> auto& { return o.confinement; }),
                       choice_option<O>(
                           "ends", {"free", "fixed"}, "free", "Platens: free or fixed laterally",
                           [](auto& o) -> auto& { return o.ends; }),
                       quantity_option<O>(
                           "uniaxial_strength", dem::Quantity::stress, "not known",
                           "Strength without confinement, that the ratio and the confinement factor refer to",
                           [](auto& o) -> auto& { return o.uniaxial_strength; })});
  test.measured = {{"peak_stress", "Pa", "peak stress"},
                   {"peak_deviator", "Pa", "peak stress over the pressure"},
                   {"peak_strain", "-", "strain at the peak"},
                   {"E", "Pa", "Young's modulus E"},
                   {"nu", "-", "Poisson's ratio ν"},
                   {"bulk_modulus", "Pa", "bulk modulus while the pressure grows"},
                   {"strength_ratio", "-", "strength over the uniaxial one"},
                   {"confinement_factor", "-", "strength gained over the pressure"}};
  test.example_specimen = "--shape cylinder --size \"0.15x0.3 m\" --elements 2000 --seed 1";
  test.example_options = " --confinement \"1.5 MPa\" --rate 0.05 --stop-at 0.9";
  test.usual_rate = usual_rate;
  test.usual_end = 3;
  return test;
}

}  // namespace virtual_tests
