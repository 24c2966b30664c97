// How large the elements are: the distribution of their radii.
#pragma once
#include <cstddef>
#include <vector>

namespace specimens {

/// One sieve: the mass fraction (0 to 1) of the material that passes its opening [m].
struct Sieve {
  double diameter = 0;
  double passing = 0;
};

/// A size distribution up to a common factor: the number of elements and the solid fraction of a packing set
/// the scale, so a sieve curve gives the shape of the distribution, not the elements' absolute size.
struct Grading {
  enum class Kind {
    uniform,    ///< radii uniform between r_min and r_max = size_ratio * r_min
    equal,      ///< one size; packs may crystallise
    lognormal,  ///< log of the radius normal with deviation log_deviation, cut at twice that on each side
    sieve  ///< from a sieve curve, mass spread evenly over the logarithm of the diameter between two sieves
  };
  Kind kind = Kind::uniform;
  double size_ratio = 2;        ///< r_max / r_min (uniform), 1 to 10
  double log_deviation = 0.17;  ///< (lognormal), above 0 up to 0.5
  std::vector<Sieve> sieves;    ///< (sieve), ascending, passing from 0 to 1

  /// Throws InputError that names the bound which is violated.
  void validate() const;
  /// `count` relative radii, ascending, any scale: the quantiles at (k + 1/2) / count of the distribution by
  /// number. Each seed thus gets the same radii, and only their places differ.
  std::vector<double> radii(std::size_t count) const;
};

}  // namespace specimens
