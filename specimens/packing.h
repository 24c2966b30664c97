// Packs elements into a shape: a disordered, homogeneous, isotropic assembly without initial overlaps.
#pragma once
#include <cstddef>
#include <cstdint>

#include "libdem/core/progress.h"
#include "specimens/grading.h"
#include "specimens/specimen.h"

namespace specimens {

/// What to pack. "Dense, then shrink": overlaps are relaxed at dense_solid_fraction, then all radii shrink
/// together to solid_fraction. Relaxing at the final density instead leaves loose regions, and strengths
/// scatter four times as much.
struct PackingOptions {
  Shape shape = Shape::box;
  Vec3 size = Vec3::Zero();  ///< [m], as in Specimen
  std::size_t elements = 0;
  std::uint64_t seed = 1;
  Grading grading;
  double dense_solid_fraction =
      0.62;                      ///< volume of the elements over that of the shape while relaxing, 0.45 to 0.64
  double solid_fraction = 0.42;  ///< the same at the end, 0.1 to 0.9 * dense_solid_fraction
  int threads = 0;               ///< 0: as many as OpenMP gives; the result does not depend on it

  /// Throws InputError that names the bound which is violated.
  void validate() const;
};

/// Packs only: centres and radii, no links, no checks of the result. Elements are numbered along a Hilbert
/// curve. Throws InputError (options), RunError if the overlaps cannot be relaxed, Interrupted.
Specimen pack(const PackingOptions& options, const dem::ProgressCallback& progress = {});

/// Packs, links (mean interior coordination 12) and refuses a specimen that is not representative.
/// Throws as `pack`; InputError also for too few elements.
Specimen make_specimen(const PackingOptions& options, const dem::ProgressCallback& progress = {});

}  // namespace specimens
