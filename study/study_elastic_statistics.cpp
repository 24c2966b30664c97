// Elastic rows: E and nu against what the card asks for, and Eq. 1 fitted to them (Fig. 4).
#include <algorithm>
#include <cmath>

#include "calibrate/elastic_stage.h"
#include "libdem/material/micro_macro.h"
#include "study/study_statistics_parts.h"

namespace study {
namespace {

struct Errors {
  double sum = 0, largest = 0;
  std::size_t count = 0;
  void add(double error) { sum += std::abs(error), largest = std::max(largest, std::abs(error)), ++count; }
};

Json to_json(const Errors& errors) {
  return {{"mean", errors.sum / static_cast<double>(errors.count)}, {"largest", errors.largest}};
}

/// Of the elastic tests: the paper's "uncertainty" is the mean.
struct CardErrors {
  Errors E, nu;
};

bool varies(const Plan& plan, const char* key) {
  return std::any_of(plan.study.parameters.begin(), plan.study.parameters.end(),
                     [key](const Parameter& p) { return p.key == key; });
}

dem::LinkStiffness stiffness_of(const dem::MaterialCard& card) {
  return dem::link_stiffness(card.young_modulus, card.poisson_ratio, card.alpha, card.beta, card.gamma);
}

}  // namespace

Json card_errors_json(const Plan& plan, const RowTable& table) {
  // Of points that a Ks/Kn gives, those near nu = 0 have no relative error.
  Json json = Json::array();
  if (varies(plan, stiffness_ratio_key)) return json;
  std::vector<CardErrors> errors(plan.study.cards.size());
  for (const Row& row : table.rows) {
    if (row.kind != TestKind::elastic) continue;
    const Task& task = plan.tasks[row.task - 1];
    const dem::MaterialCard& card = plan.card_of(task);
    errors[task.card].E.add(row.number("E") / card.young_modulus - 1);
    if (card.poisson_ratio > 0) errors[task.card].nu.add(row.number("nu") / card.poisson_ratio - 1);
  }
  for (std::size_t c = 0; c < errors.size(); ++c) {
    if (errors[c].E.count == 0) continue;
    Json entry{{"card", plan.study.cards[c].name}, {"tests", errors[c].E.count}, {"E", to_json(errors[c].E)}};
    if (errors[c].nu.count > 0) entry["nu"] = to_json(errors[c].nu);
    json.push_back(std::move(entry));
  }
  return json;
}

Json eq1_json(const Plan& plan, const RowTable& table) {
  if (!varies(plan, stiffness_ratio_key) && !varies(plan, "nu")) return Json::object();
  std::vector<calibrate::ElasticPoint> points;
  std::vector<double> ratios;
  for (const Row& row : table.rows) {
    if (row.kind != TestKind::elastic) continue;
    const dem::LinkStiffness link = stiffness_of(plan.card_of(plan.tasks[row.task - 1]));
    points.push_back({link.shear_ratio, row.number("E") / link.normal_modulus, row.number("nu")});
    if (std::none_of(ratios.begin(), ratios.end(),
                     [&](double r) { return std::abs(r - link.shear_ratio) < 1e-9; }))
      ratios.push_back(link.shear_ratio);
  }
  if (ratios.size() < 3) return Json::object();
  const calibrate::MicroMacroFit fit = calibrate::fit_micro_macro(points);
  Json json{{"alpha", fit.alpha},
            {"beta", fit.beta},
            {"gamma", fit.gamma},
            {"alpha_std", number_or_null(std::sqrt(fit.covariance(0, 0)))},
            {"beta_std", number_or_null(std::sqrt(fit.covariance(1, 1)))},
            {"gamma_std", number_or_null(std::sqrt(fit.covariance(2, 2)))},
            {"stiffness_rms", fit.stiffness_rms},
            {"poisson_rms", fit.poisson_rms},
            {"points", Json::array()}};
  std::sort(ratios.begin(), ratios.end());
  for (const double ratio : ratios) {
    double stiffness = 0, poisson = 0, low = 0, high = 0;
    std::size_t count = 0;
    for (const calibrate::ElasticPoint& point : points) {
      if (std::abs(point.shear_ratio - ratio) >= 1e-9) continue;
      low = count > 0 ? std::min(low, point.poisson_ratio) : point.poisson_ratio;
      high = count > 0 ? std::max(high, point.poisson_ratio) : point.poisson_ratio;
      stiffness += point.stiffness, poisson += point.poisson_ratio, ++count;
    }
    json["points"].push_back({{"Ks_over_Kn", ratio},
                              {"stiffness", stiffness / static_cast<double>(count)},
                              {"nu", poisson / static_cast<double>(count)},
                              {"nu_min", low},
                              {"nu_max", high},
                              {"specimens", count}});
  }
  return json;
}

}  // namespace study
