// The loop over elements, compiled once per instruction set: each element's stiffness times its displacements.
#include "impact/fe/element_loop.h"
#include "libdem/core/lanes.h"

namespace fe {
inline namespace SPALL_ISA {
namespace {

using Eight = double __attribute__((vector_size(64)));

SPALL_INLINE Eight load_eight(const double* from) {
  Eight eight;
  __builtin_memcpy(&eight, from, sizeof eight);
  return eight;
}

void element_loop(const ElementLoopArguments& arguments, std::size_t begin, std::size_t end) {
  for (std::size_t place = begin; place < end; ++place) {
    const auto e = static_cast<std::size_t>(arguments.elements[place]);
    const double* column = arguments.stiffness + 576 * static_cast<std::size_t>(arguments.element_class[e]);
    // Two sums, of the even and the odd columns, so that additions need not wait for each other.
    Eight even[3] = {}, odd[3] = {};
    double u[24];
    for (int a = 0; a < 8; ++a) {
      const std::size_t node =
          static_cast<std::size_t>(arguments.connectivity[8 * e + static_cast<std::size_t>(a)]);
      for (int k = 0; k < 3; ++k) u[3 * a + k] = arguments.displacement[3 * node + static_cast<std::size_t>(k)];
    }
    for (int j = 0; j < 24; j += 2, column += 48)
      for (int part = 0; part < 3; ++part) {
        even[part] += load_eight(column + 8 * part) * u[j];
        odd[part] += load_eight(column + 24 + 8 * part) * u[j + 1];
      }
    double* row = arguments.rows + 24 * place;
    for (int part = 0; part < 3; ++part) {
      const Eight total = even[part] + odd[part];
      __builtin_memcpy(row + 8 * part, &total, sizeof total);
    }
  }
}

}  // namespace
}  // namespace SPALL_ISA

ElementLoop SPALL_JOIN(SPALL_ISA, _fe_element_loop)() { return SPALL_ISA::element_loop; }

}  // namespace fe
