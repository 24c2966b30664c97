// The parts of spall_validation that have a file of their own.
#pragma once

namespace bench {

/// The coupling where nothing breaks: reflection, energy, momentum, and the paper's slab against discrete
/// elements alone.
void validate_impact();

/// The paper's rock on the slab (section 4), both models compared at three speeds: damage, displacements, cost.
/// Draws Figs. 16 to 18 into out/validation.
void validate_slab();

/// The same impact with Table 2's cohesion, a tenth of it, and the card that the case paper-slab fits.
void validate_slab_cards();

/// 100,000 steps of both models, the paper's Table 3. A quarter of an hour.
void validate_slab_long();

}  // namespace bench
