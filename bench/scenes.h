// What is measured: specimens of the sizes of docs/performance.md, the step loop on them, and an impact.
#pragma once
#include <cstddef>
#include <span>

#include "libdem/run/step.h"
#include "specimens/specimen.h"

namespace bench {

/// A specimen by its number of elements: 2,700 are samples 1 to 10, 120,808 the paper's slab.
struct Size {
  std::size_t elements;
  dem::Vec3 sides;  ///< [m]
};
inline const Size small{2700, {0.5, 0.25, 0.25}};
inline const Size medium{18672, {0.6, 0.6, 0.6}};
inline const Size large{120808, {2.5, 2.0, 0.28}};
inline const Size million{1'000'000, {2.25, 2.25, 2.25}};

/// A packed and linked specimen, and what making it took. Made once a run.
struct Made {
  specimens::Specimen specimen;
  double seconds = 0;     ///< two threads
  double peak_bytes = 0;  ///< of the whole process while it was made
};
const Made& specimen_of(const Size& size);

/// An assembly under way.
struct Run {
  dem::Assembly assembly;
  dem::StepRoom room;
  dem::StepOptions options;

  Run(dem::Assembly made, dem::StepOptions how) : assembly(std::move(made)), room(assembly), options(how) {}
  void steps(long count) {
    for (long s = 0; s < count; ++s) dem::advance(assembly, room, options);
  }
  /// Brings the links' histories up to date in `assembly`.
  void settle() { dem::settle(assembly, room); }
};

/// The specimen between two platens that close slowly, from rest: law, damping, ledger, detection, all on.
dem::Assembly pressed(const specimens::Specimen& specimen);
dem::StepOptions pressing(int threads);

/// The specimen held at its sides while a clump of elements of one face is driven in.
inline constexpr double impact_speed = 50;  ///< [m/s]
Run impact_on(const specimens::Specimen& specimen);

/// Peak memory of this process [bytes] since the last reset, and its memory now.
void reset_peak_memory();
double peak_memory();
double resident_memory();

}  // namespace bench
