// Elastic test: Young's modulus and Poisson's ratio from one static solve, no time steps.
#pragma once
#include <vector>

#include "libdem/material/material_card.h"
#include "specimens/specimen.h"

namespace virtual_tests {

struct ElasticOptions {
  int axis = -1;            ///< 0, 1, 2; negative: the specimen's long axis
  double tolerance = 1e-6;  ///< of the solver's residual
};

struct ElasticResult {
  double young_modulus = 0;  ///< E [Pa]: mean reaction over the nominal section over the gauge strain
  double poisson_ratio = 0;  ///< nu [-]
  int iterations = 0;
  double wall_seconds = 0;
};

/// Pulls the specimen between two frictionless platens. Throws InputError for a card that is not valid.
ElasticResult run_elastic(const specimens::Specimen& specimen, const dem::MaterialCard& card,
                          const ElasticOptions& options = {});

/// The same for given local stiffnesses: normal modulus C = Kn D_init / S_int [Pa] and Ks/Kn. `guess`, if not
/// null, is the displacement field to start from and receives the solution: neighbouring ratios solve faster.
ElasticResult run_elastic(const specimens::Specimen& specimen, double normal_modulus, double shear_ratio,
                          const ElasticOptions& options = {}, std::vector<double>* guess = nullptr);

}  // namespace virtual_tests
