// The paper's section 4: the rock on the slab in both models, where it breaks: `./dev validate slab`,
// `slab-cards`, `slab-long`.
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/goal_table.h"
#include "bench/slab_figure.h"
#include "bench/validation_parts.h"
#include "calibrate/pipeline.h"
#include "impact/impact_run.h"
#include "impact/scene_file.h"
#include "libdem/core/atomic_file.h"
#include "libdem/probe/damage.h"

namespace bench {
namespace {

using impact::ImpactResult;
using impact::Scene;
using impact::Vec3;

/// Damage of the elements in cubes of 5 cm, mean by cube.
using DamageMap = std::map<std::array<int, 3>, std::pair<double, int>>;

struct SlabRun {
  ImpactResult result;
  DamageMap damage;
};

Scene scene_of(const char* name, double speed, double duration) {
  Scene scene = impact::read_scene(std::filesystem::path(SPALL_CASES) / name);
  scene.approach.speed = speed;
  scene.duration = duration;
  scene.frames = 1;
  return scene;
}

SlabRun run(const Scene& scene) {
  SlabRun done;
  done.result = impact::run_impact(scene, omp_get_max_threads(), {}, [&](const impact::Frame& frame) {
    if (frame.number == 0) return;
    const dem::Assembly& assembly = *frame.assembly;
    const dem::Particles& particles = assembly.particles;
    const std::vector<double> damage = dem::element_damage(assembly.law, assembly.links, particles.count);
    for (std::size_t i = 0; i < particles.count; ++i) {
      const Vec3 cube = particles.initial_position[i] / 0.05;
      auto& [sum, count] =
          done.damage[{static_cast<int>(std::floor(cube.x())), static_cast<int>(std::floor(cube.y())),
                       static_cast<int>(std::floor(cube.z()))}];
      sum += damage[i], ++count;
    }
  });
  std::fflush(stdout);
  return done;
}

/// Correlation of two maps over the cubes of the first; where the second has no element nothing is damaged.
double correlation(const DamageMap& a, const DamageMap& b) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (const auto& [cube, sum] : a) {
    const double x = sum.first / sum.second;
    const auto found = b.find(cube);
    const double y = found == b.end() ? 0 : found->second.first / found->second.second;
    n += 1, sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
  }
  return (sab - sa * sb / n) / std::sqrt((saa - sa * sa / n) * (sbb - sb * sb / n));
}

double broken_ratio(const ImpactResult& one, const ImpactResult& other) {
  return static_cast<double>(one.broken_links) / static_cast<double>(other.broken_links);
}

/// The zone of the case, made larger with its elements' size kept.
Scene with_zone(Scene scene, int elements_along) {
  impact::Surroundings& around = *scene.surroundings;
  fe::Grading grading;
  grading.growth = 1.25, grading.largest = 0.11;
  const Vec3 middle = 0.5 * scene.size;
  const double element = around.overlap / around.box.zone->overlap_layers;
  for (int k = 0; k < 2; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    grading.zone_elements = elements_along;
    around.zone_low[k] = middle[k] - 0.5 * elements_along * element;
    around.zone_high[k] = middle[k] + 0.5 * elements_along * element;
    around.box.planes[axis] =
        fe::graded_planes(0, scene.size[k], around.zone_low[k], around.zone_high[k], grading);
    around.box.elements[axis] = static_cast<int>(around.box.planes[axis].size()) - 1;
  }
  around.box.zone->low = around.zone_low, around.box.zone->high = around.zone_high;
  return scene;
}

/// The same damage by columns through the slab.
DamagePlan plan_of(const SlabRun& run) {
  DamagePlan plan{0.05, 50, 40, std::vector<double>(2000, -1)};
  std::vector<int> count(plan.mean.size(), 0);
  for (const auto& [cube, sum] : run.damage) {
    const auto at = static_cast<std::size_t>(std::clamp(cube[1], 0, plan.rows - 1) * plan.columns +
                                             std::clamp(cube[0], 0, plan.columns - 1));
    if (plan.mean[at] < 0) plan.mean[at] = 0;
    plan.mean[at] += sum.first, count[at] += sum.second;
  }
  for (std::size_t k = 0; k < plan.mean.size(); ++k)
    if (count[k] > 0) plan.mean[k] /= count[k];
  return plan;
}

SlabPicture picture_of(const char* name, const SlabRun& run, const Scene& scene) {
  SlabPicture picture{name, {}, plan_of(run)};
  for (const impact::Sample& sample : run.result.history) {
    picture.curves.time.push_back(sample.time);
    for (std::size_t p = 0; p < scene.probes.size(); ++p)
      if (scene.probes[p].name == "under" || scene.probes[p].name == "far")
        picture.curves.probe[scene.probes[p].name == "far"].push_back(sample.displacement[p].z());
  }
  return picture;
}

/// Writes Figs. 16 to 18 of one speed beside the printed table.
void draw(double speed, const Scene& scene, const SlabRun& full, const SlabRun& coupled) {
  const std::filesystem::path folder = "out/validation";
  std::filesystem::create_directories(folder);
  const std::filesystem::path file = folder / fmt::format("slab-{:g}.svg", speed);
  dem::write_file_atomically(
      file, slab_figure(fmt::format("Rock on slab, {:g} m/s", speed),
                        {picture_of("discrete", full, scene), picture_of("coupled", coupled, scene)}));
  fmt::print("drawn: {}\n", file.string());
}

std::string beside(const SlabRun& full, const SlabRun& other) {
  const auto of = [&](const char* probe) {
    return 100 * (other.result.max_displacement.at(probe) / full.result.max_displacement.at(probe) - 1);
  };
  return fmt::format("| {:>6} | {:>+6.1f}% | {:>+6.1f}% | {:>7} | {:>+6.1f}% | {:.3f} | {:.3f} | {} |\n",
                     other.result.elements, of("under"), of("far"), other.result.broken_links,
                     100 * (broken_ratio(other.result, full.result) - 1),
                     correlation(full.damage, other.damage), other.result.residual_velocity,
                     other.result.warnings.empty() ? "no" : "yes");
}

/// How far the rock went down from where it touched the slab [m].
double deepest_nose(const ImpactResult& found) {
  double lowest = 0;
  for (const impact::Sample& sample : found.history)
    lowest = std::min(lowest, sample.impactor_position.z() - found.history.front().impactor_position.z());
  return -lowest;
}

}  // namespace

void validate_slab() {
  fmt::print(
      "== slab: the rock on the slab of section 4 at the speed named, 10 ms; coupled against discrete elements "
      "throughout\n");
  constexpr double duration = 10e-3;
  std::vector<GoalRow> rows;
  for (const double speed : {2.0, 4.0}) {
    const SlabRun full = run(scene_of("slab-paper-de.toml", speed, duration));
    Scene other_seed = scene_of("slab-paper-de.toml", speed, duration);
    other_seed.structure.packing.seed = other_seed.seed = 2;
    const SlabRun seed = run(other_seed);
    const Scene coupled = scene_of("slab-paper-coupled.toml", speed, duration);
    const SlabRun own = run(coupled), papers = run(with_zone(coupled, 14)),
                  larger = run(with_zone(coupled, 22));
    fmt::print(
        "\n{:g} m/s; all discrete: {} links broken, largest displacement {:.3f} mm under the rock and {:.3f} "
        "mm "
        "far, residual velocity {:.3f} m/s\n\n"
        "| model | elements | under | far | broken | | damage map | residual, m/s | warns |\n"
        "|---|---|---|---|---|---|---|---|---|\n",
        speed, full.result.broken_links, 1e3 * full.result.max_displacement.at("under"),
        1e3 * full.result.max_displacement.at("far"), full.result.residual_velocity);
    fmt::print("| coupled, zone of 0.52 m, the paper's count {}", beside(full, papers));
    fmt::print("| coupled, the case's zone, 0.60 m {}", beside(full, own));
    fmt::print("| coupled, zone of 0.82 m {}", beside(full, larger));
    fmt::print("| all discrete, seed 2 {}", beside(full, seed));
    draw(speed, coupled, full, own);
    for (const auto& [name, one] : {std::pair("the case's zone", &own), std::pair("zone of 0.82 m", &larger)}) {
      const std::string label = fmt::format("{:g} m/s, {}: ", speed, name);
      for (const char* probe : {"under", "far"})
        rows.push_back(
            at_most(label + "largest displacement, " + probe, 0.05,
                    one->result.max_displacement.at(probe) / full.result.max_displacement.at(probe) - 1));
      rows.push_back(at_most(label + "broken links", 0.1, broken_ratio(one->result, full.result) - 1));
      const double alike = correlation(full.damage, one->damage);
      rows.push_back({label + "damage maps correlate", "above 0.9", fmt::format("{:.3f}", alike), alike > 0.9});
    }
  }

  fmt::print("\n== the paper's 40 m/s, the cases as they are\n");
  Scene full_scene = scene_of("slab-paper-de.toml", 40, 20e-3);
  Scene coupled_scene = scene_of("slab-paper-coupled.toml", 40, 20e-3);
  const SlabRun full = run(full_scene), coupled = run(coupled_scene);
  fmt::print("\nall discrete: {} of {} links broken; damaged by more than a half: {:.3f} m3 of 1.4 m3\n\n",
             full.result.broken_links, full.result.links, full.result.damage_volume);
  fmt::print(
      "| model | elements | under | far | broken | | damage map | residual, m/s | warns "
      "|\n|---|---|---|---|---|---|---|---|---|\n");
  fmt::print("| coupled {}", beside(full, coupled));
  draw(40, coupled_scene, full, coupled);
  for (const char* probe : {"under", "far"})
    rows.push_back(
        at_most(fmt::format("40 m/s: largest displacement, {}", probe), 0.05,
                coupled.result.max_displacement.at(probe) / full.result.max_displacement.at(probe) - 1));
  rows.push_back(at_most("40 m/s: broken links", 0.1, broken_ratio(coupled.result, full.result) - 1));
  const double alike = correlation(full.damage, coupled.damage);
  rows.push_back({"40 m/s: damage maps correlate", "above 0.9", fmt::format("{:.3f}", alike), alike > 0.9});

  const double ratio = full.result.step_loop_seconds / coupled.result.step_loop_seconds;
  const double overlap = coupled.result.overlap_solve_seconds / coupled.result.step_loop_seconds;
  rows.push_back({"cost: all discrete over coupled, 20 ms", "15",
                  fmt::format("{:.1f} ({:.1f} s over {:.1f} s)", ratio, full.result.step_loop_seconds,
                              coupled.result.step_loop_seconds),
                  ratio >= 15});
  rows.push_back({"overlap's share of the coupled steps", "15%", percent(overlap), overlap < 0.15});
  const double momentum = std::max(full.result.momentum_error, coupled.result.momentum_error);
  rows.push_back({"momentum of slab, rock and supports, the worse of both", "1e-6",
                  fmt::format("{:.1e}", momentum), momentum <= 1e-6});
  fmt::print("\n{}", to_markdown(rows));
}

void validate_slab_cards() {
  fmt::print("== slab-cards: the rock at 40 m/s on the slab of discrete elements, 5 ms, by card\n\n");
  const std::filesystem::path cases = SPALL_CASES;
  calibrate::TestJournal journal;
  const dem::MaterialCard fitted =
      calibrate::calibrate(calibrate::read_case(cases / "paper-slab.toml"), journal, omp_get_max_threads())
          .card;
  struct Choice {
    const char* name;
    dem::MaterialCard card;
  };
  const dem::MaterialCard table = impact::read_scene(cases / "slab-paper-de.toml").card;
  dem::MaterialCard tenth = table;
  tenth.cohesion = 3.6e6;
  fmt::print(
      "| card | Co, MPa | speed, m/s | links broken | peak force, MN | residual, m/s | deepest nose, mm | "
      "crater, m | scab, m | outcome |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  for (const double speed : {2.0, 40.0})
    for (const Choice& choice : {Choice{"Table 2", table}, Choice{"Table 2, Co a tenth", tenth},
                                 Choice{"paper-slab, fitted", fitted}}) {
      Scene scene = scene_of("slab-paper-de.toml", speed, 5e-3);
      scene.card = choice.card;
      scene.frames = 0;
      scene.impactor->law.modulus = dem::make_link_law(choice.card).normal_modulus;
      const ImpactResult found = impact::run_impact(scene, omp_get_max_threads());
      fmt::print("| {} | {:.2f} | {:g} | {} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | {} |\n", choice.name,
                 choice.card.cohesion / 1e6, speed, found.broken_links, found.peak_force / 1e6,
                 found.residual_velocity, 1e3 * deepest_nose(found), found.losses.crater.equivalent_radius,
                 found.losses.scab.equivalent_radius, impact::name_of(found.impactor.passage));
      std::fflush(stdout);
    }
}

void validate_slab_long() {
  fmt::print("== slab-long: 100,000 steps of each model (Table 3)\n\n");
  std::vector<GoalRow> rows;
  double seconds[2] = {};
  int model = 0;
  for (const char* name : {"slab-paper-coupled.toml", "slab-paper-de.toml"}) {
    Scene scene = scene_of(name, 40, 1);
    scene.frames = 0;
    // The time step is known once the structure is packed; two steps tell it.
    scene.duration = 1e-6;
    const double step = impact::run_impact(scene, omp_get_max_threads()).time_step;
    scene.duration = 100'000 * step;
    const ImpactResult found = impact::run_impact(scene, omp_get_max_threads());
    seconds[model] = found.wall_seconds;
    const double goal = model == 0 ? 120 : 1800;
    rows.push_back(
        {fmt::format("{}: {} elements, {} nodes, {} steps", name, found.elements, found.nodes, found.steps),
         fmt::format("{:g} s", goal),
         fmt::format("{:.0f} s, packing included; {:.0f} s in the steps; energy open by {}", found.wall_seconds,
                     found.step_loop_seconds, percent(found.energy_balance_error)),
         found.wall_seconds < goal});
    ++model;
  }
  rows.push_back(
      {"all discrete over coupled", "the paper: 11.7", fmt::format("{:.1f}", seconds[1] / seconds[0]), {}});
  fmt::print("{}", to_markdown(rows));
}

}  // namespace bench
