// The fit of the strength parameters: the worst target, relative to its tolerance, as good as it gets (NLopt's
// COBYLA).
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

struct MinimaxOptions {
  double first_step = 0.2;   ///< of the logarithms
  double last_step = 0.002;  ///< ends when the trust region is this small
  double good_enough = 0.2;  ///< ends when every residual is below this part of its tolerance
  int max_evaluations = 40;
};

struct MinimaxResult {
  std::vector<double> values;     ///< of the parameters
  std::vector<double> residuals;  ///< over tolerance
  double worst = 0;               ///< largest |residual|
  int evaluations = 0;
};

/// Residuals (over tolerance) at given parameter values. Expensive: each call runs virtual tests.
using Residuals = std::function<std::vector<double>(const std::vector<double>& values)>;

/// Minimises t subject to |residual_k| <= t. COBYLA models each residual linearly, so that near a solution it
/// works like Gauss-Newton without derivatives; in logarithms strengths are nearly linear. Returns the best
/// point seen.
MinimaxResult fit_minimax(const std::vector<FitParameter>& parameters, const Residuals& residuals,
                          const MinimaxOptions& options = {});

}  // namespace calibrate
