// What there is to know about a specimen before testing it: `spall specimen inspect`.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "specimens/specimen.h"

namespace specimens {

/// Lengths in m, volumes in m3. "Internal" elements are deeper than two element sizes.
struct Inspection {
  std::string shape;
  Vec3 size = Vec3::Zero();
  std::string origin;
  std::uint64_t seed = 0;
  std::size_t elements = 0;
  std::size_t internal_elements = 0;
  std::size_t links = 0;
  double mean_interior_coordination = 0;
  double interaction_radius_factor = 0;
  double volume = 0;
  double solid_fraction = 0;     ///< volume of the elements over `volume`
  double density_variation = 0;  ///< standard deviation of the solid fraction of the inner slices along the
                                 ///< longest axis, each two element sizes thick, over its mean
  double element_size = 0;       ///< (volume / elements)^(1/3)
  double elements_across = 0;    ///< smallest side over element_size
  double radius_min = 0;
  double radius_max = 0;
  double radius_mean = 0;
  double largest_overlap = 0;                  ///< of linked elements, share of Ra + Rb; 0 if none overlaps
  std::array<double, 3> fabric_eigenvalues{};  ///< ascending, sum 1
  double fabric_tolerance = 0;                 ///< of |eigenvalue - 1/3|
  double fabric_fourth_moment = 0;             ///< mean of nx^4 + ny^4 + nz^4, 0.6 when isotropic
  bool isotropic = false;
  std::array<std::vector<double>, 3> orientation_histogram;  ///< planes xy, yz, zx: see isotropy.h
  bool representative = false;
  std::string not_representative_because;  ///< empty if it is
  std::string sha256;
};

Inspection inspect(const Specimen& specimen);
/// The keys are the names of the members.
nlohmann::json to_json(const Inspection& inspection);

}  // namespace specimens
