#include "app/calibrate_output.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>

#include "calibrate/curve_misfit.h"
#include "libdem/core/error.h"

namespace app {
namespace {

using Json = nlohmann::ordered_json;
using calibrate::SpecimenOutcome;
using TestOf = calibrate::TestSummary SpecimenOutcome::*;

Json card_json(const dem::MaterialCard& card) {
  Json json;
  for (const dem::CardNumber& number : dem::numbers_of(card)) json[number.key] = number.value;
  for (const auto& [key, value] : dem::choices_of(card)) json[key] = value;
  return json;
}

Json target_json(const calibrate::TargetResult& result) {
  const calibrate::Display display = calibrate::display(result.target);
  return {{"name", calibrate::name_of(result.target)},
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

/// The fitted specimens' curves averaged as the laboratory's are: a mean of peaks, not a smeared peak. Empty if
/// there is none, or if one of them is too short to be averaged so.
virtual_tests::Curve mean_curve(const std::vector<SpecimenOutcome>& specimens, TestOf test,
                                lab::Loading loading) {
  std::vector<lab::LabCurve> curves;
  for (const SpecimenOutcome& specimen : specimens) {
    if (!specimen.seen || (specimen.*test).curve.empty()) continue;
    lab::LabCurve curve;
    curve.file = specimen.label;
    curve.loading = loading;
    curve.strain = {0};
    curve.stress = {0};
    for (const virtual_tests::CurvePoint& point : (specimen.*test).curve) {
      if (point.strain <= curve.strain.back()) continue;
      curve.strain.push_back(point.strain);
      curve.stress.push_back(point.stress);
    }
    curves.push_back(std::move(curve));
  }
  virtual_tests::Curve mean;
  if (curves.empty()) return mean;
  try {
    const lab::Series series = lab::average(curves);
    for (std::size_t k = 0; k < series.mean.size(); ++k) {
      virtual_tests::CurvePoint point;
      point.strain = series.mean.strain[k];
      point.stress = series.mean.stress[k];
      mean.push_back(point);
    }
  } catch (const dem::InputError&) {
    mean.clear();
  }
  return mean;
}

/// The laboratory's mean curve against the mean virtual one, whether or not the fit aimed at it.
void add_curve(Json& list, const char* name, const std::optional<lab::Series>& series,
               const std::vector<SpecimenOutcome>& specimens, TestOf test) {
  if (!series) return;
  const virtual_tests::Curve mean = mean_curve(specimens, test, series->mean.loading);
  if (!mean.empty())
    list.push_back({{"name", name},
                    {"rmse_rel", calibrate::curve_difference(mean, series->mean)},
                    {"specimens", series->curves.size()}});
}

Json measured_json(const lab::Measured& measured) {
  return {{"mean", measured.mean}, {"std", measured.std}, {"min", measured.min}, {"max", measured.max}};
}

/// What was done to each curve before it was used, a line a file.
Json preparation_json(const lab::Series& series) {
  Json list = Json::array();
  for (const lab::LabCurve& curve : series.curves)
    if (!curve.notes.empty())
      list.push_back(fmt::format("{}: {}", std::filesystem::path(curve.file).filename().string(),
                                 fmt::join(curve.notes, "; ")));
  return list;
}

void add_laboratory(Json& laboratory, const char* test, const std::optional<lab::Series>& series,
                    const std::optional<lab::LabCurve>& reference) {
  if (series)
    laboratory[test] = {{"specimens", series->curves.size()},
                        {"E", measured_json(series->E)},
                        {"peak_stress", measured_json(series->strength)},
                        {"peak_strain", measured_json(series->strain_at_peak)},
                        {"preparation", preparation_json(*series)},
                        {"notes", series->notes}};
  else if (reference)
    laboratory[test] = {{"specimens", 0}, {"code", reference->file}};
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

Json specimens_json(const std::vector<SpecimenOutcome>& specimens) {
  Json list = Json::array();
  for (const SpecimenOutcome& specimen : specimens) {
    Json item{{"label", specimen.label},     {"seen", specimen.seen},     {"elements", specimen.elements},
              {"links", specimen.links},     {"sha256", specimen.sha256}, {"E", specimen.young_modulus},
              {"nu", specimen.poisson_ratio}};
    if (!specimen.tension.curve.empty()) item["tension"] = test_json(specimen.tension);
    if (!specimen.compression.curve.empty()) item["compression"] = test_json(specimen.compression);
    item["targets"] = targets_json(specimen.targets);
    list.push_back(std::move(item));
  }
  return list;
}

Json elastic_json(const calibrate::ElasticFit& fit) {
  Json json{
      {"alpha", fit.alpha},
      {"beta", fit.beta},
      {"gamma", fit.gamma},
      {"standard_error",
       {std::sqrt(fit.covariance(0, 0)), std::sqrt(fit.covariance(1, 1)), std::sqrt(fit.covariance(2, 2))}},
      {"operating_ratio", fit.operating_ratio},
      {"stiffness_rms", fit.stiffness_rms},
      {"poisson_rms", fit.poisson_rms}};
  json["points"] = Json::array();
  for (const calibrate::ElasticPoint& point : fit.points)
    json["points"].push_back(
        {{"shear_ratio", point.shear_ratio}, {"stiffness", point.stiffness}, {"nu", point.poisson_ratio}});
  return json;
}

Json history_json(const std::vector<calibrate::StageStep>& history) {
  Json list = Json::array();
  for (const calibrate::StageStep& step : history)
    list.push_back({{"stage", step.stage},
                    {"evaluation", step.evaluation},
                    {"worst", step.worst},
                    {"T", step.card.tensile_strength},
                    {"zeta", step.card.softening},
                    {"Co", step.card.cohesion},
                    {"slip_softening", step.card.slip_softening}});
  return list;
}

Json parameters_json(const calibrate::Identifiability& found) {
  Json list = Json::array();
  for (const calibrate::ParameterVerdict& verdict : found.parameters)
    list.push_back({{"name", verdict.name},
                    {"relative_uncertainty", verdict.relative_uncertainty},
                    {"determined", verdict.determined},
                    {"at_bound", verdict.at_bound},
                    {"remark", verdict.remark}});
  return list;
}

Json sensitivity_json(const calibrate::Identifiability& found) {
  Json list = Json::array();
  for (std::size_t q = 0; q < found.quantities.size() && q < found.sensitivity.size(); ++q) {
    Json row{{"name", calibrate::name_of(found.quantities[q])},
             {"words", calibrate::display(found.quantities[q]).words},
             {"curve", calibrate::is_curve(found.quantities[q].quantity)}};
    for (std::size_t p = 0; p < found.parameters.size(); ++p)
      row["by"][found.parameters[p].name] = found.sensitivity[q][p];
    list.push_back(std::move(row));
  }
  return list;
}

Json specimen_json(const calibrate::CalibrationCase& wanted) {
  Json json{{"shape", specimens::name_of(wanted.packing.shape)},
            {"size", {wanted.packing.size.x(), wanted.packing.size.y(), wanted.packing.size.z()}}};
  if (!wanted.structure.empty()) json["cut_from"] = wanted.structure.string();
  return json;
}

}  // namespace

Json result_of(const calibrate::CalibrationCase& wanted, const calibrate::CalibrationResult& found) {
  Json result;
  result["name"] = wanted.name;
  result["concrete"] = wanted.concrete;
  result["complete"] = found.complete();
  result["card"] = card_json(found.card);
  result["targets"] = targets_json(found.targets);
  result["curves"] = Json::array();
  add_curve(result["curves"], "tension", wanted.tension_series, found.specimens, &SpecimenOutcome::tension);
  add_curve(result["curves"], "compression", wanted.compression_series, found.specimens,
            &SpecimenOutcome::compression);
  result["virtual_tests"] = found.virtual_tests;
  result["wall_seconds"] = found.wall_seconds;
  result["specimen"] = specimen_json(wanted);
  result["specimens"] = specimens_json(found.specimens);
  result["unseen_targets"] = targets_json(found.unseen_targets);
  result["worst_unseen_error"] = found.worst_unseen_error;
  result["check_tolerance"] = wanted.check_tolerance;
  result["laboratory"] = Json::object();
  add_laboratory(result["laboratory"], "tension", wanted.tension_series, wanted.tension_reference);
  add_laboratory(result["laboratory"], "compression", wanted.compression_series, wanted.compression_reference);
  result["ends"] = {{"tension", dem::name_of(wanted.tension.ends)},
                    {"compression", dem::name_of(wanted.compression.ends)}};
  result["elastic_fit"] = elastic_json(found.elastic);
  result["stages"] = Json::array();
  for (const calibrate::StageReport& stage : found.stages)
    result["stages"].push_back({{"name", stage.name},
                                {"evaluations", stage.evaluations},
                                {"worst", stage.worst},
                                {"fitted", stage.fitted}});
  result["history"] = history_json(found.history);
  result["parameters"] = parameters_json(found.identifiability);
  result["sensitivity"] = sensitivity_json(found.identifiability);
  result["warnings"] = found.warnings;
  result["notes"] = wanted.notes;
  return result;
}

std::string curves_csv(const calibrate::CalibrationCase& wanted, const calibrate::CalibrationResult& found) {
  std::string text = "test,curve,kind,strain[-],stress[Pa]\n";
  const auto add = [&](const char* test, std::string curve, const char* kind, double strain, double stress) {
    // No cell needs quotes: a name's comma or line end would only trouble a reader.
    std::replace_if(
        curve.begin(), curve.end(), [](char c) { return c == ',' || c == '\n' || c == '"'; }, ';');
    fmt::format_to(std::back_inserter(text), "{},{},{},{:.9g},{:.9g}\n", test, curve, kind, strain, stress);
  };
  const auto add_all = [&](const char* test, const std::string& curve, const char* kind,
                           const std::vector<double>& strain, const std::vector<double>& stress) {
    for (std::size_t k = 0; k < std::min(strain.size(), stress.size()); ++k)
      add(test, curve, kind, strain[k], stress[k]);
  };
  const auto add_measured = [&](const char* test, const std::optional<lab::Series>& series,
                                const std::optional<lab::LabCurve>& reference) {
    if (series) {
      add_all(test, "laboratory: lowest", "band low", series->mean.strain, series->low);
      add_all(test, "laboratory: highest", "band high", series->mean.strain, series->high);
      add_all(test, "laboratory: mean", "laboratory", series->mean.strain, series->mean.stress);
    }
    if (reference) add_all(test, "code: " + reference->file, "code", reference->strain, reference->stress);
  };
  for (const auto& [test, name] : {std::pair(&SpecimenOutcome::tension, "tension"),
                                   std::pair(&SpecimenOutcome::compression, "compression")}) {
    for (const SpecimenOutcome& specimen : found.specimens)
      for (const virtual_tests::CurvePoint& point : (specimen.*test).curve)
        add(name, specimen.label, specimen.seen ? "fitted" : "unseen", point.strain, point.stress);
  }
  add_measured("tension", wanted.tension_series, wanted.tension_reference);
  add_measured("compression", wanted.compression_series, wanted.compression_reference);
  return text;
}

}  // namespace app
