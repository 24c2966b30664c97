#include "specimens/virtual_tests/splitting.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "libdem/core/error.h"
#include "libdem/probe/strain_gauge.h"
#include "specimens/virtual_tests/descriptions.h"
#include "specimens/virtual_tests/rig_test.h"

namespace virtual_tests {
namespace {

using dem::Vec3;
using specimens::Specimen;

/// The three directions of a splitting test.
struct Directions {
  int load, line, side;  ///< along the load, along the strips, across both
};

Directions directions_of(const Specimen& specimen, int wanted) {
  Directions d{wanted, 2, 0};
  if (specimen.shape == specimens::Shape::cylinder) {
    if (wanted == 2)
      throw dem::InputError("axis", "a cylinder is not split along its own axis", "allowed: x, y");
    d.load = wanted < 0 ? 0 : wanted;
    d.side = 1 - d.load;
    return d;
  }
  if (wanted < 0) {
    d.load = 0;
    for (int axis = 1; axis < 3; ++axis)
      if (specimen.size[axis] < specimen.size[d.load]) d.load = axis;
  }
  const int a = d.load == 0 ? 1 : 0, b = d.load == 2 ? 1 : 2;
  d.line = specimen.size[a] >= specimen.size[b] ? a : b;
  d.side = a + b - d.line;
  return d;
}

class SplittingRig final : public Rig {
 public:
  SplittingRig(const Specimen& given, const dem::MaterialCard& card, const SplittingOptions& options)
      : tested(given),
        directions(directions_of(given, options.axis)),
        height(given.size[directions.load]),
        strip_width(options.strip_width > 0 ? options.strip_width : height / 10) {
    find_strips();
    const double length = tested.size[directions.line];
    own.name = "splitting";
    own.control = {"closing", "m"};
    own.stress_per_force = 2 / (std::numbers::pi * length * height);
    own.extra = {{"strain_side", "-"}, {"strain_load", "-"}};
    own.expected_strength = 0.9 * card.tensile_strength;
    own.least_peak = 0.2 * card.tensile_strength;
    own.length = height;
    own.rate = usual_rate;
    own.stop_at = 0.6;
    own.likely_end = 2;
    own.furthest = 20;
  }

  static constexpr double usual_rate = 0.01;

  const RigFacts& facts() const override { return own; }
  const Specimen& specimen() const override { return tested; }
  NamedValues setting() const override {
    return {{"axis", std::string(1, "xyz"[directions.load])}, {"strip_width", strip_width}};
  }

  void hold(dem::Particles& particles) const override {
    for (const std::int32_t i : low) particles.prescribe(static_cast<std::size_t>(i), directions.load, 0.5);
    for (const std::int32_t i : high) particles.prescribe(static_cast<std::size_t>(i), directions.load, -0.5);
  }

  Reading read(const dem::Particles& particles) const override {
    const Vec3 up = Vec3::Unit(directions.load);
    return {force_along(particles, high, up), -force_along(particles, low, up),
            displacement_along(particles, low, up) - displacement_along(particles, high, up)};
  }

  void sample(const dem::Particles& particles, std::span<double> extra) const override {
    const dem::AxialStrains strain = gauge->measure(particles);
    extra[0] = strain[static_cast<std::size_t>(directions.side)];
    extra[1] = strain[static_cast<std::size_t>(directions.load)];
  }

  std::vector<std::pair<std::string, double>> measure(const CurveTable& curve) const override {
    const std::size_t peak = row_of_peak(curve, "stress");
    return {{"splitting_strength", curve.at(peak, 2)},
            {"largest_force", curve.at(peak, 1)},
            {"closing_at_peak", curve.at(peak, 0)},
            {"strain_side_at_peak", curve.at(peak, 3)}};
  }

 private:
  /// The strips, and the gauge in the middle: within a tenth of the height of the axis, at least an element
  /// size.
  void find_strips() {
    const double size = tested.element_size();
    const double reach = std::max(0.1 * height, size);
    const Vec3 middle = 0.5 * tested.size;
    const double end_zone = std::min(2 * size, 0.25 * tested.size[directions.line]);
    std::vector<std::int32_t> members;
    for (std::size_t i = 0; i < tested.elements(); ++i) {
      const Vec3& x = tested.centres[i];
      const auto number = static_cast<std::int32_t>(i);
      const Vec3 from_middle = x - middle;
      Vec3 inside = x;  // depth from the loaded surface only
      inside[directions.line] = middle[directions.line];
      const double depth = tested.shape == specimens::Shape::cylinder
                               ? 0.5 * height - std::hypot(from_middle.x(), from_middle.y())
                               : 0.5 * height - std::abs(from_middle[directions.load]);
      if (std::abs(from_middle[directions.side]) <= 0.5 * strip_width && depth < size)
        (from_middle[directions.load] < 0 ? low : high).push_back(number);
      if (std::abs(from_middle[directions.side]) < reach && std::abs(from_middle[directions.load]) < reach &&
          x[directions.line] > end_zone && x[directions.line] < tested.size[directions.line] - end_zone)
        members.push_back(number);
    }
    if (strip_width > 0.5 * height)
      throw dem::InputError("strip_width", fmt::format("is {:.4g} mm wide", 1e3 * strip_width),
                            fmt::format("allowed: up to half the height, {:.4g} mm", 500 * height));
    constexpr std::size_t least = 4;
    if (std::min(low.size(), high.size()) < least)
      throw dem::InputError("strip_width",
                            fmt::format("a strip of {:.3g} mm holds only {} elements", 1e3 * strip_width,
                                        std::min(low.size(), high.size())),
                            "widen the strips, or make the specimen with more elements");
    if (members.size() < 8)
      throw dem::InputError("specimen",
                            fmt::format("has only {} elements where strain is measured", members.size()),
                            "make it with more elements");
    gauge.emplace(tested.centres, std::move(members));
  }

  const Specimen& tested;
  Directions directions;
  double height, strip_width;
  RigFacts own;
  std::vector<std::int32_t> low, high;
  std::optional<dem::StrainGauge> gauge;
};

}  // namespace

std::unique_ptr<Rig> make_splitting_rig(const Specimen& specimen, const dem::MaterialCard& card,
                                        const SplittingOptions& options) {
  return std::make_unique<SplittingRig>(specimen, card, options);
}

TestDescription splitting_description() {
  using O = SplittingOptions;
  TestDescription test = rig_test<O>(make_splitting_rig);
  test.kind = TestKind::splitting;
  test.name = "splitting";
  test.summary = "Brazilian splitting between two strips: splitting tensile strength";
  test.options = quasi_static_options<O>("0.01", "0.6");
  test.options.insert(
      test.options.begin(),
      {axis_option<O>("x of a cylinder, the shortest side of a box", "Axis along which it is pressed"),
       quantity_option<O>(
           "strip_width", dem::Quantity::length, "a tenth of the height", "Width of the two loading strips",
           [](auto& o) -> auto& { return o.strip_width; })});
  test.measured = {{"splitting_strength", "Pa", "splitting tensile strength"},
                   {"largest_force", "N", "largest force"},
                   {"closing_at_peak", "m", "closing of the strips at the peak"},
                   {"strain_side_at_peak", "-", "strain across the split, in the middle, at the peak"}};
  test.example_specimen = "--shape cylinder --size \"0.15x0.2 m\" --elements 2000 --seed 1";
  test.version = 2;  // 1 began with motions of the body as a whole
  test.usual_rate = SplittingRig::usual_rate;
  return test;
}

}  // namespace virtual_tests
