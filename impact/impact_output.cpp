#include "impact/impact_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "impact/missile.h"

namespace impact {
namespace {

using Json = nlohmann::ordered_json;

Json list_of(const Vec3& vector) { return Json::array({vector.x(), vector.y(), vector.z()}); }

Json energy_of(const ImpactResult& found) {
  const ImpactEnergy& e = found.energy;
  return {{"initial", e.initial},
          {"final", e.final_sum()},
          {"balance_error", found.energy_balance_error},
          {"elements", e.elements},
          {"impactor", e.impactor},
          {"nodes", e.nodes},
          {"elastic", e.elastic},
          {"finite_elastic", e.finite_elastic},
          {"contact", e.contact},
          {"softening", e.softening},
          {"sliding", e.sliding},
          {"damping", e.damping},
          {"contact_sliding", e.contact_sliding},
          {"contact_damping", e.contact_damping},
          {"ties", e.ties}};
}

Json loss_of(const Loss& loss) {
  return {{"volume", loss.volume},
          {"mass", loss.mass},
          {"depth", loss.depth},
          {"equivalent_radius", loss.equivalent_radius},
          {"elements", loss.elements}};
}

Json fragments_of(const Fragments& fragments) {
  const DetachedSum sum = sum_detached(fragments);
  return {{"count", fragments.fragments.size()},
          {"detached", sum.fragments},
          {"single_elements", sum.single_elements},
          {"detached_elements", sum.elements},
          {"detached_mass", sum.mass},
          {"largest_mass", sum.largest_mass},
          {"highest_speed", sum.highest_speed},
          {"detached_kinetic_energy", sum.kinetic_energy},
          {"detached_momentum", list_of(sum.momentum)}};
}

Json ranges_of(const std::vector<ValidityRange>& ranges) {
  Json list = Json::array();
  for (const ValidityRange& range : ranges)
    list.push_back({{"quantity", range.quantity},
                    {"value", range.value},
                    {"low", range.low},
                    {"high", range.high},
                    {"holds", range.holds()},
                    {"source", range.source}});
  return list;
}

Json formulas_of(const Scene& scene) {
  const FormulaCheck check = check_formulas(scene);
  if (!check.misfit.empty()) return {{"apply", false}, {"why_not", check.misfit}};
  const MissileCase& missile = check.missile;
  const NdrcResult& ndrc = check.ndrc;
  Json formulas = {{"apply", true},
                   {"mass", missile.mass},
                   {"velocity", missile.velocity},
                   {"diameter", missile.diameter},
                   {"compressive_strength", missile.compressive_strength},
                   {"thickness", missile.thickness},
                   {"nose_factor", missile.nose_factor}};
  formulas["ndrc"] = {{"penetration_depth", ndrc.penetration_depth},
                      {"perforation_thickness", ndrc.perforation_thickness},
                      {"perforates", ndrc.perforates(missile.thickness)},
                      {"perforation_in_range", applies(ndrc.perforation_ranges)},
                      {"perforation_ranges", ranges_of(ndrc.perforation_ranges)},
                      {"scabbing_thickness", ndrc.scabbing_thickness},
                      {"scabs", ndrc.scabs(missile.thickness)},
                      {"scabbing_in_range", applies(ndrc.scabbing_ranges)},
                      {"scabbing_ranges", ranges_of(ndrc.scabbing_ranges)}};
  if (check.cea_edf)
    formulas["cea_edf"] = {{"diameter", check.perimeter_diameter},
                           {"perforation_velocity", check.cea_edf->perforation_velocity},
                           {"perforation_thickness", check.cea_edf->perforation_thickness},
                           {"perforates", check.cea_edf->perforates(missile.velocity)},
                           {"in_range", applies(check.cea_edf->ranges)},
                           {"ranges", ranges_of(check.cea_edf->ranges)}};
  return formulas;
}

/// How deep its foremost point has been, as far as the samples tell and if it did not turn on the way [m].
double largest_nose_depth(const Scene& scene, const ImpactResult& found) {
  double largest = found.impactor.nose_depth;
  if (found.history.empty()) return largest;
  const Vec3 inward = -struck_slab(scene).outward, end = found.history.back().impactor_position;
  for (const Sample& sample : found.history)
    largest = std::max(largest, found.impactor.nose_depth + (sample.impactor_position - end).dot(inward));
  return largest;
}

Json impactor_of(const Scene& scene, const ImpactResult& found) {
  return {{"passage", name_of(found.impactor.passage)},
          {"perforated", found.impactor.perforated},
          {"clear", found.impactor.clear},
          {"nose_depth", found.impactor.nose_depth},
          {"largest_nose_depth", largest_nose_depth(scene, found)}};
}

}  // namespace

Json result_of(const Scene& scene, const ImpactResult& found, int threads) {
  Json result;
  result["title"] = scene.title;
  result["model"] = scene.model == Model::coupled ? "coupled" : "de";
  result["elements"] = found.elements;
  result["fe_nodes"] = found.nodes;
  result["links"] = found.links;
  result["contacts"] = found.contacts;
  result["steps"] = found.steps;
  result["time_step"] = found.time_step;
  result["critical_time_step"] = found.critical_time_step;
  result["simulated_time"] = found.simulated_time;
  result["max_displacement"] = Json::object();
  for (const auto& [probe, largest] : found.max_displacement) result["max_displacement"][probe] = largest;
  result["peak_force"] = found.peak_force;
  result["impulse"] = found.impulse.norm();
  result["impulse_vector"] = list_of(found.impulse);
  result["residual_velocity"] = found.residual_velocity;
  result["perforated"] = scene.impactor && found.impactor.perforated;
  if (scene.impactor) result["impactor"] = impactor_of(scene, found);
  result["broken_links"] = found.broken_links;
  result["damage_volume"] = found.damage_volume;
  result["crater"] = loss_of(found.losses.crater);
  result["scab"] = loss_of(found.losses.scab);
  result["fragments"] = fragments_of(found.fragments);
  result["energy"] = energy_of(found);
  result["momentum_error"] = found.momentum_error;
  result["formulas"] = formulas_of(scene);
  result["warnings"] = found.warnings;
  if (scene.surroundings) {
    result["multipliers"] =
        scene.surroundings->solve == coupling::MultiplierSolve::lumped ? "lumped" : "consistent";
    result["finite_elements"] = {{"young_modulus", found.finite_young_modulus},
                                 {"poisson_ratio", found.finite_poisson_ratio},
                                 {"interval", found.interval},
                                 {"overlap", scene.surroundings->overlap}};
  }
  result["threads"] = threads;
  result["step_loop_seconds"] = found.step_loop_seconds;
  result["overlap_solve_seconds"] = found.overlap_solve_seconds;
  result["wall_seconds"] = found.wall_seconds;
  result["state_sha256"] = found.state_sha256;
  return result;
}

std::string fragments_csv(const Fragments& fragments) {
  std::string text =
      "fragment[-],elements[-],mass[kg],solid_volume[m3],centre_x[m],centre_y[m],centre_z[m],velocity_x[m/s],"
      "velocity_y[m/s],velocity_z[m/s],extent_x[m],extent_y[m],extent_z[m],kinetic_energy[J]\n";
  const auto out = std::back_inserter(text);
  for (std::size_t k = 0; k < fragments.fragments.size(); ++k) {
    const Fragment& f = fragments.fragments[k];
    fmt::format_to(out, "{},{},{:.9g},{:.9g}", k, f.elements, f.mass, f.solid_volume);
    for (const Vec3* vector : {&f.centre, &f.velocity, &f.extent})
      for (const double component : *vector) fmt::format_to(out, ",{:.9g}", component);
    fmt::format_to(out, ",{:.9g}\n", f.kinetic_energy);
  }
  return text;
}

}  // namespace impact
