// Seeded random numbers whose bits are ours: the same seed gives the same sequence on every platform and
// library.
#pragma once
#include <array>
#include <cstdint>

namespace dem {

/// xoshiro256++ (Blackman and Vigna, 2019), seeded through splitmix64. Not for cryptography.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  /// The next 64 random bits.
  std::uint64_t next();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  /// Uniform integer in [0, bound), without modulo bias. `bound` must be positive.
  std::uint64_t below(std::uint64_t bound);
  /// Standard normal, by the polar method.
  double normal();

 private:
  std::array<std::uint64_t, 4> state;
};

}  // namespace dem
