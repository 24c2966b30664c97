#include "specimens/virtual_tests/bending.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "libdem/core/error.h"
#include "specimens/virtual_tests/descriptions.h"
#include "specimens/virtual_tests/rig_test.h"
#include "specimens/virtual_tests/saw_cut.h"

namespace virtual_tests {
namespace {

using dem::Vec3;
using specimens::Specimen;
using Elements = std::vector<std::int32_t>;

constexpr double usual_rate = 0.008;

/// The beam's directions and lengths, settled.
struct Beam {
  int along, up, across;
  double span, height, breadth, notch, notch_width, roller_width;

  double ligament() const { return height - notch; }
};

Beam beam_of(const Specimen& specimen, const BendingOptions& options) {
  if (specimen.shape != specimens::Shape::box)
    throw dem::InputError("specimen", "is a cylinder", "bending wants a box: make it with --shape box");
  Beam beam{};
  beam.along = options.axis < 0 ? specimen.long_axis() : options.axis;
  const int a = beam.along == 0 ? 1 : 0, b = beam.along == 2 ? 1 : 2;
  beam.up = options.depth_axis >= 0 ? options.depth_axis : specimen.size[a] > specimen.size[b] ? a : b;
  if (beam.up == beam.along)
    throw dem::InputError("depth_axis", "is the beam's own axis", "it is loaded across: give another");
  beam.across = 3 - beam.along - beam.up;
  const double length = specimen.size[beam.along], size = specimen.element_size();
  beam.height = specimen.size[beam.up];
  beam.breadth = specimen.size[beam.across];
  beam.roller_width = options.roller_width > 0 ? options.roller_width : 1.5 * size;
  beam.span = options.span > 0 ? options.span : 0.9 * length;
  beam.notch = options.notch;
  beam.notch_width = options.notch_width > 0 ? options.notch_width : size;
  if (beam.span + beam.roller_width > 1.001 * length || beam.span < 4 * beam.roller_width)
    throw dem::InputError(
        "span", fmt::format("{:.4g} mm between rollers of {:.3g} mm", 1e3 * beam.span, 1e3 * beam.roller_width),
        fmt::format("allowed on this beam: {:.4g} to {:.4g} mm", 4e3 * beam.roller_width,
                    1e3 * (length - beam.roller_width)));
  if (!(beam.notch >= 0 && beam.notch <= 0.6 * beam.height))
    throw dem::InputError("notch", fmt::format("is {:.4g} mm deep", 1e3 * beam.notch),
                          fmt::format("allowed: up to 0.6 of the height, {:.4g} mm", 600 * beam.height));
  return beam;
}

Specimen cut_beam(const Specimen& given, const Beam& beam) {
  if (beam.notch == 0) return given;
  return cut(given, {beam.along, beam.up, 0, 0.5 * given.size[beam.along], beam.notch, beam.notch_width});
}

class BendingRig final : public Rig {
 public:
  BendingRig(const Specimen& given, const dem::MaterialCard& card, const BendingOptions& options)
      : beam(beam_of(given, options)), tested(cut_beam(given, beam)) {
    find_elements(given.element_size());
    own.name = "bending";
    own.control = {"displacement", "m"};
    own.stress_per_force = 1.5 * beam.span / (beam.breadth * beam.ligament() * beam.ligament());
    own.extra = {{"deflection", "m"}, {"crack_mouth_opening", "m"}};
    own.expected_strength = 1.3 * card.tensile_strength;
    own.least_peak = 0.2 * card.tensile_strength;
    own.length = beam.span;
    own.rate = usual_rate;
    own.stop_at = 0.1;
    own.likely_end = 7;
    own.furthest = 30;
  }

  const RigFacts& facts() const override { return own; }
  const Specimen& specimen() const override { return tested; }
  bool changed_specimen() const override { return beam.notch > 0; }
  NamedValues setting() const override {
    return {{"axis", std::string(1, "xyz"[beam.along])},
            {"depth_axis", std::string(1, "xyz"[beam.up])},
            {"span", beam.span},
            {"notch", beam.notch},
            {"notch_width", beam.notch > 0 ? beam.notch_width : 0.0},
            {"roller_width", beam.roller_width}};
  }

  void hold(dem::Particles& particles) const override {
    for (const Elements* support : {&left, &right})
      for (const std::int32_t i : *support) particles.prescribe(static_cast<std::size_t>(i), beam.up, 0);
    for (const std::int32_t i : roller) particles.prescribe(static_cast<std::size_t>(i), beam.up, -1);
  }

  Reading read(const dem::Particles& particles) const override {
    const Vec3 up = Vec3::Unit(beam.up);
    return {force_along(particles, roller, up),
            -force_along(particles, left, up) - force_along(particles, right, up),
            -displacement_along(particles, roller, up)};
  }

  void sample(const dem::Particles& particles, std::span<double> extra) const override {
    const Vec3 up = Vec3::Unit(beam.up), along = Vec3::Unit(beam.along);
    extra[0] =
        0.5 * (displacement_along(particles, above_left, up) + displacement_along(particles, above_right, up)) -
        displacement_along(particles, middle, up);
    extra[1] =
        displacement_along(particles, mouth_right, along) - displacement_along(particles, mouth_left, along);
  }

  std::vector<std::pair<std::string, double>> measure(const CurveTable& curve) const override {
    const std::size_t peak = row_of_peak(curve, "stress");
    double work = 0;
    for (std::size_t row = 1; row < curve.rows(); ++row)
      work += 0.5 * (curve.at(row, 1) + curve.at(row - 1, 1)) * (curve.at(row, 3) - curve.at(row - 1, 3));
    return {{"bending_strength", curve.at(peak, 2)},
            {"largest_force", curve.at(peak, 1)},
            {"deflection_at_peak", curve.at(peak, 3)},
            {"crack_mouth_opening_at_peak", curve.at(peak, 4)},
            {"fracture_energy", work / (beam.breadth * beam.ligament())},
            {"stiffness", stiffness_of(curve, peak)}};
  }

 private:
  /// Force over deflection, least squares between a tenth and a third of the peak.
  static double stiffness_of(const CurveTable& curve, std::size_t peak) {
    const double top = curve.at(peak, 1);
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    for (std::size_t row = 0; row < peak; ++row) {
      const double force = curve.at(row, 1), way = curve.at(row, 3);
      if (force < top / 10 || force > top / 3) continue;
      n += 1, x += way, y += force, xx += way * way, xy += way * force;
    }
    const double spread = n * xx - x * x;
    return n < 3 || !(spread > 0) ? 0 : (n * xy - x * y) / spread;
  }

  void find_elements(double size) {
    const double mid = 0.5 * tested.size[beam.along];
    const double low = mid - 0.5 * beam.span, high = mid + 0.5 * beam.span;
    const double half = 0.5 * beam.roller_width;
    // Beside the cut, or a third of the height to either side where there is none.
    const double mouth = beam.notch > 0 ? 0.5 * beam.notch_width : beam.height / 3;
    for (std::size_t i = 0; i < tested.elements(); ++i) {
      const double x = tested.centres[i][beam.along], z = tested.centres[i][beam.up];
      const auto number = static_cast<std::int32_t>(i);
      const auto near = [&](double place, double reach) { return std::abs(x - place) <= reach; };
      if (z < size && near(low, half)) left.push_back(number);
      if (z < size && near(high, half)) right.push_back(number);
      if (z > beam.height - size && near(mid, half)) roller.push_back(number);
      if (std::abs(z - 0.5 * beam.height) <= size) {
        if (near(mid, size)) middle.push_back(number);
        if (near(low, size)) above_left.push_back(number);
        if (near(high, size)) above_right.push_back(number);
      }
      const double aside = std::abs(x - mid) - mouth;
      if (z < size && aside >= 0 && aside < 1.5 * size) (x < mid ? mouth_left : mouth_right).push_back(number);
    }
    for (const auto& [elements, what] :
         {std::pair(&left, "the left support"), std::pair(&right, "the right support"),
          std::pair(&roller, "the upper roller"), std::pair(&middle, "the middle at mid-span"),
          std::pair(&above_left, "the middle above the left support"),
          std::pair(&above_right, "the middle above the right support"),
          std::pair(&mouth_left, "the left of the mouth"), std::pair(&mouth_right, "the right of the mouth")})
      if (elements->size() < 3)
        throw dem::InputError("specimen", fmt::format("has only {} elements at {}", elements->size(), what),
                              "make it with more elements, or widen the rollers");
  }

  Beam beam;
  Specimen tested;
  RigFacts own;
  Elements left, right, roller, middle, above_left, above_right, mouth_left, mouth_right;
};

}  // namespace

std::unique_ptr<Rig> make_bending_rig(const Specimen& specimen, const dem::MaterialCard& card,
                                      const BendingOptions& options) {
  return std::make_unique<BendingRig>(specimen, card, options);
}

TestDescription bending_description() {
  using O = BendingOptions;
  TestDescription test = rig_test<O>(make_bending_rig);
  test.kind = TestKind::bending;
  test.name = "bending";
  test.summary = "Three-point bending, notched or not: bending strength, fracture energy";
  const auto length = [](const char* key, const char* fallback, const char* help, auto access) {
    return quantity_option<O>(key, dem::Quantity::length, fallback, help, access);
  };
  test.options = quasi_static_options<O>("0.008", "0.1");
  test.options.insert(
      test.options.begin(),
      {axis_option<O>("the specimen's long axis", "Axis of the beam"),
       choice_option<O>(
           "depth_axis", {"x", "y", "z"}, "the larger side across, the last of equals",
           "Axis along which it is loaded", [](auto& o) -> auto& { return o.depth_axis; }),
       length(
           "span", "nine tenths of the length", "Distance of the supports",
           [](auto& o) -> auto& { return o.span; }),
       length(
           "notch", "none", "Depth of a saw cut at mid-span", [](auto& o) -> auto& { return o.notch; }),
       length(
           "notch_width", "an element size", "Width of the saw cut",
           [](auto& o) -> auto& { return o.notch_width; }),
       length(
           "roller_width", "one and a half element sizes", "Width on which supports and load bear",
           [](auto& o) -> auto& { return o.roller_width; })});
  test.measured = {{"bending_strength", "Pa", "bending strength"},
                   {"largest_force", "N", "largest force"},
                   {"deflection_at_peak", "m", "deflection at the peak"},
                   {"crack_mouth_opening_at_peak", "m", "crack mouth opening at the peak"},
                   {"fracture_energy", "J/m2", "work of fracture per ligament"},
                   {"stiffness", "N/m", "force over deflection, elastic"}};
  test.example_specimen = "--size \"0.4x0.1x0.1 m\" --elements 2100 --seed 1";
  test.example_options = " --notch \"30 mm\" --rate 0.05 --stop-at 0.5";
  test.version = 2;  // 1 began with motions of the body as a whole
  test.usual_rate = usual_rate;
  test.usual_end = 7;
  return test;
}

}  // namespace virtual_tests
