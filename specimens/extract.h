// Cuts a specimen out of a larger one, e.g. a representative cube out of a slab (section 4 of the paper, Fig.
// 15).
#pragma once
#include "specimens/specimen.h"

namespace specimens {

/// The elements whose centres lie in the region of that shape, size [m] and centre [m] of `larger`, moved to
/// the region's own origin, in their order; not linked. Throws InputError if the region does not lie inside
/// `larger`, or holds no element.
Specimen cut_out(const Specimen& larger, Shape shape, const Vec3& centre, const Vec3& size);

/// The same as a specimen for tests. The interaction factor is tuned anew to 12 links: the rest lengths are
/// those of `larger`, and so are the links but for the few that the two factors judge differently. Throws
/// InputError as `cut_out`, and if what the region holds is not representative.
Specimen extract(const Specimen& larger, Shape shape, const Vec3& centre, const Vec3& size);

}  // namespace specimens
