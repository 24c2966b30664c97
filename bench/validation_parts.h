// The parts of spall_validation that have a file of their own.
#pragma once

namespace bench {

/// Whether strength and moduli depend on the specimen's size and shape: all shapes of the paper's Table 1, the
/// skin that a face leaves, and what else could make a trend (speed, end condition, size itself).
void validate_sizes();
void validate_fracture();

// The coupling where nothing breaks; `impact` runs all four.

/// Energy that the interface reflects, of P and S waves from either side.
void validate_impact_waves();
/// Energy drift of a bar and of a small slab over 20,000 steps.
void validate_impact_energy();
/// The paper's slab against discrete elements alone, and its momentum.
void validate_impact_slab();
/// What lumped and relaxed ties cost in energy and gain in time.
void validate_impact_ties();

/// The paper's rock on the slab (section 4), both models compared at three speeds: damage, displacements, cost.
/// Draws Figs. 16 to 18 into out/validation.
void validate_slab();

/// The same impact with Table 2's cohesion, a tenth of it, and the card that the case paper-slab fits.
void validate_slab_cards();

/// 100,000 steps of both models, the paper's Table 3. A quarter of an hour.
void validate_slab_long();

}  // namespace bench
