// What one step has to move and to compute at the least, counted on paper: the floor under the step's time.
// Whoever changes a column or the law revises these, and the explanation in docs/performance.md.
#pragma once
#include <cstddef>

namespace bench::counts {

// A link, every step. Read: its partner's number (4), 1/D_init (8), the largest strain (8), the shear force
// (24). Written back: the shear force (24); the largest strain only where it softens. S_int and the stiffnesses
// follow from the radii.
inline constexpr double link_bytes = 44 + 24;

// An element, every step. Read and written once each, whatever the number of its links: ten kinematic numbers
// (80 + 80), the accumulated rotation (24 + 24). Read: masses and what is prescribed (33). The
// resultant is written only where a degree of freedom is prescribed.
inline constexpr double element_bytes = 160 + 48 + 33;

// Additions, multiplications, comparisons, divisions and roots, each as one, of a link that neither softens nor
// slides: kinematics of the pair 80 (pair_kinematics.h), law 67 (cohesive_link.h), sums on both elements 18.
inline constexpr double link_operations = 80 + 67 + 18;
// Positions and rotations 12, damping and velocities 48, kinetic energy 24.
inline constexpr double element_operations = 12 + 48 + 24;

inline double bytes_per_link(std::size_t elements, std::size_t links) {
  return link_bytes + element_bytes * static_cast<double>(elements) / static_cast<double>(links);
}
inline double operations_per_link(std::size_t elements, std::size_t links) {
  return link_operations + element_operations * static_cast<double>(elements) / static_cast<double>(links);
}

// What a run must hold in memory for a link at the least: the bytes that a step reads or rewrites of it (44),
// and its share of the elements: kinematics (80), rotation (24), masses (33), resultant (64), place and radius
// at rest (32).
inline double resident_per_link(std::size_t elements, std::size_t links) {
  return 44 + (80 + 24 + 33 + 64 + 32) * static_cast<double>(elements) / static_cast<double>(links);
}

}  // namespace bench::counts
