#include "libdem/core/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <mutex>

#include "libdem/core/error.h"

namespace dem {
namespace {

struct Kind {
  std::string_view unit, example, name;
};

Kind kind(Quantity quantity) {
  switch (quantity) {
    case Quantity::length:
      return {"m", "98.6 mm", "length"};
    case Quantity::velocity:
      return {"m/s", "40 m/s", "velocity"};
    case Quantity::time:
      return {"s", "20 ms", "time"};
    case Quantity::mass:
      return {"kg", "67.5 kg", "mass"};
    case Quantity::density:
      return {"kg/m3", "2400 kg/m3", "density"};
    case Quantity::force:
      return {"N", "12 kN", "force"};
    case Quantity::stress:
      return {"Pa", "24 GPa", "stress"};
    case Quantity::fracture_energy:
      return {"N/m", "146.5 N/m", "fracture energy"};
    case Quantity::angle:
      return {"rad", "6 degree", "angle"};
    case Quantity::ratio:
      return {"1", "0.2", "number without dimension"};
  }
  return {"1", "1", "number"};
}

std::string as_in(Quantity quantity) {
  const auto [unit, example, name] = kind(quantity);
  return fmt::format("write {} {} as in \"{}\"", name.starts_with('a') ? "an" : "a", name, example);
}

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

struct System {
  ut_system* system;
  std::mutex mutex;  // UDUNITS-2 keeps its status and its parser in globals
  System() {
    ut_set_error_message_handler(ut_ignore);
    system = ut_read_xml(nullptr);
    if (system == nullptr)
      throw RunError("the unit database of UDUNITS-2 cannot be read; install libudunits2-data");
    Unit thousandth(ut_scale(1e-3, ut_get_dimensionless_unit_one(system)));
    for (const char* name : {"permil", "permille", "promille"})
      ut_map_name_to_unit(name, UT_ASCII, thousandth.get());
  }
};

System& units() {
  static System instance;
  return instance;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

bool made_of_radians(const ut_unit* unit) {
  char text[256] = "";
  const int length = ut_format(unit, text, sizeof text, UT_ASCII | UT_DEFINITION);
  return length > 0 && std::string_view(text, std::min<std::size_t>(length, sizeof text)).find("rad") !=
                           std::string_view::npos;
}

/// Takes the leading number off `text`.
double take_number(std::string_view& text, std::string_view whole, Quantity quantity,
                   const std::string& where) {
  text = trim(text);
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || !std::isfinite(value))
    throw InputError(where, fmt::format("\"{}\" does not start with a finite number", whole), as_in(quantity));
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// The unit may carry a number beyond what a double holds.
double finite(double value, std::string_view text, Quantity quantity, const std::string& where) {
  if (!std::isfinite(value))
    throw InputError(where, fmt::format("\"{}\" is too large a number", text), as_in(quantity));
  return value;
}

/// UDUNITS-2 takes "4 MPa" for a unit of its own, and a value before it would be four times what is meant.
void refuse_numbers_in_a_unit(std::string_view unit, Quantity quantity, const std::string& where) {
  const auto is_digit = [](char letter) { return letter >= '0' && letter <= '9'; };
  const auto refuse = [&](const std::string& wrong) { throw InputError(where, wrong, as_in(quantity)); };
  for (const char letter : unit)
    if (static_cast<unsigned char>(letter) < 32 || letter == 127) refuse("a control character stands in it");
  if (unit.size() > 1 && unit[0] == ',' && is_digit(unit[1]))
    refuse("a comma stands in the number, not a point");
  for (std::size_t k = 0; k < unit.size(); ++k) {
    const bool number = is_digit(unit[k]) || (unit[k] == '.' && k + 1 < unit.size() && is_digit(unit[k + 1]));
    // An exponent stands behind its unit, as in m3, m^3 or s-2; "1/s" is a unit too.
    const bool begins =
        k == 0 || std::string_view(" ,.*/").find(unit[k - 1]) != std::string_view::npos ||
        unit.substr(0, k).ends_with("\u00B7") ||
        ((unit[k - 1] == 'x' || unit[k - 1] == '-' || unit[k - 1] == '+') && (k == 1 || unit[k - 2] == ' '));
    if (number && begins && unit.substr(k, 2) != "1/")
      refuse(fmt::format("\"{}\" follows the number: one number and its unit are due", unit));
  }
}

}  // namespace

std::string_view si_unit(Quantity quantity) { return quantity == Quantity::ratio ? "-" : kind(quantity).unit; }
std::string_view example(Quantity quantity) { return kind(quantity).example; }

double unit_factor(std::string_view unit, Quantity quantity, const std::string& where) {
  unit = trim(unit);
  const Kind wanted = kind(quantity);
  if (quantity == Quantity::ratio && (unit.empty() || unit == "-" || unit == "1")) return 1;
  refuse_numbers_in_a_unit(unit, quantity, where);
  if (unit.empty()) throw InputError(where, "the unit is missing", as_in(quantity));
  System& known = units();
  const std::scoped_lock lock(known.mutex);
  const Unit from(ut_parse(known.system, std::string(unit).c_str(), UT_UTF8));
  const Unit to(ut_parse(known.system, std::string(wanted.unit).c_str(), UT_UTF8));
  if (!from) throw InputError(where, fmt::format("\"{}\" is no unit that is known", unit), as_in(quantity));
  // An angle is a pure number to UDUNITS-2; "6 rad" for a ratio, or "6 %" for an angle, is a mistake all the
  // same.
  const bool pure = quantity == Quantity::ratio || quantity == Quantity::angle;
  if (!ut_are_convertible(from.get(), to.get()) ||
      (pure && made_of_radians(from.get()) != (quantity == Quantity::angle)))
    throw InputError(where, fmt::format("\"{}\" is not a unit of {}", unit, wanted.name), as_in(quantity));
  const std::unique_ptr<cv_converter, void (*)(cv_converter*)> convert(ut_get_converter(from.get(), to.get()),
                                                                       cv_free);
  return cv_convert_double(convert.get(), 1.0) - cv_convert_double(convert.get(), 0.0);
}

double parse_quantity(std::string_view text, Quantity quantity, const std::string& where) {
  std::string_view rest = text;
  const double value = take_number(rest, text, quantity, where);
  return finite(value * unit_factor(rest, quantity, where), text, quantity, where);
}

std::vector<double> parse_quantities(std::string_view text, Quantity quantity, const std::string& where) {
  std::vector<double> values;
  std::string_view rest = text;
  for (;;) {
    values.push_back(take_number(rest, text, quantity, where));
    rest = trim(rest);
    if (rest.empty() || (rest.front() != 'x' && rest.front() != ',')) break;
    rest.remove_prefix(1);
  }
  const double factor = unit_factor(rest, quantity, where);
  for (double& value : values) value = finite(value * factor, text, quantity, where);
  return values;
}

}  // namespace dem
