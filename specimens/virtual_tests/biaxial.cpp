#include "specimens/virtual_tests/biaxial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "libdem/core/error.h"
#include "libdem/drive/platens.h"
#include "libdem/probe/strain_gauge.h"
#include "specimens/virtual_tests/descriptions.h"
#include "specimens/virtual_tests/floating_platen.h"
#include "specimens/virtual_tests/rig_test.h"
#include "specimens/virtual_tests/slope.h"

namespace virtual_tests {
namespace {

using specimens::Specimen;

constexpr double usual_rate = 0.01;

/// Columns of the curve.
enum Column : std::size_t { closing, force, stress, stress_2, strain_1, strain_2, strain_3 };

int free_axis_of(const Specimen& specimen, int wanted) {
  if (specimen.shape == specimens::Shape::cylinder)
    throw dem::InputError("specimen", "is a cylinder", "a biaxial test takes a cube or a plate");
  if (wanted >= 0) return wanted;
  int shortest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (specimen.size[axis] <= specimen.size[shortest]) shortest = axis;
  return shortest;
}

/// Elements at least two element sizes from the loaded faces (at most 0.3 of the way), and away from the free
/// ones as far as a plate allows.
std::vector<std::int32_t> middle_of(const Specimen& specimen, int free_axis) {
  const double size = specimen.element_size();
  std::vector<std::int32_t> members;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    bool inside = true;
    for (int c = 0; c < 3; ++c) {
      const double length = specimen.size[c];
      const double zone = c == free_axis ? std::min(2 * size, 0.2 * length) : std::min(3 * size, 0.3 * length);
      inside = inside && specimen.centres[i][c] > zone && specimen.centres[i][c] < length - zone;
    }
    if (inside) members.push_back(static_cast<std::int32_t>(i));
  }
  if (members.size() < 8)
    throw dem::InputError("specimen",
                          fmt::format("has only {} elements where strain is measured", members.size()),
                          "make it with more elements");
  return members;
}

class BiaxialRig final : public Rig {
 public:
  BiaxialRig(const Specimen& given, const dem::MaterialCard& card, const BiaxialOptions& options)
      : tested(given),
        free_axis(free_axis_of(given, options.free_axis)),
        axes{(free_axis + 1) % 3, (free_axis + 2) % 3},
        ratio(options.ratio),
        uniaxial_strength(options.uniaxial_strength),
        damping(options.run.damping),
        gauge(given.centres, middle_of(given, free_axis)) {
    if (!(ratio >= 0 && ratio <= 1))
      throw dem::InputError("ratio", fmt::format("{} is out of range", ratio), "allowed: 0 to 1");
    const dem::Particles particles(given.centres, given.radii, 1);
    for (std::size_t pair = 0; pair < 2; ++pair) {
      platens[pair] = dem::find_platens(particles, axes[pair], given.size[axes[pair]], given.element_size());
      sections[pair] = given.section(axes[pair]);
    }
    // Closing of the second pair over the first's while all is elastic.
    const double nu = card.poisson_ratio;
    second_closing = (ratio - nu) / (1 - nu * ratio) * platens[1].gauge_length / platens[0].gauge_length;
    follow_time = 0.5 * given.size[axes[0]] / std::sqrt(card.young_modulus / card.density);
    own.name = "biaxial";
    own.control = {"closing", "m"};
    own.stress_per_force = 1 / sections[0];
    own.extra = {{"stress_2", "Pa"}, {"strain_1", "-"}, {"strain_2", "-"}, {"strain_3", "-"}};
    own.expected_strength = 7 * card.tensile_strength;
    own.least_peak = 0.2 * card.tensile_strength;
    own.length = given.size[axes[0]];
    own.rate = usual_rate;
    own.stop_at = 0.6;
    own.likely_end = 2;
    own.furthest = 10;
  }

  const RigFacts& facts() const override { return own; }
  const Specimen& specimen() const override { return tested; }
  NamedValues setting() const override {
    return {{"axis", std::string(1, "xyz"[axes[0]])},
            {"second_axis", std::string(1, "xyz"[axes[1]])},
            {"ratio", ratio}};
  }

  void hold(dem::Particles& particles) const override {
    const std::array<double, 2> speed{0.5, 0.5 * second_closing};
    for (std::size_t pair = 0; pair < (ratio > 0 ? 2u : 1u); ++pair)
      for (const auto& [layer, velocity] :
           {std::pair(&platens[pair].low, speed[pair]), std::pair(&platens[pair].high, -speed[pair])})
        for (const std::int32_t i : *layer)
          particles.prescribe(static_cast<std::size_t>(i), axes[pair], velocity);
  }

  bool steers() const override { return ratio > 0; }

  bool steer(dem::Particles& particles, const Moment& moment) override {
    if (moment.step == 0) return false;  // no forces are known yet
    const double felt =
        0.5 * (platens[0].low_reaction(particles) + platens[0].high_reaction(particles)) / sections[0];
    followed += std::min(1.0, moment.time_step / follow_time) * (felt - followed);
    const double applied = ratio * followed * sections[1], slow = 1e-3 * moment.velocity;
    move_floating(particles, platens[1].low, axes[1], applied, moment.time_step, damping, slow);
    move_floating(particles, platens[1].high, axes[1], -applied, moment.time_step, damping, slow);
    return false;
  }

  Reading read(const dem::Particles& particles) const override {
    const dem::Vec3 along = dem::Vec3::Unit(axes[0]);
    return {platens[0].high_reaction(particles), platens[0].low_reaction(particles),
            displacement_along(particles, platens[0].low, along) -
                displacement_along(particles, platens[0].high, along)};
  }

  void sample(const dem::Particles& particles, std::span<double> extra) const override {
    const dem::AxialStrains inside = gauge.measure(particles);
    extra[0] = ratio > 0 ? 0.5 * (platens[1].low_reaction(particles) + platens[1].high_reaction(particles)) /
                               sections[1]
                         : 0;
    extra[1] = inside[static_cast<std::size_t>(axes[0])];
    extra[2] = inside[static_cast<std::size_t>(axes[1])];
    extra[3] = inside[static_cast<std::size_t>(free_axis)];
  }

  std::vector<std::pair<std::string, double>> measure(const CurveTable& curve) const override {
    const std::size_t peak = row_of_peak(curve, "stress");
    const double highest = curve.at(peak, stress);
    std::vector<double> stresses, strains;
    for (std::size_t r = 0; r <= peak; ++r)
      if (curve.at(r, stress) > 0.1 * highest && curve.at(r, stress) < highest / 3) {
        stresses.push_back(curve.at(r, stress));
        strains.push_back(-curve.at(r, strain_1));
      }
    std::vector<std::pair<std::string, double>> measured{{"peak_stress", highest},
                                                         {"second_stress_at_peak", curve.at(peak, stress_2)},
                                                         {"strain_1_at_peak", -curve.at(peak, strain_1)},
                                                         {"strain_2_at_peak", -curve.at(peak, strain_2)},
                                                         {"strain_3_at_peak", -curve.at(peak, strain_3)},
                                                         {"biaxial_modulus", slope_of(strains, stresses)}};
    if (uniaxial_strength > 0) measured.emplace_back("strength_ratio", highest / uniaxial_strength);
    return measured;
  }

  std::vector<std::pair<std::string, double*>> numbers() override { return {{"followed", &followed}}; }

 private:
  const Specimen& tested;
  int free_axis;
  std::array<int, 2> axes;
  double ratio, uniaxial_strength, damping;
  dem::StrainGauge gauge;
  std::array<dem::Platens, 2> platens;
  std::array<double, 2> sections{};
  double second_closing = 0;
  double follow_time = 0;  ///< in which the second pair follows the first: half a passage of sound [s]
  RigFacts own;
  double followed = 0;  ///< stress of the first pair, smoothed over that time [Pa]
};

}  // namespace

std::unique_ptr<Rig> make_biaxial_rig(const Specimen& specimen, const dem::MaterialCard& card,
                                      const BiaxialOptions& options) {
  return std::make_unique<BiaxialRig>(specimen, card, options);
}

TestDescription biaxial_description() {
  using O = BiaxialOptions;
  TestDescription test = rig_test<O>(make_biaxial_rig);
  test.kind = TestKind::biaxial;
  test.name = "biaxial";
  test.summary = "Biaxial compression between brush platens at a constant stress ratio";
  test.options = quasi_static_options<O>("0.01", "0.6");
  test.options.insert(
      test.options.begin(),
      {choice_option<O>(
           "free_axis", {"x", "y", "z"}, "the shortest side", "Axis that nothing presses on",
           [](auto& o) -> auto& { return o.free_axis; }),
       number_option<O>(
           "ratio", 0, 1, "1", "Second stress over the first", [](auto& o) -> auto& { return o.ratio; }),
       quantity_option<O>(
           "uniaxial_strength", dem::Quantity::stress, "not known",
           "Uniaxial strength that the ratio of strengths refers to",
           [](auto& o) -> auto& { return o.uniaxial_strength; })});
  test.measured = {{"peak_stress", "Pa", "peak stress"},
                   {"second_stress_at_peak", "Pa", "second stress at the peak"},
                   {"strain_1_at_peak", "-", "first strain at the peak"},
                   {"strain_2_at_peak", "-", "second strain at the peak"},
                   {"strain_3_at_peak", "-", "strain of the free direction at the peak"},
                   {"biaxial_modulus", "Pa", "first stress over first strain"},
                   {"strength_ratio", "-", "strength over the uniaxial one"}};
  test.example_specimen = "--size \"0.2x0.2x0.1 m\" --elements 2200 --seed 1";
  test.example_options = " --rate 0.05 --stop-at 0.9";
  test.usual_rate = usual_rate;
  return test;
}

}  // namespace virtual_tests
