#include "calibrate/minimax_fit.h"

#include <nlopt.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "libdem/core/error.h"

namespace calibrate {
namespace {

double worst_of(const std::vector<Residual>& residuals) {
  double worst = 0;
  for (const Residual& r : residuals) worst = std::max(worst, std::abs(r.relative()));
  return worst;
}

/// The linear model about the best point, and the box in which it is trusted.
struct Model {
  std::vector<Residual> at_best;
  Sensitivity slope;
  std::vector<double> low, high;  ///< of the step, in logarithms

  Residual after(std::size_t k, const double* step) const {
    Residual r = at_best[k];
    for (std::size_t p = 0; p < low.size(); ++p) r.misfit += slope[k][p] * step[p];
    return r;
  }
};

/// A touch of the step's square picks the shortest of many equally good steps.
double objective(unsigned n, const double* x, double*, void*) {
  double square = 0;
  for (unsigned p = 0; p + 1 < n; ++p) square += x[p] * x[p];
  return x[n - 1] + 0.05 * square;
}

void constraints(unsigned m, double* result, unsigned n, const double* x, double*, void* data) {
  const auto& model = *static_cast<const Model*>(data);
  for (unsigned k = 0; k < m / 2; ++k) {
    const double residual = model.after(k, x).relative();
    result[2 * k] = residual - x[n - 1];
    result[2 * k + 1] = -residual - x[n - 1];
  }
}

std::vector<double> best_step(const Model& model) {
  const auto parameters = static_cast<unsigned>(model.low.size());
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(
      nlopt_create(NLOPT_LN_COBYLA, parameters + 1), nlopt_destroy);
  std::vector<double> low = model.low, high = model.high, x(parameters, 0), first;
  for (unsigned p = 0; p < parameters; ++p) first.push_back(std::max(1e-6, 0.5 * std::max(high[p], -low[p])));
  const double start = worst_of(model.at_best);
  low.push_back(0), high.push_back(HUGE_VAL), x.push_back(start), first.push_back(std::max(0.1, 0.5 * start));
  nlopt_set_min_objective(optimiser.get(), objective, nullptr);
  nlopt_set_lower_bounds(optimiser.get(), low.data());
  nlopt_set_upper_bounds(optimiser.get(), high.data());
  nlopt_set_initial_step(optimiser.get(), first.data());
  const std::vector<double> tolerance(2 * model.at_best.size(), 1e-8);
  nlopt_add_inequality_mconstraint(optimiser.get(), static_cast<unsigned>(tolerance.size()), constraints,
                                   const_cast<Model*>(&model),
                                   tolerance.data());  // NLopt's data is void*; it is only read
  nlopt_set_xtol_rel(optimiser.get(), 1e-6);
  nlopt_set_maxeval(optimiser.get(), 20000);
  double least = 0;
  const nlopt_result outcome = nlopt_optimize(optimiser.get(), x.data(), &least);
  if (outcome < 0 && outcome != NLOPT_ROUNDOFF_LIMITED)
    throw dem::RunError("the fit of the strength parameters failed inside NLopt");
  x.pop_back();
  return x;
}

}  // namespace

double Residual::relative() const {
  return std::copysign(std::max(0.0, std::abs(misfit) - ignored), misfit) / tolerance;
}

MinimaxResult fit_minimax(const std::vector<FitParameter>& parameters, const Residuals& residuals,
                          const Sensitivity& expected, const MinimaxOptions& options) {
  MinimaxResult best;
  const std::size_t count = parameters.size();
  std::vector<double> place;  // logarithms
  for (const FitParameter& p : parameters) place.push_back(std::log(std::clamp(p.value, p.low, p.high)));
  const auto values_at = [&](const std::vector<double>& x) {
    std::vector<double> values;
    for (std::size_t p = 0; p < count; ++p)
      values.push_back(std::clamp(std::exp(x[p]), parameters[p].low, parameters[p].high));
    return values;
  };
  const auto evaluate = [&](const std::vector<double>& x) {
    ++best.evaluations;
    return residuals(values_at(x));
  };

  Model model;
  model.at_best = evaluate(place);
  best.values = values_at(place);
  best.worst = worst_of(model.at_best);
  model.slope = expected;
  const bool measure =
      std::any_of(expected.begin(), expected.end(), [](const auto& row) { return row.empty(); });
  for (auto& row : model.slope) row.resize(count, 0);
  for (std::size_t p = 0; measure && best.worst > options.good_enough && p < count; ++p) {
    std::vector<double> moved = place;
    const double step = 0.15;
    moved[p] += std::exp(place[p] + step) <= parameters[p].high ? step : -step;
    const std::vector<Residual> found = evaluate(moved);
    for (std::size_t k = 0; k < found.size(); ++k)
      model.slope[k][p] = (found[k].misfit - model.at_best[k].misfit) / (moved[p] - place[p]);
  }

  double radius = options.first_radius;
  int stalled = 0;  // evaluations in a row that brought nothing worth their time
  while (best.worst > options.good_enough && stalled < (best.worst <= 1 ? 2 : 4) &&
         best.evaluations < options.max_evaluations && radius > options.last_radius) {
    model.low.assign(count, -radius), model.high.assign(count, radius);
    for (std::size_t p = 0; p < count; ++p) {
      model.low[p] = std::max(model.low[p], std::log(parameters[p].low) - place[p]);
      model.high[p] = std::min(model.high[p], std::log(parameters[p].high) - place[p]);
      model.low[p] = std::min(model.low[p], 0.0), model.high[p] = std::max(model.high[p], 0.0);
    }
    const std::vector<double> step = best_step(model);
    double length = 0, square = 0;
    for (const double s : step) length = std::max(length, std::abs(s)), square += s * s;
    if (length < 1e-3) break;  // the model sees nothing better
    std::vector<double> next = place;
    for (std::size_t p = 0; p < count; ++p) next[p] += step[p];
    const std::vector<Residual> found = evaluate(next);
    for (std::size_t k = 0; k < found.size();
         ++k) {  // Broyden: the smallest change of slope that explains what was seen
      const double surprise = found[k].misfit - model.after(k, step.data()).misfit;
      for (std::size_t p = 0; p < count; ++p) model.slope[k][p] += surprise * step[p] / square;
    }
    stalled = worst_of(found) < 0.9 * best.worst ? 0 : stalled + 1;
    if (worst_of(found) < best.worst) {
      place = next;
      model.at_best = found;
      best.values = values_at(place), best.worst = worst_of(found);
      radius = std::min(options.first_radius, std::max(radius, 1.5 * length));
    } else {
      radius = 0.5 * std::min(radius, length);
    }
  }
  return best;
}

}  // namespace calibrate
