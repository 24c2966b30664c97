// The specimens of a case, and how it tests them.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "calibrate/calibration_case.h"
#include "calibrate/test_bench.h"
#include "specimens/specimen.h"

namespace calibrate {

struct SpecimenSet {
  std::vector<specimens::Specimen> specimens;
  std::vector<std::string> labels;  ///< "seed 3" or "cut at (1.25, 1, 0.14) m"
  std::vector<std::vector<specimens::Specimen>>
      laboratory;  ///< by laboratory test; empty where it uses those above
};

/// Packs a specimen for each seed, or cuts one at each of `centres` where the case names a structure [m].
/// Throws InputError for what cannot be packed or cut.
SpecimenSet make_set(const CalibrationCase& wanted, const std::vector<std::uint64_t>& seeds,
                     const std::vector<dem::Vec3>& centres, int threads);

/// How the case's uniaxial tests are run: no farther past the peak than its targets need.
TestProtocol protocol_for(const CalibrationCase& wanted);

}  // namespace calibrate
