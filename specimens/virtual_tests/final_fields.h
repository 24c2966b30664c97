// What a virtual test leaves in its elements and links.
#pragma once
#include <cstdint>
#include <vector>

#include "libdem/core/vector.h"
#include "libdem/probe/energy.h"
#include "libdem/run/step.h"
#include "specimens/virtual_tests/film.h"

namespace virtual_tests {

enum class LinkState : std::uint8_t { intact = 0, softening = 1, broken = 2 };

struct FinalFields {
  std::vector<double> damage;           ///< of each element: broken over initial links
  std::vector<dem::Vec3> displacement;  ///< of each element, at the end [m]
  std::vector<LinkState> link_state;    ///< of each of the specimen's links, at the end
  std::vector<double> link_strain;      ///< elongation over D_init of each link, at the end [-]
  Film film;  ///< the test in pictures, the last of them at the end; empty unless wanted
};

/// The fields of a settled assembly.
FinalFields final_fields(const dem::Assembly& assembly);

/// Elastic energy and softening of a settled assembly: functions of its state, read, not summed.
void read_pair_energies(dem::EnergyLedger& ledger, const dem::Assembly& assembly);

}  // namespace virtual_tests
