// "Did you mean ...?": the nearest of the names that are allowed.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dem {

/// The number of letters to insert, delete, replace or swap with a neighbour to turn `a` into `b`; a letter in
/// the wrong case costs half as much as a wrong letter.
double edit_distance(std::string_view a, std::string_view b);

/// The name nearest to `name`, or an empty text if none is near enough to be what was meant.
std::string nearest_name(std::string_view name, const std::vector<std::string>& allowed);

/// `did you mean "zeta"? allowed: E, nu, zeta`, or only the list if nothing is near.
std::string suggestion(std::string_view name, const std::vector<std::string>& allowed);

}  // namespace dem
