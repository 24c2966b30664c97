// The fit of the strength parameters: the worst target, relative to its tolerance, as good as it gets.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace calibrate {

/// A positive parameter, fitted in its logarithm.
struct FitParameter {
  std::string name;
  double value = 0, low = 0, high = 0;
};

/// How far one target is off, in logarithms (or as it stands, for a curve), and how that counts.
struct Residual {
  double misfit = 0;
  double tolerance = 0;
  double ignored = 0;  ///< up to here a misfit counts nothing
  /// The misfit that counts, over the tolerance.
  double relative() const;
};

struct MinimaxOptions {
  double first_radius = 0.5;   ///< of the trust region, in logarithms
  double last_radius = 0.004;  ///< ends when the trust region is this small
  double good_enough = 0.2;    ///< ends when every residual is below this
  int max_evaluations = 20;
};

struct MinimaxResult {
  std::vector<double> values;  ///< of the parameters
  double worst = 0;            ///< largest |residual|
  int evaluations = 0;
};

/// Residuals at given parameter values. Expensive: each call runs virtual tests.
using Residuals = std::function<std::vector<Residual>(const std::vector<double>& values)>;
/// d misfit/d ln(parameter), rows as the residuals, columns as the parameters.
using Sensitivity = std::vector<std::vector<double>>;

/// Minimises the largest |residual|. The expensive answer is modelled as linear in the logarithms, which
/// strengths nearly are: the model starts from `expected` and learns from every evaluation (Broyden's rank-one
/// update); NLopt (COBYLA) solves the model's minimax problem inside a trust region that grows and shrinks with
/// the model's success. Rows of `expected` that are empty are measured first, one evaluation a parameter.
/// Returns the best point seen.
MinimaxResult fit_minimax(const std::vector<FitParameter>& parameters, const Residuals& residuals,
                          const Sensitivity& expected, const MinimaxOptions& options = {});

}  // namespace calibrate
