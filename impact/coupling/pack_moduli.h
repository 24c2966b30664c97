// The elastic moduli that a pack really has. Finite elements that are coupled to it need them, not the card's:
// faces are softer than the inside, so a thin pack bends more easily than it stretches, and stretches more
// easily than its inside does.
#pragma once
#include <optional>

#include "libdem/material/material_card.h"
#include "specimens/specimen.h"

namespace coupling {

struct PackModuli {
  /// E of the inside, four element sizes and more from every face; none in a cell under ten elements thick [Pa]
  std::optional<double> bulk;
  double membrane = 0;       ///< E of the whole section, stretched in its plane [Pa]
  double flexural = 0;       ///< E of the whole section, bent out of its plane [Pa]
  double poisson_ratio = 0;  ///< of the whole section, stretched
};

/// Membrane and flexural modulus come from the energy of the cell's middle part: the soft faces of the
/// structure count, the cell's own ends and sides do not. Static solves on a cell of the pack: a box that is as
/// thick as the structure along `thickness_axis` and longer than thick along `along`. Throws InputError if the
/// cell is no box or not long enough.
PackModuli measure_moduli(const specimens::Specimen& cell, const dem::MaterialCard& card, int thickness_axis,
                          int along);

}  // namespace coupling
