#include "app/calibrate_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "calibrate/curve_misfit.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;

Json card_json(const dem::MaterialCard& card) {
  Json json;
  for (const dem::CardNumber& number : dem::numbers_of(card)) json[number.key] = number.value;
  json["unloading"] = dem::name_of(card.unloading);
  json["cohesion_during_softening"] = dem::name_of(card.cohesion_during_softening);
  json["broken_link_contact"] = dem::name_of(card.broken_link_contact);
  return json;
}

Json target_json(const calibrate::TargetResult& result) {
  const calibrate::Display display = calibrate::display(result.target.quantity);
  return {{"name", calibrate::name_of(result.target.quantity)},
          {"words", display.words},
          {"unit", display.unit},
          {"scale", display.scale},
          {"target", result.target.value},
          {"achieved", result.achieved},
          {"rel_error", result.relative_error()},
          {"tolerance", result.target.tolerance},
          {"met", result.met()},
          {"source", result.target.source}};
}

Json targets_json(const std::vector<calibrate::TargetResult>& results) {
  Json list = Json::array();
  for (const calibrate::TargetResult& result : results) list.push_back(target_json(result));
  return list;
}

/// The laboratory's curves against the mean over the fitted specimens of each one's difference.
void add_curve(Json& list, const char* name, const std::optional<lab::Series>& series,
               const std::vector<calibrate::SpecimenOutcome>& specimens,
               calibrate::TestSummary calibrate::SpecimenOutcome::*test) {
  if (!series) return;
  double sum = 0;
  int count = 0;
  for (const calibrate::SpecimenOutcome& specimen : specimens) {
    if (!specimen.seen || (specimen.*test).curve.empty()) continue;
    sum += calibrate::curve_difference((specimen.*test).curve, series->mean);
    ++count;
  }
  if (count > 0) list.push_back({{"name", name}, {"rmse_rel", sum / count}});
}

Json test_json(const calibrate::TestSummary& test) {
  return {{"peak_stress", test.peak_stress},
          {"peak_strain", test.peak_strain},
          {"E", test.young_modulus},
          {"nu", test.poisson_ratio},
          {"work_of_fracture", test.work_of_fracture},
          {"damage", test.damage},
          {"unbalanced_force_ratio", test.unbalanced_force_ratio},
          {"energy_balance_error", test.energy_balance_error},
          {"passed_peak", test.passed_peak},
          {"steps", test.steps}};
}

}  // namespace

Json result_of(const calibrate::CalibrationCase& wanted, const calibrate::CalibrationResult& found) {
  using calibrate::SpecimenOutcome;
  Json result;
  result["name"] = wanted.name;
  result["complete"] = found.complete();
  result["card"] = card_json(found.card);
  result["targets"] = targets_json(found.targets);
  result["curves"] = Json::array();
  add_curve(result["curves"], "tension", wanted.tension_series, found.specimens, &SpecimenOutcome::tension);
  add_curve(result["curves"], "compression", wanted.compression_series, found.specimens,
            &SpecimenOutcome::compression);
  result["virtual_tests"] = found.virtual_tests;
  result["wall_seconds"] = found.wall_seconds;
  result["specimens"] = Json::array();
  for (const SpecimenOutcome& specimen : found.specimens) {
    Json item{{"label", specimen.label},     {"seen", specimen.seen},     {"elements", specimen.elements},
              {"links", specimen.links},     {"sha256", specimen.sha256}, {"E", specimen.young_modulus},
              {"nu", specimen.poisson_ratio}};
    if (!specimen.tension.curve.empty()) item["tension"] = test_json(specimen.tension);
    if (!specimen.compression.curve.empty()) item["compression"] = test_json(specimen.compression);
    item["targets"] = targets_json(specimen.targets);
    result["specimens"].push_back(std::move(item));
  }
  result["unseen_targets"] = targets_json(found.unseen_targets);
  result["worst_unseen_error"] = found.worst_unseen_error;
  result["elastic_fit"] = {{"alpha", found.elastic.alpha},
                           {"beta", found.elastic.beta},
                           {"gamma", found.elastic.gamma},
                           {"operating_ratio", found.elastic.operating_ratio},
                           {"stiffness_rms", found.elastic.stiffness_rms},
                           {"poisson_rms", found.elastic.poisson_rms}};
  result["stages"] = Json::array();
  for (const calibrate::StageReport& stage : found.stages)
    result["stages"].push_back({{"name", stage.name},
                                {"evaluations", stage.evaluations},
                                {"worst", stage.worst},
                                {"fitted", stage.fitted}});
  result["parameters"] = Json::array();
  for (const calibrate::ParameterVerdict& verdict : found.identifiability.parameters)
    result["parameters"].push_back({{"name", verdict.name},
                                    {"relative_uncertainty", verdict.relative_uncertainty},
                                    {"determined", verdict.determined},
                                    {"at_bound", verdict.at_bound},
                                    {"remark", verdict.remark}});
  result["warnings"] = found.warnings;
  return result;
}

std::string curves_csv(const calibrate::CalibrationCase& wanted, const calibrate::CalibrationResult& found) {
  std::string text = "test,curve,kind,strain[-],stress[Pa]\n";
  const auto add = [&](const char* test, std::string curve, const char* kind, double strain, double stress) {
    std::replace(curve.begin(), curve.end(), ',', ';');
    fmt::format_to(std::back_inserter(text), "{},{},{},{:.9g},{:.9g}\n", test, curve, kind, strain, stress);
  };
  const auto add_laboratory = [&](const char* test, const std::optional<lab::Series>& series,
                                  const std::optional<lab::LabCurve>& reference) {
    if (series)
      for (std::size_t k = 0; k < series->mean.size(); ++k)
        add(test, "laboratory, mean", "laboratory", series->mean.strain[k], series->mean.stress[k]);
    if (reference)
      for (std::size_t k = 0; k < reference->size(); ++k)
        add(test, "code", "code", reference->strain[k], reference->stress[k]);
  };
  for (const calibrate::SpecimenOutcome& specimen : found.specimens) {
    const char* kind = specimen.seen ? "fitted" : "unseen";
    for (const auto& point : specimen.tension.curve)
      add("tension", specimen.label, kind, point.strain, point.stress);
    for (const auto& point : specimen.compression.curve)
      add("compression", specimen.label, kind, point.strain, point.stress);
  }
  add_laboratory("tension", wanted.tension_series, wanted.tension_reference);
  add_laboratory("compression", wanted.compression_series, wanted.compression_reference);
  return text;
}

}  // namespace app
