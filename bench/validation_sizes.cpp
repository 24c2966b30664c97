#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "bench/validation_parts.h"
#include "libdem/law/cohesive_link.h"
#include "libdem/statics/link_network.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace bench {
namespace {

using virtual_tests::Loading;

/// One row of the paper's Table 1, or a shape that its table lacks.
struct Sample {
  std::string_view name;
  dem::Vec3 size;  ///< [m]
  std::size_t elements;
  std::uint64_t seeds;   ///< packings 1 to this many
  std::uint64_t listed;  ///< how many of them are samples of Table 1
};

// About 86,400 elements per m3, but for sample 16. Two are not in the table: they separate length from section.
// The largest come first: what is left at the end is short.
const std::array<Sample, 9> samples{{{"15", {0.6, 0.6, 0.6}, 18672, 2, 1},
                                     {"more across", {0.5, 0.5, 0.5}, 10800, 2, 0},
                                     {"14", {0.4, 0.4, 0.4}, 5530, 3, 1},
                                     {"11", {0.5, 0.4, 0.25}, 4320, 3, 1},
                                     {"longer", {0.75, 0.25, 0.25}, 4050, 3, 0},
                                     {"12", {0.25, 0.25, 0.5}, 2700, 3, 1},
                                     {"1-10", {0.5, 0.25, 0.25}, 2700, 10, 10},
                                     {"16", {0.6, 0.6, 0.6}, 1427, 8, 1},
                                     {"13", {0.25, 0.25, 0.25}, 1350, 8, 1}}};

std::size_t sample_named(std::string_view name) {
  return static_cast<std::size_t>(
      std::find_if(samples.begin(), samples.end(), [&](const Sample& s) { return s.name == name; }) -
      samples.begin());
}

enum Quantity { sigma_t, sigma_c, young, poisson, quantities };
constexpr std::array<const char*, quantities> names{"sigma_t", "sigma_c", "E", "nu"};

struct Measured {
  std::size_t sample = 0;
  std::uint64_t seed = 0;
  std::array<double, 3> across{};  ///< elements along the loaded axis, then across the two other sides
  std::array<double, quantities> value{};
  double unbalanced = 0;  ///< the larger of the two tests'
};

specimens::Specimen pack(const Sample& sample, std::uint64_t seed) {
  specimens::PackingOptions options;
  options.size = sample.size, options.elements = sample.elements, options.seed = seed, options.threads = 1;
  return specimens::make_specimen(options);
}

virtual_tests::UniaxialResult load(const specimens::Specimen& specimen, Loading loading, double slower = 1,
                                   dem::EndCondition ends = dem::EndCondition::free) {
  virtual_tests::UniaxialOptions options;
  options.loading = loading, options.ends = ends;
  options.stop_at = loading == Loading::tension ? 0.7 : 0.9;  // past the peak
  options.rate = (loading == Loading::tension ? 0.03 : 0.01) / slower;
  return virtual_tests::run_uniaxial(specimen, dem::MaterialCard{}, options);
}

Measured measure(std::size_t sample, std::uint64_t seed) {
  const specimens::Specimen specimen = pack(samples[sample], seed);
  const int axis = specimen.long_axis();
  Measured m{sample, seed, {}, {}, 0};
  for (int k = 0; k < 3; ++k)
    m.across[static_cast<std::size_t>(k)] = specimen.size[(axis + k) % 3] / specimen.element_size();
  const auto elastic = virtual_tests::run_elastic(specimen, dem::MaterialCard{});
  m.value[young] = elastic.young_modulus / 1e9, m.value[poisson] = elastic.poisson_ratio;
  for (const Loading loading : {Loading::tension, Loading::compression}) {
    const auto result = load(specimen, loading);
    m.value[loading == Loading::tension ? sigma_t : sigma_c] = result.peak_stress / 1e6;
    m.unbalanced = std::max(m.unbalanced, result.unbalanced_force_ratio);
  }
  return m;
}

struct Mean {
  double value = 0, deviation = 0, error = 0;  ///< mean, standard deviation, standard error
};

Mean mean_of(const std::vector<double>& v) {
  Mean m;
  const auto n = static_cast<double>(v.size());
  m.value = std::accumulate(v.begin(), v.end(), 0.0) / n;
  for (const double x : v) m.deviation += (x - m.value) * (x - m.value) / std::max(n - 1, 1.0);
  m.deviation = std::sqrt(m.deviation), m.error = m.deviation / std::sqrt(n);
  return m;
}

/// Part of the nominal section that is left if each side loses a skin of so many element sizes.
double net_section(const Measured& m, double skin) {
  return (1 - 2 * skin / m.across[1]) * (1 - 2 * skin / m.across[2]);
}

struct Skin {
  double depth = 0, error = 0;  ///< element sizes, standard error
  double inside = 0;            ///< the quantity without skin
  double rest = 0;              ///< standard deviation of what the fit leaves, relative
};

/// Least squares of ln value = ln inside + ln net_section over all specimens.
Skin fit_skin(const std::vector<Measured>& all, Quantity q) {
  Skin best;
  const auto n = static_cast<double>(all.size());
  const auto residuals = [&](double skin) {
    std::vector<double> left;
    for (const Measured& m : all) left.push_back(std::log(m.value[q] / net_section(m, skin)));
    return mean_of(left);
  };
  best.rest = std::numeric_limits<double>::infinity();
  for (int k = -400; k <= 1000; ++k) {
    const Mean left = residuals(1e-3 * k);
    if (left.deviation < best.rest) best = {1e-3 * k, 0, std::exp(left.value), left.deviation};
  }
  best.rest *= std::sqrt((n - 1) / (n - 2));
  std::vector<double> slope;  // d ln net_section / d skin
  for (const Measured& m : all)
    slope.push_back(std::log(net_section(m, best.depth + 5e-4) / net_section(m, best.depth - 5e-4)) / 1e-3);
  best.error = best.rest / (mean_of(slope).deviation * std::sqrt(n - 1));
  return best;
}

/// Stress over depth below the nearest side face, in the middle half of the length.
struct DepthProfile {
  double core = 0;  ///< deeper than three element sizes, over the mean of the nominal section
  double skin = 0;  ///< that a section of the core's stress could do without [element sizes]
};

/// `moment` of each link: its axial force times its axial extent [N m], i.e. stress times volume.
DepthProfile profile(const specimens::Specimen& specimen, const std::vector<double>& moment) {
  const int axis = specimen.long_axis(), second = (axis + 1) % 3, third = (axis + 2) % 3;
  const double length = specimen.size[axis], d = specimen.element_size();
  const double width = specimen.size[second], height = specimen.size[third];
  double all = 0, core = 0;
  for (std::size_t k = 0; k < specimen.links.size(); ++k) {
    const dem::Vec3 &a = specimen.centres[static_cast<std::size_t>(specimen.links[k].a)],
                    &b = specimen.centres[static_cast<std::size_t>(specimen.links[k].b)];
    constexpr int parts = 8;
    for (int part = 0; part < parts; ++part) {
      const dem::Vec3 x = a + (b - a) * ((part + 0.5) / parts);
      if (x[axis] < 0.25 * length || x[axis] > 0.75 * length) continue;
      all += moment[k] / parts;
      if (std::min({x[second], width - x[second], x[third], height - x[third]}) > 3 * d)
        core += moment[k] / parts;
    }
  }
  core /= (width - 6 * d) * (height - 6 * d), all /= width * height;
  // all = core (1 - 2 skin d / width) (1 - 2 skin d / height)
  const double sum = width + height;
  const double skin = (sum - std::sqrt(sum * sum - 4 * width * height * (1 - all / core))) / (4 * d);
  return {core / all, skin};
}

/// If every link were strained as the whole: what the links' places alone make of a face.
DepthProfile profile_at_uniform_strain(const specimens::Specimen& specimen) {
  const double shear_ratio = dem::make_link_law(dem::MaterialCard{}).shear_ratio;
  const int axis = specimen.long_axis();
  std::vector<double> moment;
  for (const specimens::Link& link : specimen.links) {
    const auto a = static_cast<std::size_t>(link.a), b = static_cast<std::size_t>(link.b);
    const double r = std::min(specimen.radii[a], specimen.radii[b]);
    const double along = std::pow((specimen.centres[b] - specimen.centres[a])[axis] / link.initial_distance, 2);
    moment.push_back(r * r * link.initial_distance * (along * along + shear_ratio * along * (1 - along)));
  }
  return profile(specimen, moment);
}

/// The same in equilibrium, from the elastic test's solution.
DepthProfile profile_in_equilibrium(const specimens::Specimen& specimen) {
  const dem::LinkLaw law = dem::make_link_law(dem::MaterialCard{});
  std::vector<double> u;
  virtual_tests::run_elastic(specimen, law.normal_modulus, law.shear_ratio, {}, &u);
  const int axis = specimen.long_axis();
  const dem::LinkNetwork network(specimen.centres, specimen.radii, specimen.links, law.normal_modulus,
                                 law.shear_ratio);
  std::vector<double> moment;
  for (const dem::LinkSpring& s : network.springs) {
    const Eigen::Map<const Eigen::Matrix<double, 6, 1>> ua(u.data() + 6 * s.a), ub(u.data() + 6 * s.b);
    const dem::Vec3 turn = s.arm_a * ua.tail<3>() + s.arm_b * ub.tail<3>();
    const dem::Vec3 slip = ub.head<3>() - ua.head<3>() - turn.cross(s.normal);
    const dem::Vec3 force =
        s.shear_stiffness * slip + (s.normal_stiffness - s.shear_stiffness) * slip.dot(s.normal) * s.normal;
    moment.push_back(force[axis] * (s.arm_a + s.arm_b) * s.normal[axis]);
  }
  return profile(specimen, moment);
}

std::vector<double> values(const std::vector<Measured>& all, std::size_t sample, Quantity q) {
  std::vector<double> found;
  for (const Measured& m : all)
    if (m.sample == sample) found.push_back(m.value[q]);
  return found;
}

/// (max - min)/mean over the sixteen samples of Table 1.
double spread_of_table(const std::vector<Measured>& all, Quantity q, double skin) {
  double low = std::numeric_limits<double>::infinity(), high = 0, sum = 0, count = 0;
  for (const Measured& m : all) {
    if (m.seed > samples[m.sample].listed) continue;
    const double value = m.value[q] / net_section(m, skin);
    low = std::min(low, value), high = std::max(high, value), sum += value, ++count;
  }
  return (high - low) / (sum / count);
}

void print_table(const std::vector<Measured>& all) {
  fmt::print("{:<12} {:>16} {:>8} {:>14} {:>5} {:>18} {:>18} {:>18} {:>16}\n", "sample", "size [m]", "elements",
             "across", "packs", "sigma_t [MPa]", "sigma_c [MPa]", "E [GPa]", "nu");
  for (std::size_t s = 0; s < samples.size(); ++s) {
    const auto first =
        std::find_if(all.begin(), all.end(), [&](const Measured& m) { return m.sample == s; })->across;
    fmt::print("{:<12} {:>16} {:>8} {:>14} {:>5}", samples[s].name,
               fmt::format("{:g}x{:g}x{:g}", samples[s].size.x(), samples[s].size.y(), samples[s].size.z()),
               samples[s].elements, fmt::format("{:.0f}, {:.0f} x {:.0f}", first[0], first[1], first[2]),
               samples[s].seeds);
    for (const Quantity q : {sigma_t, sigma_c, young, poisson}) {
      const Mean m = mean_of(values(all, s, q));
      const int digits = q == poisson ? 4 : 2;
      fmt::print(" {:>{}}", fmt::format("{:.{}f} +- {:.{}f}", m.value, digits, m.error, digits),
                 q == poisson ? 16 : 18);
    }
    fmt::print("\n");
  }
}

void print_controls() {
  const auto change = [](double value, double usual) {
    return fmt::format("{:+.1f}%", 100 * (value / usual - 1));
  };
  for (const std::size_t s : {sample_named("13"), sample_named("14")}) {
    const specimens::Specimen specimen = pack(samples[s], 1);
    std::array<virtual_tests::UniaxialResult, 6> result;
#pragma omp parallel for schedule(dynamic, 1)
    for (std::size_t k = 0; k < 6; ++k) {
      const Loading loading = k % 2 == 0 ? Loading::compression : Loading::tension;
      result[k] = load(specimen, loading, k / 2 == 1 ? 2 : 1,
                       k / 2 == 2 ? dem::EndCondition::fixed : dem::EndCondition::free);
    }
    fmt::print(
        "sample {:<5} seed 1: half the speed sigma_t {}, sigma_c {}; fixed ends sigma_t {}, sigma_c {}\n",
        samples[s].name, change(result[3].peak_stress, result[1].peak_stress),
        change(result[2].peak_stress, result[0].peak_stress),
        change(result[5].peak_stress, result[1].peak_stress),
        change(result[4].peak_stress, result[0].peak_stress));
  }
  const specimens::Specimen small = pack(samples[sample_named("13")], 1);
  specimens::Specimen large = small;
  constexpr double times = 2.4;
  large.size *= times;
  for (dem::Vec3& x : large.centres) x *= times;
  for (double& r : large.radii) r *= times;
  for (specimens::Link& link : large.links) link.initial_distance *= times;
  for (const Loading loading : {Loading::tension, Loading::compression})
    fmt::print("sample 13, every length times {}: peak stress of {} times {:.6f}\n", times, name_of(loading),
               load(large, loading).peak_stress / load(small, loading).peak_stress);
}

}  // namespace

void validate_sizes() {
  fmt::print("== sizes: T 3.1 MPa, zeta 5, Co 3.6 MPa, phi 6 degrees, E 30 GPa, nu 0.2, free ends\n");
  std::vector<Measured> all;
  for (std::size_t s = 0; s < samples.size(); ++s)
    for (std::uint64_t seed = 1; seed <= samples[s].seeds; ++seed) all.push_back({s, seed, {}, {}, 0});
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = measure(all[k].sample, all[k].seed);
  print_table(all);
  std::fflush(stdout);

  double unbalanced = 0;
  for (const Measured& m : all) unbalanced = std::max(unbalanced, m.unbalanced);
  fmt::print("largest unbalanced force ratio {:.1f}%\n", 100 * unbalanced);
  for (const Quantity q : {sigma_t, sigma_c, young}) {
    const Skin skin = fit_skin(all, q);
    fmt::print(
        "{:<8} skin {:.2f} +- {:.2f} element sizes, {:.2f} without it, {:.1f}% left unexplained; the 16 "
        "samples: "
        "(max - min)/mean {:.1f}%, without the skin {:.1f}%\n",
        names[q], skin.depth, skin.error, skin.inside, 100 * skin.rest, 100 * spread_of_table(all, q, 0),
        100 * spread_of_table(all, q, skin.depth));
  }
  for (const std::size_t s : {sample_named("13"), sample_named("1-10"), sample_named("15")}) {
    std::vector<double> placed, carried, core;
    for (std::uint64_t seed = 1; seed <= samples[s].seeds; ++seed) {
      const specimens::Specimen specimen = pack(samples[s], seed);
      const DepthProfile elastic = profile_in_equilibrium(specimen);
      placed.push_back(profile_at_uniform_strain(specimen).skin);
      carried.push_back(elastic.skin), core.push_back(elastic.core);
    }
    fmt::print(
        "sample {:<5} axial stress over depth: skin {:.2f} +- {:.2f} at uniform strain, {:.2f} +- {:.2f} in "
        "elastic equilibrium; core at {:.3f} times the mean\n",
        samples[s].name, mean_of(placed).value, mean_of(placed).error, mean_of(carried).value,
        mean_of(carried).error, mean_of(core).value);
  }
  print_controls();
}

}  // namespace bench
