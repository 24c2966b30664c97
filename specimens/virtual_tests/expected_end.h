// How far a test still has to go, told from the curve so far: for progress bars only.
#pragma once
#include "specimens/virtual_tests/curve.h"

namespace virtual_tests {

/// Strain between the platens at which the test will end, as far as one can tell [-]; never less than the last
/// point's, never more than `max_strain`. `first_guess`: where it is likely to end before anything is known.
/// `peak_index`: of the highest stress so far. `stop_at`: part of the peak stress that ends the test.
///
/// While the stress rises the first guess holds, unless the curve is still too steep for it. Past the peak the
/// stress is taken to fall on at its present rate, as an exponential: tension's tails are long.
double expected_end(const Curve& curve, std::size_t peak_index, double first_guess, double stop_at,
                    double max_strain);

}  // namespace virtual_tests
