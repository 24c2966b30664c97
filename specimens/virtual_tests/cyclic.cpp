#include "specimens/virtual_tests/cyclic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdem/core/error.h"
#include "libdem/probe/strain_gauge.h"
#include "specimens/virtual_tests/descriptions.h"
#include "specimens/virtual_tests/rig_test.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/slope.h"

namespace virtual_tests {
namespace {

using specimens::Specimen;

constexpr double usual_rate = 0.01;

/// Columns of the curve.
enum Column : std::size_t { closing, force, stress, strain, cycle, strain_axial };

class CyclicRig final : public Rig {
 public:
  CyclicRig(const Specimen& given, const dem::MaterialCard& card, const CyclicOptions& options)
      : tested(given),
        axis(loading_axis(given, options.axis)),
        sign(options.loading == Loading::tension ? -1.0 : 1.0),
        ends(options.ends),
        loading(options.loading),
        unload_to(options.unload_to),
        cycles(options.cycles),
        gauge(given.centres, gauge_elements(given, axis)) {
    if (!(unload_to >= 0 && unload_to < 1))
      throw dem::InputError("unload_to", fmt::format("{} is out of range", unload_to), "allowed: 0 to below 1");
    const dem::Particles particles(given.centres, given.radii, 1);
    platens = dem::find_platens(particles, axis, given.size[axis], given.element_size());
    const bool tension = loading == Loading::tension;
    own.name = "cyclic";
    own.control = {tension ? "opening" : "closing", "m"};
    own.stress_per_force = 1 / given.section(axis);
    own.extra = {{"strain", "-"}, {"cycle", "-"}, {"strain_axial", "-"}};
    own.expected_strength = (tension ? 0.9 : 6) * card.tensile_strength;
    own.least_peak = 0.2 * card.tensile_strength;
    own.length = given.size[axis];
    own.rate = usual_rate;
    own.stop_at = tension ? 0.3 : 0.6;
    own.likely_end = tension ? 1 + card.softening / 3 : 1.5;
    own.furthest = tension ? 20 : 8;
    const double expected =
        options.run.expected_strength > 0 ? options.run.expected_strength : own.expected_strength;
    increment = (options.increment > 0 ? options.increment : 0.4 * expected / card.young_modulus) *
                platens.gauge_length;
    target = increment;
  }

  const RigFacts& facts() const override { return own; }
  const Specimen& specimen() const override { return tested; }
  NamedValues setting() const override {
    return {{"axis", std::string(1, "xyz"[axis])},
            {"ends", std::string(dem::name_of(ends))},
            {"loading", std::string(name_of(loading))},
            {"increment", increment / platens.gauge_length},
            {"unload_to", unload_to}};
  }

  void hold(dem::Particles& particles) const override {
    for (const auto& [layer, velocity] :
         {std::pair(&platens.low, 0.5 * sign), std::pair(&platens.high, -0.5 * sign)})
      for (const std::int32_t i : *layer)
        for (int c = 0; c < 3; ++c)
          if (c == axis || ends == dem::EndCondition::fixed)
            particles.prescribe(static_cast<std::size_t>(i), c, c == axis ? velocity : 0);
  }

  bool steers() const override { return true; }

  bool steer(dem::Particles& particles, const Moment& moment) override {
    if (moment.step == 0) {  // all moves as the elastic solution wants it
      speed = 1;
      return false;
    }
    const Reading reading = read(particles);
    const double felt = 0.5 * (reading.force + reading.opposing);
    if (direction > 0 && reading.control >= target && (cycles == 0 || turns < cycles)) {
      direction = -1, turned_at = felt, turns += 1;
      target = reading.control + increment;
    } else if (direction < 0 && felt <= unload_to * turned_at) {
      direction = 1;
    }
    // Turns within a twentieth of the rise time: a sudden one would ring.
    const double most = moment.time_step / (0.05 * moment.rise_time);
    speed += std::clamp(direction - speed, -most, most);
    const double each = 0.5 * sign * speed * moment.velocity;
    for (const auto& [layer, velocity] : {std::pair(&platens.low, each), std::pair(&platens.high, -each)})
      for (const std::int32_t i : *layer)
        particles.kinematics[static_cast<std::size_t>(i)].rate(axis) = velocity;
    return false;
  }

  Reading read(const dem::Particles& particles) const override {
    const dem::Vec3 along = dem::Vec3::Unit(axis);
    return {sign * platens.high_reaction(particles), sign * platens.low_reaction(particles),
            sign * (displacement_along(particles, platens.low, along) -
                    displacement_along(particles, platens.high, along))};
  }

  void sample(const dem::Particles& particles, std::span<double> extra) const override {
    extra[0] = read(particles).control / platens.gauge_length;
    extra[1] = turns;
    extra[2] = -sign * gauge.measure(particles)[static_cast<std::size_t>(axis)];
  }

  bool has_fallen(const SoFar& so_far) const override {
    return on_the_envelope(so_far) && Rig::has_fallen(so_far);
  }
  bool is_over(const SoFar& so_far) const override { return on_the_envelope(so_far) && Rig::is_over(so_far); }

  std::vector<std::pair<std::string, double>> measure(const CurveTable& curve) const override;

  std::vector<std::pair<std::string, double*>> numbers() override {
    return {{"direction", &direction},
            {"speed", &speed},
            {"target", &target},
            {"turns", &turns},
            {"turned_at", &turned_at}};
  }

 private:
  /// No unloading or reloading is under way: it has never come as far.
  static bool on_the_envelope(const SoFar& so_far) {
    double furthest = 0;
    for (std::size_t r = 0; r < so_far.curve.rows(); ++r)
      furthest = std::max(furthest, so_far.curve.at(r, closing));
    return so_far.control >= furthest;
  }

  const Specimen& tested;
  int axis;
  double sign;
  dem::EndCondition ends;
  Loading loading;
  double unload_to;
  int cycles;
  double increment = 0;  ///< of the closing [m]
  dem::StrainGauge gauge;
  dem::Platens platens;
  RigFacts own;
  // What changes: numbers all of them, for the checkpoint.
  double direction = 1;  ///< wanted: 1 loads, -1 unloads
  double speed = 0;      ///< in parts of the test's, with its direction
  double target = 0;     ///< closing at which it turns next [m]
  double turns = 0;      ///< unloadings begun
  double turned_at = 0;  ///< force at the last of them [N]
};

/// One unloading: the row where it began, and the row where it ended.
struct Unloading {
  std::size_t top, bottom;
};

std::vector<Unloading> unloadings_of(const CurveTable& curve) {
  std::vector<Unloading> found;
  for (std::size_t r = 1; r < curve.rows(); ++r) {
    if (curve.at(r, cycle) > curve.at(r - 1, cycle)) found.push_back({r - 1, r - 1});
    if (!found.empty() && curve.at(r, closing) < curve.at(found.back().bottom, closing))
      found.back().bottom = r;
  }
  for (Unloading& unloading : found)  // the windows around the turn: it began where it was furthest
    for (std::size_t r = unloading.top; r <= unloading.bottom; ++r)
      if (curve.at(r, closing) > curve.at(unloading.top, closing)) unloading.top = r;
  // The last one may have been cut off.
  std::erase_if(found,
                [&](const Unloading& u) { return curve.at(u.bottom, strain) >= curve.at(u.top, strain); });
  return found;
}

std::vector<std::pair<std::string, double>> CyclicRig::measure(const CurveTable& curve) const {
  const std::size_t peak = row_of_peak(curve, "stress");
  const double highest = curve.at(peak, stress);
  std::vector<double> stresses, strains;
  for (std::size_t r = 0; r < curve.rows() && curve.at(r, cycle) == 0 && r <= peak; ++r)
    if (curve.at(r, stress) > 0.05 * highest && curve.at(r, stress) < highest / 3) {
      stresses.push_back(curve.at(r, stress));
      strains.push_back(curve.at(r, strain));
    }
  const double modulus = slope_of(strains, stresses);
  std::vector<std::pair<std::string, double>> measured{
      {"peak_stress", highest},     {"peak_strain", curve.at(peak, strain)},
      {"loading_modulus", modulus}, {"cycles", 0},
      {"residual_strain", 0},       {"unloading_strain", 0},
      {"unloading_modulus", 0}};
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<std::pair<std::string, double>> each;
  for (const Unloading& unloading : unloadings_of(curve)) {
    const double from = curve.at(unloading.top, strain), to = curve.at(unloading.bottom, strain);
    const double slope = (curve.at(unloading.top, stress) - curve.at(unloading.bottom, stress)) / (from - to);
    const double residual = to - curve.at(unloading.bottom, stress) / slope;
    measured[3].second += 1;
    const auto number = static_cast<int>(measured[3].second);
    each.emplace_back(fmt::format("unloading_strain_{}", number), from);
    each.emplace_back(fmt::format("residual_strain_{}", number), residual);
    each.emplace_back(fmt::format("unloading_modulus_{}", number), slope);
    const double off = std::abs(from - curve.at(peak, strain));
    if (off > nearest) continue;
    nearest = off;
    measured[4].second = residual, measured[5].second = from, measured[6].second = slope;
  }
  measured.insert(measured.end(), each.begin(), each.end());
  return measured;
}

}  // namespace

std::unique_ptr<Rig> make_cyclic_rig(const Specimen& specimen, const dem::MaterialCard& card,
                                     const CyclicOptions& options) {
  return std::make_unique<CyclicRig>(specimen, card, options);
}

TestDescription cyclic_description() {
  using O = CyclicOptions;
  TestDescription test = rig_test<O>(make_cyclic_rig);
  test.kind = TestKind::cyclic;
  test.name = "cyclic";
  test.summary = "Uniaxial loading with unloadings: envelope, residual strains, unloading moduli";
  test.options = quasi_static_options<O>("0.01", "0.6 in compression, 0.3 in tension");
  test.options.insert(
      test.options.begin(),
      {choice_option<O>(
           "loading", {"tension", "compression"}, "compression", "Direction of loading",
           [](auto& o) -> auto& { return o.loading; }),
       axis_option<O>("the specimen's long axis", "Loading axis"),
       choice_option<O>(
           "ends", {"free", "fixed"}, "free", "Platens: free or fixed laterally",
           [](auto& o) -> auto& { return o.ends; }),
       quantity_option<O>(
           "increment", dem::Quantity::ratio, "0.4 times the elastic strain at the expected strength",
           "Strain between two unloadings", [](auto& o) -> auto& { return o.increment; }),
       number_option<O>(
           "unload_to", 0, 0.99, "0", "Part of the stress at which reloading begins",
           [](auto& o) -> auto& { return o.unload_to; })});
  test.measured = {{"peak_stress", "Pa", "peak stress"},
                   {"peak_strain", "-", "strain at the peak"},
                   {"loading_modulus", "Pa", "stress over strain between the platens, first loading"},
                   {"cycles", "-", "unloadings"},
                   {"residual_strain", "-", "strain left by the unloading nearest to the peak"},
                   {"unloading_strain", "-", "strain at which that unloading began"},
                   {"unloading_modulus", "Pa", "mean slope of that unloading"}};
  test.example_specimen = "--size \"0.4x0.2x0.2 m\" --elements 1400 --seed 1";
  test.usual_rate = usual_rate;
  test.usual_end = 8;
  return test;
}

}  // namespace virtual_tests
