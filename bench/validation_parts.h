// The parts of spall_validation that have a file of their own.
#pragma once

namespace bench {

/// The coupling where nothing breaks: reflection, energy, momentum, and the paper's slab against discrete
/// elements alone.
void validate_impact();

}  // namespace bench
