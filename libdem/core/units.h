// Units live at the border only: text such as "24 GPa" becomes an SI number here and never carries its unit
// further.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace dem {

/// What a quantity is, hence its SI unit: m, m/s, s, kg, kg/m3, N, Pa, N/m (energy per area), rad, 1, K-free.
enum class Quantity { length, velocity, time, mass, density, force, stress, fracture_energy, angle, ratio };

/// The SI unit's symbol ("Pa", "m", ...; "-" for a ratio) and an example to show in messages ("24 GPa").
std::string_view si_unit(Quantity quantity);
std::string_view example(Quantity quantity);

/// "24 GPa" -> 2.4e10. A ratio may stand without a unit ("0.2"). Uses UDUNITS-2 ("permil" and "permille" are
/// known too). Throws InputError, prefixed by `where`, if the number is missing or not finite, the unit is
/// missing, unknown or of another kind.
double parse_quantity(std::string_view text, Quantity quantity, const std::string& where);

/// "0.5x0.25x0.25 m" -> {0.5, 0.25, 0.25}; also "1.25,1.0,0.14 m". One unit at the end for all of them.
std::vector<double> parse_quantities(std::string_view text, Quantity quantity, const std::string& where);

/// The factor that turns a value in `unit` ("MPa", "permil", "%", "-") into SI: for the columns of curves.
double unit_factor(std::string_view unit, Quantity quantity, const std::string& where);

}  // namespace dem
