#include "calibrate/minimax_fit.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <map>
#include <memory>

#include "libdem/core/error.h"

namespace calibrate {
namespace {

/// What NLopt's C callbacks share. Exceptions must not cross it: they are kept and thrown again outside.
struct Search {
  const std::vector<FitParameter>& parameters;
  const Residuals& residuals;
  const MinimaxOptions& options;
  nlopt_opt optimiser = nullptr;
  std::map<std::vector<double>, std::vector<double>> seen;
  MinimaxResult best;
  std::exception_ptr failure;

  const std::vector<double>& at(const double* x) {
    std::vector<double> values;
    for (std::size_t k = 0; k < parameters.size(); ++k)
      values.push_back(std::clamp(std::exp(x[k]), parameters[k].low, parameters[k].high));
    const auto known = seen.find(values);
    if (known != seen.end()) return known->second;
    std::vector<double> found = residuals(values);
    double worst = 0;
    for (const double r : found) worst = std::max(worst, std::abs(r));
    ++best.evaluations;
    if (best.values.empty() || worst < best.worst)
      best.values = values, best.residuals = found, best.worst = worst;
    if (worst <= options.good_enough || best.evaluations >= options.max_evaluations)
      nlopt_force_stop(optimiser);
    return seen.emplace(std::move(values), std::move(found)).first->second;
  }
};

double objective(unsigned n, const double* x, double* gradient, void*) {
  (void)gradient;  // COBYLA asks for none
  return x[n - 1];
}

void constraints(unsigned m, double* result, unsigned n, const double* x, double*, void* data) {
  auto& search = *static_cast<Search*>(data);
  std::fill(result, result + m, std::numeric_limits<double>::max());
  if (search.failure) return;
  try {
    const std::vector<double>& residual = search.at(x);
    for (std::size_t k = 0; k < residual.size(); ++k) {
      result[2 * k] = residual[k] - x[n - 1];
      result[2 * k + 1] = -residual[k] - x[n - 1];
    }
  } catch (...) {
    search.failure = std::current_exception();
    nlopt_force_stop(search.optimiser);
  }
}

}  // namespace

MinimaxResult fit_minimax(const std::vector<FitParameter>& parameters, const Residuals& residuals,
                          const MinimaxOptions& options) {
  Search search{parameters, residuals, options, nullptr, {}, {}, nullptr};
  std::vector<double> x, low, high, step;
  for (const FitParameter& p : parameters) {
    x.push_back(std::log(std::clamp(p.value, p.low, p.high)));
    low.push_back(std::log(p.low));
    high.push_back(std::log(p.high));
    step.push_back(options.first_step);
  }
  const auto n = static_cast<unsigned>(parameters.size() + 1);
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(nlopt_create(NLOPT_LN_COBYLA, n),
                                                                    nlopt_destroy);
  search.optimiser = optimiser.get();

  const std::vector<double> first = search.at(x.data());
  if (search.best.worst <= options.good_enough) return search.best;
  // t lives on the residuals' scale; its step is what a step of the parameters is likely to change.
  x.push_back(search.best.worst);
  low.push_back(0);
  high.push_back(HUGE_VAL);
  step.push_back(std::max(1.0, 0.5 * search.best.worst));
  nlopt_set_min_objective(optimiser.get(), objective, nullptr);
  nlopt_set_lower_bounds(optimiser.get(), low.data());
  nlopt_set_upper_bounds(optimiser.get(), high.data());
  nlopt_set_initial_step(optimiser.get(), step.data());
  const std::vector<double> tolerance(2 * first.size(), 1e-9);
  nlopt_add_inequality_mconstraint(optimiser.get(), static_cast<unsigned>(tolerance.size()), constraints,
                                   &search, tolerance.data());
  std::vector<double> smallest(n, options.last_step);
  smallest.back() = 0.02;
  nlopt_set_xtol_abs(optimiser.get(), smallest.data());
  nlopt_set_maxeval(optimiser.get(), 4 * options.max_evaluations);
  double least = 0;
  const nlopt_result outcome = nlopt_optimize(optimiser.get(), x.data(), &least);
  if (search.failure) std::rethrow_exception(search.failure);
  if (outcome < 0 && outcome != NLOPT_FORCED_STOP && outcome != NLOPT_ROUNDOFF_LIMITED)
    throw dem::RunError("the fit of the strength parameters failed inside NLopt");
  return search.best;
}

}  // namespace calibrate
