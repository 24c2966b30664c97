// What libFuzzer does with the seeds of binary files whose inner addresses do not survive an insertion: numbers
// are changed in their places, most of the time.
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

// SplitMix64: enough to choose places.
struct Choice {
  std::uint64_t state;
  std::uint64_t below(std::uint64_t count) {
    std::uint64_t z = (state += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return (z ^ (z >> 31)) % count;
  }
};

using Real = std::numeric_limits<double>;
constexpr std::array reals{0.0,
                           -0.0,
                           1.0,
                           -1.0,
                           2.0,
                           1e-300,
                           1e300,
                           -1e300,
                           Real::max(),
                           Real::lowest(),
                           Real::infinity(),
                           -Real::infinity(),
                           Real::quiet_NaN(),
                           4294967296.0,
                           9.3e18,
                           0.5};
constexpr std::array<std::int64_t, 12> integers{
    0, 1, -1, 2, 3, 8, 255, 0x7FFFFFFF, 0x80000000, 1 << 16, 0x7FFFFFFFFFFFFFFF, -8};

template <class Number>
void put(std::uint8_t* at, Number number, std::size_t bytes) {
  std::memcpy(at, &number, bytes);
}

void change_one_number(std::uint8_t* data, std::size_t size, Choice& choice) {
  const std::size_t bytes = std::size_t{1} << choice.below(4);
  const std::size_t at = bytes * choice.below(size / bytes);
  switch (choice.below(5)) {
    case 0:
      data[at + choice.below(bytes)] ^= static_cast<std::uint8_t>(1U << choice.below(8));
      break;
    case 1:
      if (at + sizeof(double) <= size) put(data + at, reals[choice.below(reals.size())], sizeof(double));
      break;
    case 2:
      put(data + at, integers[choice.below(integers.size())], bytes);
      break;
    case 3: {  // a little more or less
      std::uint64_t number = 0;
      std::memcpy(&number, data + at, bytes);
      put(data + at, number + choice.below(17) - 8, bytes);
      break;
    }
    default:  // what stands elsewhere
      std::memmove(data + at, data + bytes * choice.below(size / bytes), bytes);
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned int seed) {
  Choice choice{seed};
  constexpr std::size_t smallest = 16;
  if (size < smallest || choice.below(16) == 0) return LLVMFuzzerMutate(data, size, most);
  for (std::uint64_t changes = 1 + choice.below(4); changes > 0; --changes)
    change_one_number(data, size, choice);
  return size;
}
