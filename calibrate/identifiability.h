// Which parameters the data determine, and what would settle the others.
#pragma once
#include <string>
#include <vector>

#include "calibrate/calibration_case.h"
#include "calibrate/strength_stage.h"
#include "calibrate/test_bench.h"

namespace calibrate {

/// What the fit knows of one free parameter.
struct ParameterVerdict {
  std::string name;
  /// Relative change of the parameter that stays within one tolerance of all targets; above 1 it may double or
  /// halve.
  double relative_uncertainty = 0;
  bool determined = false;
  bool at_bound = false;
  std::string remark;  ///< empty, or why it is not determined and what data would settle it
};

struct Identifiability {
  std::vector<ParameterVerdict> parameters;
  /// d ln(achieved)/d ln(parameter), rows as `quantities`, columns as `parameters`.
  std::vector<Target> quantities;
  std::vector<std::vector<double>> sensitivity;

  bool all_determined() const;
};

/// Central differences of all targets about `card` (`step` of the logarithms), then the covariance that the
/// tolerances imply.
Identifiability assess(const CalibrationCase& wanted, TestBench& bench, const dem::MaterialCard& card,
                       double step = 0.12);

}  // namespace calibrate
