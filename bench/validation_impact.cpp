// What the coupling does to waves, energy and momentum, and to the paper's slab, where nothing breaks:
// `./dev validate impact`, or one piece of it: impact-waves, impact-energy, impact-slab, impact-ties.
#include <fmt/format.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/goal_table.h"
#include "bench/validation_parts.h"
#include "impact/impact_run.h"
#include "impact/scene_file.h"
#include "specimens/packing.h"
#include "specimens/specimen_file.h"
#include "tests/scenes/coupling_energy.h"
#include "tests/scenes/coupling_pulse.h"
#include "tests/scenes/impact_slab.h"

namespace bench {
namespace {

using impact::ImpactResult;
using impact::Sample;
using impact::Scene;

void show(const char* title, const std::vector<GoalRow>& rows) {
  fmt::print("\n{}\n\n{}", title, to_markdown(rows));
  std::fflush(stdout);
}

void reflection() {
  using namespace coupling_scene;
  struct Case {
    const char* name;
    From from;
    int axis;
    std::array<double, pulse_goals.size()> part;
  };
  std::array<Case, 4> cases = {{{"P wave from discrete elements", From::discrete, 0, {}},
                                {"S wave from discrete elements", From::discrete, 1, {}},
                                {"P wave from finite elements", From::finite, 0, {}},
                                {"S wave from finite elements", From::finite, 1, {}}}};
  wide_bar();  // made once, before the threads ask for it
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t k = 0; k < cases.size() * pulse_goals.size(); ++k) {
    Case& one = cases[k / pulse_goals.size()];
    const std::size_t pulse = k % pulse_goals.size();
    one.part[pulse] = reflected(wide_bar(), one.from, one.axis, pulse_goals[pulse].lengths);
  }
  std::vector<GoalRow> rows;
  for (const Case& one : cases)
    for (std::size_t pulse = 0; pulse < pulse_goals.size(); ++pulse)
      rows.push_back(at_most(fmt::format("{}, {:g} finite elements long", one.name, pulse_goals[pulse].lengths),
                             pulse_goals[pulse].reflected, one.part[pulse]));
  show("Energy that the interface reflects (bar 2.0 x 0.1 x 0.1 m, finite elements of 25 mm, three layers)",
       rows);
}

constexpr int long_run = 20000;          // steps
constexpr double allowed_drift = 0.002;  // of the energy, over that many steps

double bar_drift(const coupling_scene::BarOptions& options) {
  coupling_scene::BarRun run = coupling_scene::coupled_run(coupling_scene::short_bar(), options);
  return coupling_scene::run_long(coupling_scene::short_bar(), run, long_run).drift();
}

/// Mean energy of everything over the last quarter of the history against the first, once the blow is over.
double drift_of(const ImpactResult& result) {
  const std::size_t quarter = result.history.size() / 4;
  const auto mean = [&](std::size_t from, std::size_t to) {
    double sum = 0;
    for (std::size_t k = from; k < to; ++k) sum += result.history[k].energy.final_sum();
    return sum / static_cast<double>(to - from);
  };
  const std::size_t count = result.history.size();
  return (mean(count - quarter, count) - mean(quarter, 2 * quarter)) / result.energy.initial;
}

/// The small slab of the tests, struck so that nothing breaks.
ImpactResult long_slab(int interval) {
  Scene scene = impact_scene::slab(impact::Model::coupled, impact_scene::unbreakable, 1);
  scene.surroundings->interval = interval;
  const double step = run_impact(
                          [&] {
                            Scene one = scene;
                            one.duration = 1e-9;  // one step, to learn how long it is
                            return one;
                          }(),
                          1)
                          .time_step;
  scene.duration = (long_run + 1) * step;
  return run_impact(scene, omp_get_max_threads());
}

void drift() {
  std::vector<GoalRow> rows;
  coupling_scene::BarOptions bar;
  rows.push_back(at_most("bar, every domain at every step", allowed_drift, bar_drift(bar)));
  bar.interval = 4;
  rows.push_back(at_most("bar, finite elements at every 4th step", allowed_drift, bar_drift(bar)));
  for (const int interval : {1, 0}) {
    const ImpactResult result = long_slab(interval);
    rows.push_back(at_most(
        interval == 1 ? "small slab, every domain at every step"
                      : "small slab, finite elements as seldom as is stable",
        allowed_drift, drift_of(result),
        fmt::format(", {} steps; largest imbalance {}", result.steps, percent(result.energy_balance_error))));
  }
  show("Energy drift, elastic, strict tie, 20,000 steps", rows);
}

/// A history of one probe along the impactor's way, by straight lines between its samples.
struct Deflection {
  std::vector<double> time, value;  // [s], [m]

  Deflection(const ImpactResult& result, std::size_t probe, const impact::Vec3& direction) {
    for (const Sample& sample : result.history)
      time.push_back(sample.time), value.push_back(sample.displacement[probe].dot(direction));
  }
  double at(double when) const {
    const auto after = std::lower_bound(time.begin(), time.end(), when);
    if (after == time.begin()) return value.front();
    if (after == time.end()) return value.back();
    const auto k = static_cast<std::size_t>(after - time.begin());
    const double part = (when - time[k - 1]) / (time[k] - time[k - 1]);
    return (1 - part) * value[k - 1] + part * value[k];
  }
  double largest() const {
    double most = 0;
    for (const double v : value) most = std::max(most, std::abs(v));
    return most;
  }
};

/// The paper's slab, packed once for all runs, in a file that goes when they are done.
struct PackedSlab {
  std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("spall_validation_{}.h5", getpid());

  PackedSlab() {
    specimens::PackingOptions packing = impact::read_scene(case_file("de")).structure.packing;
    packing.threads = omp_get_max_threads();
    specimens::write_specimen(file, specimens::make_specimen(packing));
  }
  ~PackedSlab() { std::filesystem::remove(file); }
  PackedSlab(const PackedSlab&) = delete;
  PackedSlab& operator=(const PackedSlab&) = delete;

  static std::filesystem::path case_file(const char* model) {
    return std::filesystem::path(SPALL_CASES) / fmt::format("slab-paper-{}.toml", model);
  }
};

/// The paper's slab with a card under which nothing breaks, struck slowly.
Scene elastic_slab(const PackedSlab& slab, const char* model, bool gentle) {
  Scene scene = impact::read_scene(PackedSlab::case_file(model));
  scene.structure.specimen = slab.file;
  scene.card.tensile_strength = scene.card.cohesion = impact_scene::unbreakable;
  scene.approach.speed = 1;
  scene.frames = 0;
  // Springs as soft as this hold the rock back for 4 ms: the slab bends, and hardly a wave goes through it.
  if (gentle) scene.impactor->law.stiffness = 0.3e6, scene.impactor->law.friction = 0;
  return scene;
}

void slab_against_discrete_elements(const PackedSlab& slab, bool gentle) {
  const Scene scene = elastic_slab(slab, "de", gentle);
  const ImpactResult full = run_impact(scene, omp_get_max_threads()),
                     coupled = run_impact(elastic_slab(slab, "coupled", gentle), omp_get_max_threads());
  std::vector<GoalRow> rows;
  for (std::size_t p = 0; p < scene.probes.size(); ++p) {
    const Deflection expected(full, p, scene.approach.direction), found(coupled, p, scene.approach.direction);
    const double largest = expected.largest();
    double squares = 0;
    for (std::size_t k = 0; k < expected.time.size(); ++k)
      squares += std::pow(found.at(expected.time[k]) - expected.value[k], 2);
    const double rms = std::sqrt(squares / static_cast<double>(expected.time.size()));
    const std::string& name = scene.probes[p].name;
    rows.push_back(at_most(fmt::format("{}: largest deflection against discrete elements alone", name), 0.02,
                           found.largest() / largest - 1,
                           fmt::format(" ({:.4g} against {:.4g} mm)", 1e3 * found.largest(), 1e3 * largest)));
    rows.push_back(
        at_most(fmt::format("{}: RMS of the difference over the largest", name), 0.03, rms / largest));
  }
  for (const auto& [name, result] :
       {std::pair("discrete elements alone", &full), std::pair("coupled", &coupled)}) {
    rows.push_back({fmt::format("momentum, {}", name), "at most 1e-6",
                    fmt::format("{:.1e}", result->momentum_error), result->momentum_error <= 1e-6});
    rows.push_back({fmt::format("largest imbalance of energy, {}", name), "",
                    percent(result->energy_balance_error), std::nullopt});
    rows.push_back({fmt::format("step loop, {}", name), "",
                    fmt::format("{:.1f} s, {} steps, {} elements", result->step_loop_seconds, result->steps,
                                result->elements),
                    std::nullopt});
  }
  show(gentle ? "The paper's slab, elastic, struck at 1 m/s over soft springs, 20 ms"
              : "The paper's slab, elastic, struck at 1 m/s, 20 ms",
       rows);
}

/// What the other ties cost in energy and gain in time, on the paper's slab.
void ties(const PackedSlab& slab) {
  struct Variant {
    std::string name;
    coupling::Ties ties = coupling::Ties::displacements;
    coupling::MultiplierSolve solve = coupling::MultiplierSolve::consistent;
    double reduction = 1;  ///< the paper's p
  };
  const std::array<Variant, 5> variants = {
      {{"strict"},
       {"strict, rotations tied too", coupling::Ties::displacements_and_rotations},
       {"lumped multipliers", coupling::Ties::displacements, coupling::MultiplierSolve::lumped},
       {"relaxed, p = 2", coupling::Ties::displacements, coupling::MultiplierSolve::consistent, 2},
       {"relaxed, p = 10", coupling::Ties::displacements, coupling::MultiplierSolve::consistent, 10}}};
  std::vector<GoalRow> rows;
  double strict_loop = 0, time_step = 0;
  std::vector<double> strict_deflection;
  for (const Variant& variant : variants) {
    Scene scene = elastic_slab(slab, "coupled", false);
    scene.surroundings->ties = variant.ties, scene.surroundings->solve = variant.solve;
    if (variant.reduction > 1) scene.surroundings->relaxation_time = variant.reduction * time_step;
    const ImpactResult result = run_impact(scene, omp_get_max_threads());
    if (strict_loop == 0) {
      strict_loop = result.step_loop_seconds, time_step = result.time_step;
      for (const auto& [name, value] : result.max_displacement) strict_deflection.push_back(value);
    }
    std::string deflections;
    std::size_t p = 0;
    for (const auto& [name, value] : result.max_displacement)
      deflections += fmt::format(", {} {:+.2f}%", name, 100 * (value / strict_deflection[p++] - 1));
    rows.push_back(
        {variant.name, "",
         fmt::format("ties take {} of the energy; loop {:.2f} of the strict one's, overlap {:.0f}% of "
                     "it; largest displacement{}",
                     percent(result.energy.ties / result.energy.initial),
                     result.step_loop_seconds / strict_loop,
                     100 * result.overlap_solve_seconds / result.step_loop_seconds, deflections.substr(1)),
         std::nullopt});
  }
  show("Other ties, on the paper's slab, elastic, struck at 1 m/s, 20 ms", rows);
}

}  // namespace

void validate_impact_waves() {
  fmt::print("== impact-waves: what the interface reflects\n");
  reflection();
}

void validate_impact_energy() {
  fmt::print("== impact-energy: what becomes of the energy in a long run\n");
  drift();
}

void validate_impact_slab() {
  fmt::print(
      "== impact-slab: the paper's slab where nothing breaks, coupled against discrete elements alone\n");
  const PackedSlab slab;
  for (const bool gentle : {true, false}) slab_against_discrete_elements(slab, gentle);
}

void validate_impact_ties() {
  fmt::print("== impact-ties: strict ties and others\n");
  ties(PackedSlab());
}

}  // namespace bench
