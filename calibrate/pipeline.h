// The whole identification, in the paper's order (Fig. 7): elastic, tension, compression, then all together.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/calibration_case.h"
#include "calibrate/elastic_stage.h"
#include "calibrate/identifiability.h"
#include "calibrate/strength_stage.h"
#include "calibrate/test_bench.h"
#include "libdem/core/progress.h"
#include "libdem/material/material_card.h"

namespace calibrate {

/// One specimen of a calibration and how the finished card does on it.
struct SpecimenOutcome {
  std::string label;  ///< "seed 3" or "cut at (1.25, 1, 0.14) m"
  std::string sha256;
  std::size_t elements = 0, links = 0;
  bool seen = true;                             ///< the fit used it
  double young_modulus = 0, poisson_ratio = 0;  ///< static solve with the finished card
  TestSummary tension, compression;             ///< empty curve: not tested
  std::vector<TargetResult> targets;
};

struct CalibrationResult {
  dem::MaterialCard card;  ///< with its provenance and quality inside
  ElasticFit elastic;
  std::vector<StageReport> stages;
  std::vector<StageStep> history;            ///< every evaluation, in order
  std::vector<TargetResult> targets;         ///< means over the fitted specimens
  std::vector<TargetResult> unseen_targets;  ///< means over the specimens that the fit never saw
  double worst_unseen_error = 0;             ///< largest |relative error| of a single unseen specimen
  std::vector<SpecimenOutcome> specimens;    ///< fitted first, then unseen
  Identifiability identifiability;
  std::vector<std::string>
      warnings;  ///< unmet targets, undetermined parameters, tests that are not quasi-static
  long virtual_tests = 0;
  double wall_seconds = 0;

  bool all_met() const;
  /// Exit code 0, or 4: a target is missed or a parameter is not determined.
  bool complete() const { return all_met() && identifiability.all_determined(); }
};

/// Runs the case. `journal` holds what an earlier, stopped run had. Throws InputError, RunError, Interrupted
/// (the journal then has everything that was complete).
CalibrationResult calibrate(const CalibrationCase& wanted, TestJournal& journal, int threads,
                            const dem::ProgressCallback& progress = {});

}  // namespace calibrate
