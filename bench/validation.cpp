// The figures of docs/validation.md that take many specimens: `./dev validate`, or one part of it,
// spall_validation elastic|strength|packing|sizes|fracture|impact|slab|slab-cards|slab-long.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "bench/validation_parts.h"
#include "calibrate/elastic_stage.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/uniaxial.h"

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double mean(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}
double spread(const std::vector<double>& v) {
  const auto [low, high] = std::minmax_element(v.begin(), v.end());
  return (*high - *low) / mean(v);
}

specimens::PackingOptions sample(std::uint64_t seed) {
  specimens::PackingOptions options;
  options.size = {0.5, 0.25, 0.25};
  options.elements = 2700;
  options.seed = seed;
  return options;
}

std::vector<specimens::Specimen> samples_1_to_10() {
  std::vector<specimens::Specimen> list;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) list.push_back(specimens::make_specimen(sample(seed)));
  return list;
}

struct Errors {
  double mean_E = 0, max_E = 0, mean_nu = 0, max_nu = 0;
};

/// E and nu of each specimen under Eq. 1 with these constants, against the E and nu that went in.
Errors recovered(const std::vector<specimens::Specimen>& list, const std::vector<dem::Vec3>& constants) {
  Errors e;
  dem::MaterialCard card;
  for (std::size_t s = 0; s < list.size(); ++s) {
    const dem::Vec3& abc = constants[constants.size() == 1 ? 0 : s];
    card.alpha = abc[0], card.beta = abc[1], card.gamma = abc[2];
    const auto result = virtual_tests::run_elastic(list[s], card);
    const double E = std::abs(result.young_modulus / card.young_modulus - 1),
                 nu = std::abs(result.poisson_ratio / card.poisson_ratio - 1);
    e.mean_E += E / static_cast<double>(list.size()), e.mean_nu += nu / static_cast<double>(list.size());
    e.max_E = std::max(e.max_E, E), e.max_nu = std::max(e.max_nu, nu);
  }
  return e;
}

void elastic() {
  fmt::print("== elastic: samples 1-10 (0.5 x 0.25 x 0.25 m, 2,700 elements), nu = 0.2\n");
  const auto list = samples_1_to_10();
  const auto start = Clock::now();
  const calibrate::ElasticFit fit = calibrate::fit_elastic(list, 0.2, 2);
  fmt::print("identification over nine Ks/Kn and the operating point: {:.2f} s a specimen\n",
             seconds_since(start) / 10);
  fmt::print(
      "one set for all: alpha {:.3f} +- {:.3f}, beta {:.3f}, gamma {:.3f}; rms over all Ks/Kn: E {:.1f}%, nu "
      "{:.4f}\n",
      fit.alpha, std::sqrt(fit.covariance(0, 0)), fit.beta, fit.gamma, 100 * fit.stiffness_rms,
      fit.poisson_rms);
  double low = 1e9, high = 0;
  for (const dem::Vec3& abc : fit.by_specimen) low = std::min(low, abc[0]), high = std::max(high, abc[0]);
  fmt::print("alpha of each specimen alone: {:.3f} to {:.3f}\n", low, high);
  const auto show = [](const char* name, const Errors& e) {
    fmt::print("{:<34} E: mean error {:.1f}%, largest {:.1f}%; nu: mean {:.1f}%, largest {:.1f}%\n", name,
               100 * e.mean_E, 100 * e.max_E, 100 * e.mean_nu, 100 * e.max_nu);
  };
  show("one set for all ten", recovered(list, {{fit.alpha, fit.beta, fit.gamma}}));
  show("each specimen its own set", recovered(list, fit.by_specimen));
  show("the paper's set (Eq. 3)", recovered(list, {{3.7, 2.198, 3.79}}));
  show("Hentz's set (Eq. 4)", recovered(list, {{2.5, 2.0, 2.65}}));
}

void strength() {
  fmt::print(
      "== strength: samples 1-10, T 3.1 MPa, zeta 5, Co 3.6 MPa, phi 6 degrees, E 30 GPa, nu 0.2, free ends\n");
  const auto list = samples_1_to_10();
  std::vector<double> ft(10), fc(10), unbalanced(20), energy(20);
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t k = 0; k < 20; ++k) {
    virtual_tests::UniaxialOptions options;
    options.loading = k < 10 ? virtual_tests::Loading::compression : virtual_tests::Loading::tension;
    const auto result = virtual_tests::run_uniaxial(list[k % 10], dem::MaterialCard{}, options);
    (k < 10 ? fc : ft)[k % 10] = result.peak_stress / 1e6;
    unbalanced[k] = result.unbalanced_force_ratio;
    energy[k] = result.energy_balance_error;
  }
  for (const auto& [name, v] : {std::pair("sigma_t", &ft), std::pair("sigma_c", &fc)}) {
    fmt::print("{} [MPa]:", name);
    for (const double x : *v) fmt::print(" {:.2f}", x);
    fmt::print("\n  mean {:.2f} MPa, (max - min)/mean {:.1f}%\n", mean(*v), 100 * spread(*v));
  }
  fmt::print("largest unbalanced force ratio {:.1f}%, largest energy balance error {:.2f}%\n",
             100 * *std::max_element(unbalanced.begin(), unbalanced.end()),
             100 * *std::max_element(energy.begin(), energy.end()));
}

void packing() {
  fmt::print("== packing and linking, two cores\n");
  for (const auto& [elements, size] : {std::pair(std::size_t{2700}, dem::Vec3(0.5, 0.25, 0.25)),
                                       std::pair(std::size_t{18672}, dem::Vec3(0.6, 0.6, 0.6)),
                                       std::pair(std::size_t{120808}, dem::Vec3(2.5, 2.0, 0.28))}) {
    specimens::PackingOptions options;
    options.size = size, options.elements = elements, options.threads = 2;
    const auto start = Clock::now();
    const auto specimen = specimens::make_specimen(options);
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    fmt::print("{:>7} elements, {:>7} links: {:.2f} s, process peak {:.0f} MB\n", elements,
               specimen.links.size(), seconds_since(start), static_cast<double>(usage.ru_maxrss) / 1024);
  }
}

}  // namespace

int main(int count, char** arguments) {
  const std::string wanted = count > 1 ? arguments[1] : "all";
  bool known = false;
  const auto run = [&](const char* name, void (*part)()) {
    const bool piece = wanted == "impact" && std::string_view(name).starts_with("impact-");
    if (wanted != "all" && wanted != name && !piece) return;
    known = true;
    part();
    std::fflush(stdout);
  };
  run("elastic", elastic);
  run("strength", strength);
  run("packing", packing);
  run("sizes", bench::validate_sizes);
  run("fracture", bench::validate_fracture);
  run("impact-waves", bench::validate_impact_waves);
  run("impact-energy", bench::validate_impact_energy);
  run("impact-slab", bench::validate_impact_slab);
  run("impact-ties", bench::validate_impact_ties);
  run("slab", bench::validate_slab);
  run("slab-cards", bench::validate_slab_cards);
  run("slab-long", bench::validate_slab_long);
  if (!known) fmt::print(stderr, "spall_validation: there is no part \"{}\"\n", wanted);
  return known ? 0 : 2;
}
