// Whether a specimen's links can be made anew from its elements and one number.
#pragma once
#include "specimens/specimen.h"

namespace exchange {

/// The number f for which exactly the specimen's links join centres within f (Ra + Rb): half-way between the
/// longest link and the nearest pair that is not linked, so that rounding in another code cannot matter. Throws
/// InputError if there is none: links were cut, or it was linked by another rule.
double interaction_factor(const specimens::Specimen& specimen);

}  // namespace exchange
