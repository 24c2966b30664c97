#include "specimens/virtual_tests/shear.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"
#include "specimens/virtual_tests/descriptions.h"
#include "specimens/virtual_tests/rig_test.h"
#include "specimens/virtual_tests/setup.h"

namespace virtual_tests {
namespace {

using dem::Vec3;
using specimens::Specimen;

constexpr double usual_rate = 0.01;

class ShearRig final : public Rig {
 public:
  ShearRig(const Specimen& given, const dem::MaterialCard& card, const ShearOptions& options)
      : tested(given),
        normal(loading_axis(given, options.axis)),
        along((normal + 1) % 3),
        gap(options.gap > 0 ? options.gap : 3 * given.element_size()),
        section(given.section(normal)),
        normal_stress(options.normal_stress),
        damping(options.run.damping) {
    find_boxes();
    own.name = "shear";
    own.control = {"displacement", "m"};
    own.stress_per_force = 1 / section;
    own.extra = {{"dilation", "m"}, {"normal_stress", "Pa"}};
    own.expected_strength = 2.5 * card.tensile_strength + 0.7 * normal_stress;
    own.least_peak = 0.2 * card.tensile_strength;
    own.length = given.size[normal];
    own.rate = usual_rate;
    own.stop_at = 0.6;
    own.likely_end = 2.5;
    own.furthest = 15;
    own.starts_at_rest = normal_stress > 0;
  }

  const RigFacts& facts() const override { return own; }
  const Specimen& specimen() const override { return tested; }
  NamedValues setting() const override {
    return {{"axis", std::string(1, "xyz"[normal])},
            {"shear_axis", std::string(1, "xyz"[along])},
            {"gap", gap},
            {"normal_stress", normal_stress}};
  }

  void hold(dem::Particles& particles) const override {
    for (const std::int32_t i : lower)
      for (int c = 0; c < 3; ++c) particles.prescribe(static_cast<std::size_t>(i), c, 0);
    for (const std::int32_t i : upper)
      for (int c = 0; c < 3; ++c) particles.prescribe(static_cast<std::size_t>(i), c, c == along ? 1 : 0);
  }

  bool steers() const override { return true; }

  bool steer(dem::Particles& particles, const Moment& moment) override {
    const double growing = 0.5 * moment.rise_time, starting = 0.1 * moment.rise_time;
    const double t = moment.time();
    double part = 1, speed = moment.velocity;
    if (own.starts_at_rest) {
      part = std::clamp(t / growing, 0.0, 1.0);
      speed *= std::clamp((t - growing) / starting, 0.0, 1.0);
    }
    // The upper half-box along the normal, as one body: what the specimen pushes against what is applied.
    double mass = 0;
    for (const std::int32_t i : upper) mass += particles.element_mass(static_cast<std::size_t>(i));
    const double force = force_along(particles, upper, Vec3::Unit(normal)) - part * normal_stress * section;
    const dem::Kinematics& any = particles.kinematics[static_cast<std::size_t>(upper.front())];
    double lift = any.rate(normal);
    const double slow = 1e-3 * moment.velocity;
    const double drag = damping * std::abs(force) * std::clamp(lift / slow, -1.0, 1.0);
    lift += moment.time_step * (force - drag) / mass;
    for (const std::int32_t i : upper) {
      dem::Kinematics& k = particles.kinematics[static_cast<std::size_t>(i)];
      k.rate(normal) = lift;
      k.rate(along) = speed;
    }
    return false;
  }

  Reading read(const dem::Particles& particles) const override {
    const Vec3 direction = Vec3::Unit(along);
    return {-force_along(particles, upper, direction), force_along(particles, lower, direction),
            displacement_along(particles, upper, direction)};
  }

  void sample(const dem::Particles& particles, std::span<double> extra) const override {
    const Vec3 direction = Vec3::Unit(normal);
    extra[0] = displacement_along(particles, upper, direction);
    extra[1] = -force_along(particles, lower, direction) / section;
  }

  std::vector<std::pair<std::string, double>> measure(const CurveTable& curve) const override {
    const std::size_t peak = row_of_peak(curve, "stress");
    return {{"shear_strength", curve.at(peak, 2)},
            {"largest_force", curve.at(peak, 1)},
            {"displacement_at_peak", curve.at(peak, 0)},
            {"normal_stress_at_peak", curve.at(peak, 4)},
            {"last_shear_stress", curve.rows() == 0 ? 0 : curve.at(curve.rows() - 1, 2)},
            {"dilation_at_end", curve.rows() == 0 ? 0 : curve.at(curve.rows() - 1, 3)}};
  }

 private:
  void find_boxes() {
    const double size = tested.element_size(), middle = 0.5 * tested.size[normal];
    for (std::size_t i = 0; i < tested.elements(); ++i) {
      if (tested.depth(tested.centres[i]) >= size) continue;
      const double above = tested.centres[i][normal] - middle;
      if (std::abs(above) <= 0.5 * gap) continue;
      (above < 0 ? lower : upper).push_back(static_cast<std::int32_t>(i));
    }
    constexpr std::size_t least = 8;
    if (std::min(lower.size(), upper.size()) < least)
      throw dem::InputError("gap",
                            fmt::format("of {:.4g} mm leaves only {} elements in a half-box", 1e3 * gap,
                                        std::min(lower.size(), upper.size())),
                            fmt::format("allowed: up to about {:.4g} mm on this specimen",
                                        1e3 * (tested.size[normal] - 2 * size)));
  }

  const Specimen& tested;
  int normal, along;
  double gap, section, normal_stress, damping;
  RigFacts own;
  std::vector<std::int32_t> lower, upper;
};

}  // namespace

std::unique_ptr<Rig> make_shear_rig(const Specimen& specimen, const dem::MaterialCard& card,
                                    const ShearOptions& options) {
  return std::make_unique<ShearRig>(specimen, card, options);
}

TestDescription shear_description() {
  using O = ShearOptions;
  TestDescription test = rig_test<O>(make_shear_rig);
  test.kind = TestKind::shear;
  test.name = "shear";
  test.summary = "Direct shear in a shear box, under a normal stress: shear strength";
  test.options = quasi_static_options<O>("0.01", "0.6");
  test.options.insert(
      test.options.begin(),
      {axis_option<O>("the specimen's long axis", "Axis across the sheared plane"),
       quantity_option<O>(
           "normal_stress", dem::Quantity::stress, "none", "Compression on the sheared plane, held constant",
           [](auto& o) -> auto& { return o.normal_stress; }),
       quantity_option<O>(
           "gap", dem::Quantity::length, "three element sizes", "Gap between the half-boxes",
           [](auto& o) -> auto& { return o.gap; })});
  test.measured = {{"shear_strength", "Pa", "shear strength"},
                   {"largest_force", "N", "largest force"},
                   {"displacement_at_peak", "m", "displacement at the peak"},
                   {"normal_stress_at_peak", "Pa", "normal stress at the peak"},
                   {"last_shear_stress", "Pa", "shear stress at the end"},
                   {"dilation_at_end", "m", "dilation at the end"}};
  test.example_specimen = "--size \"0.1x0.1x0.1 m\" --elements 1400 --seed 1";
  test.version = 2;  // 1 began with motions of the body as a whole
  test.usual_rate = usual_rate;
  test.usual_end = 2.5;
  return test;
}

}  // namespace virtual_tests
