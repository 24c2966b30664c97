// The finished card's tests in pictures: for the report, not for the fit.
#pragma once
#include <string>
#include <vector>

#include "calibrate/calibration_case.h"
#include "libdem/core/progress.h"
#include "libdem/material/material_card.h"
#include "specimens/specimen.h"
#include "specimens/virtual_tests/outcome.h"

namespace calibrate {

struct FilmedTests {
  specimens::Specimen specimen;
  std::string label;                                ///< of the specimen: "seed 3"
  virtual_tests::TestOutcome tension, compression;  ///< with their films
};

/// Pulls and pushes the first specimen of the case with `card`, each to well past its peak, `pictures` to twice
/// as many of each. The two tests run side by side. Throws InputError, RunError, Interrupted.
FilmedTests film_tests(const CalibrationCase& wanted, const dem::MaterialCard& card, int pictures, int threads,
                       const dem::ProgressCallback& progress = {});

}  // namespace calibrate
