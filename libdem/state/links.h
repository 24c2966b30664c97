// Links and contacts: pairs of elements with their geometry at rest and their history, column by column.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "libdem/core/aligned.h"
#include "libdem/core/vector.h"

namespace dem {

/// A pair that is to be linked: element numbers and D_init [m].
struct LinkGeometry {
  std::int32_t a = 0, b = 0;
  double initial_distance = 0;
};

/// Columns are padded with links between ghost elements to a multiple of this, the widest lane count.
inline constexpr std::size_t link_padding = 8;
/// The largest strain ever of a pair that was never linked: it is born broken and only pushes.
inline constexpr double born_broken = 1e30;

/// What pairs remember from step to step.
struct PairHistories {
  Column<double> max_strain;  ///< the damage's memory: largest elongation so far over D_init once it passed the
                              ///< yield strain; 0 before [-]
  Column<double> shear_x, shear_y, shear_z;  ///< F_s, the force on element a [N]
  // Only where the law transfers moments; empty otherwise.
  Column<double> slip;                          ///< plastic slip of the link so far over D_init [-]
  Column<double> moment_x, moment_y, moment_z;  ///< rolling moment on element a [N m]
  Column<double> twist;                         ///< twisting moment on element a, about the normal [N m]
};

/// One column of the histories: its name in files, and its sign when the two elements are exchanged.
struct HistoryColumn {
  const char* name;
  Column<double> PairHistories::*values;
  double exchanged;
};

inline constexpr std::array<HistoryColumn, 9> all_histories{{{"max_strain", &PairHistories::max_strain, 1},
                                                             {"shear_x", &PairHistories::shear_x, -1},
                                                             {"shear_y", &PairHistories::shear_y, -1},
                                                             {"shear_z", &PairHistories::shear_z, -1},
                                                             {"slip", &PairHistories::slip, 1},
                                                             {"moment_x", &PairHistories::moment_x, -1},
                                                             {"moment_y", &PairHistories::moment_y, -1},
                                                             {"moment_z", &PairHistories::moment_z, -1},
                                                             {"twist", &PairHistories::twist, 1}}};
/// The columns that a law needs.
inline std::span<const HistoryColumn> history_columns(bool transfers_moments) {
  return std::span(all_histories).first(transfers_moments ? 9 : 4);
}

/// The columns of `count` pairs. A contact (a pair that was never linked) is a link that is born broken, with
/// Ra + Rb for its initial distance, so that one law serves both.
struct Links : PairHistories {
  std::size_t count = 0;
  Column<std::int32_t> a, b;                ///< element numbers
  Column<double> inverse_initial_distance;  ///< 1/D_init [1/m]
  Column<double> area;                      ///< S_int = pi min(Ra, Rb)^2 [m2]
  bool remembers_moments = false;           ///< whether the moments' columns are there

  /// Makes the moments' columns, at rest, if they are not there.
  void remember_moments();
  std::size_t padded() const { return a.size(); }
  /// Appends a pair at rest.
  void push(std::int32_t first, std::int32_t second, double initial_distance, double interaction_area,
            double initial_max_strain = 0);
  /// Makes room for so many pairs and the padding, so that pushing them leaves no holes in memory.
  void reserve(std::size_t pairs);
  /// Adds the padding; `ghost` is the number of the first ghost element. Call once after the last push.
  void pad(std::int32_t ghost);
  void clear();
};

/// Links at rest between spheres of the given radii.
Links make_links(std::span<const LinkGeometry> pairs, std::span<const double> radii);

/// For every element the pairs that touch it: pair number * 2 + (0 if the element is its a, 1 if its b), in the
/// order of the pairs. Forces are summed along this list: the same order on any number of threads.
struct Incidence {
  std::vector<std::int32_t> first;  ///< elements + 1 offsets into `entry`
  Column<std::int32_t> entry;

  Incidence() = default;
  Incidence(const Links& links, std::size_t elements);
};

}  // namespace dem
