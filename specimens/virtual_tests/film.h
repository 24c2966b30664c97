// A virtual test in pictures: few of them, evenly over a test whose length nobody knows beforehand.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "libdem/run/checkpoint.h"
#include "libdem/run/step.h"

namespace virtual_tests {

/// The elements at one moment. Single precision: pictures need no more.
struct Picture {
  double time = 0;                  ///< [s]
  double control = 0;               ///< what the test drives, its SI unit
  double stress = 0;                ///< the test's main stress [Pa]
  std::vector<float> displacement;  ///< of the elements [m], x y z each
  std::vector<float> damage;        ///< of the elements: broken over initial links
};

/// Offers itself for a picture ever so often; when it has twice as many as wanted it drops every second one and
/// from then on takes half as many.
class Film {
 public:
  explicit Film(int wanted_pictures = 0) : wanted(static_cast<std::size_t>(wanted_pictures)) {}

  /// Whether this call, one of many at equal intervals, is one for a picture. False if none are wanted.
  bool is_due();
  /// Takes a picture of a settled assembly, whether one is due or not.
  void take(const dem::Assembly& assembly, double time, double control, double stress);

  bool is_wanted() const { return wanted > 0; }
  const std::vector<Picture>& pictures() const { return taken; }
  /// For each link the first picture that shows it broken; -1 if none does.
  std::vector<std::int32_t> first_broken() const;

  /// What a checkpoint keeps of it; nothing if no picture is wanted.
  void keep_in(dem::NamedNumbers& numbers) const;
  /// Goes on from there. Throws InputError that names `file` if pictures are wanted and it has none (those of
  /// the test's beginning would be missing), or if the columns do not fit together.
  void restore(const dem::NamedNumbers& numbers, const std::filesystem::path& file);

 private:
  void drop_every_second();

  std::size_t wanted;
  std::int64_t calls = 0, stride = 1;
  std::vector<Picture> taken;
  std::vector<std::int64_t> taken_at;      ///< the call of each picture
  std::vector<std::int64_t> broken_since;  ///< the call of the first picture that showed each link broken; -1
};

}  // namespace virtual_tests
