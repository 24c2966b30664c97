#include "calibrate/lab/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "libdem/core/error.h"
#include "libdem/core/units.h"

namespace lab {
namespace {

using dem::InputError;

template <class Enum, std::size_t count>
Enum parse_enum(std::string_view text, const std::array<std::pair<std::string_view, Enum>, count>& known,
                const std::string& where) {
  std::string all;
  for (const auto& [name, value] : known) {
    if (name == text) return value;
    all += fmt::format("{}\"{}\"", all.empty() ? "" : ", ", name);
  }
  throw InputError(where, fmt::format("\"{}\" is not known here", text), "allowed: " + all);
}

constexpr std::array<std::pair<std::string_view, Loading>, 2> loadings{
    {{"compression", Loading::compression}, {"tension", Loading::tension}}};
constexpr std::array<std::pair<std::string_view, SignConvention>, 3> signs{
    {{"compression_positive", SignConvention::compression_positive},
     {"tension_positive", SignConvention::tension_positive},
     {"negative_is_compression", SignConvention::negative_is_compression}}};

/// +1 if the file's positive values are in the direction of loading.
double sign_factor(SignConvention sign, Loading loading) {
  const bool file_has_compression_positive = sign == SignConvention::compression_positive;
  return file_has_compression_positive == (loading == Loading::compression) ? 1 : -1;
}

/// The unit of a column: from its header, or from the case when the header has none. They must not contradict.
std::string unit_of(const CsvTable& table, std::size_t column, const std::string& given) {
  const std::string& in_header = table.columns[column].unit;
  if (in_header.empty()) return given;
  if (!given.empty() && given != in_header)
    throw InputError(fmt::format("{}: column \"{}\"", table.file, table.columns[column].name),
                     fmt::format("its header says [{}], the unit given for it is \"{}\"", in_header, given),
                     "leave the given unit out, or correct the header");
  return in_header;
}

std::string place(const CsvTable& table, std::size_t column) {
  return fmt::format("{}: column \"{}\"", table.file, table.columns[column].header);
}

bool is_length(std::string_view unit) {
  try {
    dem::unit_factor(unit, dem::Quantity::length, "");
    return true;
  } catch (const InputError&) {
    return false;
  }
}

bool is_displacement(const CsvTable& table, std::size_t column, const CurveSpec& spec) {
  const std::string unit = unit_of(table, column, spec.strain_unit);
  return !unit.empty() && is_length(unit);
}

/// The factor of a strain column, which may be a displacement if a gauge length is known.
double strain_column_factor(const CsvTable& table, std::size_t column, const CurveSpec& spec,
                            double gauge_length) {
  const std::string unit = unit_of(table, column, spec.strain_unit);
  if (is_displacement(table, column, spec)) {
    if (!(gauge_length > 0))
      throw InputError(place(table, column), fmt::format("\"{}\" is a length, not a strain", unit),
                       "give the gauge length over which it was measured, as in gauge_length = \"100 mm\"");
    return dem::unit_factor(unit, dem::Quantity::length, place(table, column)) / gauge_length;
  }
  return strain_factor(unit, place(table, column));
}

std::vector<std::size_t> selected_rows(const CsvTable& table, const std::optional<RowFilter>& filter) {
  std::vector<std::size_t> rows;
  const std::size_t column = filter ? find_column(table, filter->column) : 0;
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (!filter || number_at(table, row, column) == filter->value) rows.push_back(row);
  if (rows.empty())
    throw InputError(place(table, column), fmt::format("no row has {} = {}", filter->column, filter->value),
                     "choose a value that occurs in the column");
  return rows;
}

/// The selected cells of a column, times a factor. Rows that the filter leaves out may hold anything.
std::vector<double> column_values(const CsvTable& table, const std::vector<std::size_t>& rows,
                                  std::size_t column, double factor) {
  CsvTable part;
  part.file = table.file;
  part.columns = {table.columns[column]};
  for (const std::size_t row : rows) {
    part.cells.push_back({table.cells[row][column]});
    part.line.push_back(table.line[row]);
  }
  std::vector<double> values = numbers(part, 0);
  for (double& value : values) value *= factor;
  return values;
}

}  // namespace

Loading parse_loading(std::string_view text, const std::string& where) {
  return parse_enum(text, loadings, where);
}
SignConvention parse_sign_convention(std::string_view text, const std::string& where) {
  return parse_enum(text, signs, where);
}
std::string_view to_text(Loading loading) { return loadings[static_cast<std::size_t>(loading)].first; }
std::string_view to_text(SignConvention sign) { return signs[static_cast<std::size_t>(sign)].first; }

double strain_factor(std::string_view unit, const std::string& where) {
  constexpr std::array<std::pair<std::string_view, double>, 13> spoken{{{"\u2030", 1e-3},
                                                                        {"o/oo", 1e-3},
                                                                        {"microstrain", 1e-6},
                                                                        {"ustrain", 1e-6},
                                                                        {"ue", 1e-6},
                                                                        {"\u00b5\u03b5", 1e-6},
                                                                        {"\u03bc\u03b5", 1e-6},
                                                                        {"\u00b5strain", 1e-6},
                                                                        {"\u03bcstrain", 1e-6},
                                                                        {"strain", 1},
                                                                        {"1", 1},
                                                                        {"/", 1},
                                                                        {"", 1}}};
  for (const auto& [name, factor] : spoken)
    if (unit == name) return factor;
  const std::string remedy =
      "write the unit in the header as in strain[-], strain[permil], strain[%] or strain[um/m]";
  try {
    // "mm/100mm": a displacement over its gauge length. UDUNITS-2 would read the second mm as a factor.
    const auto slash = unit.find('/');
    if (slash != std::string_view::npos && slash + 1 < unit.size() && unit[slash + 1] >= '0' &&
        unit[slash + 1] <= '9')
      return dem::unit_factor(unit.substr(0, slash), dem::Quantity::length, where) /
             dem::parse_quantity(unit.substr(slash + 1), dem::Quantity::length, where);
    const double factor = dem::unit_factor(unit, dem::Quantity::ratio, where);
    if (unit.find("rad") == std::string_view::npos && unit.find("deg") == std::string_view::npos) return factor;
  } catch (const InputError&) {
  }
  throw InputError(where, fmt::format("\"{}\" is no unit of strain", unit), remedy);
}

double stress_factor(std::string_view unit, const std::string& where) {
  if (unit.empty())
    throw InputError(where, "the stress has no unit",
                     "write it in the header as in stress[MPa], or give it with stress_unit = \"MPa\"");
  std::string remedy = "write it in the header as in stress[MPa]";
  try {
    return dem::unit_factor(unit, dem::Quantity::stress, where);
  } catch (const InputError&) {
    try {
      dem::unit_factor(unit, dem::Quantity::force, where);
      remedy = "divide the force by the loaded area, and name the column as in stress[MPa]";
    } catch (const InputError&) {
      // "kg" is no slip for "kPa".
      const auto near = unit.size() < 3
                            ? std::vector<std::string>{}
                            : nearest_names(unit, {"MPa", "N/mm2", "GPa", "kPa", "Pa", "psi", "ksi", "bar"}, 1);
      if (!near.empty()) remedy = fmt::format("did you mean \"{}\"?", near.front());
    }
  }
  throw InputError(where, fmt::format("\"{}\" is no unit of stress", unit), remedy);
}

LabCurve read_curve(const std::filesystem::path& file, const CurveSpec& spec) {
  const CsvTable table = read_csv(file, spec.csv);
  const std::size_t strain = find_column(table, spec.strain_column);
  const std::size_t stress = find_column(table, spec.stress_column);
  const std::vector<std::size_t> rows = selected_rows(table, spec.only_rows);
  bool displacement = is_displacement(table, strain, spec);
  const double strain_sign = sign_factor(spec.strain_sign.value_or(spec.sign), spec.loading);

  LabCurve curve;
  curve.file = table.file;
  curve.loading = spec.loading;
  curve.strain = column_values(table, rows, strain,
                               strain_sign * strain_column_factor(table, strain, spec, spec.gauge_length));
  curve.stress =
      column_values(table, rows, stress,
                    sign_factor(spec.sign, spec.loading) *
                        stress_factor(unit_of(table, stress, spec.stress_unit), place(table, stress)));
  if (!spec.post_peak_strain_column.empty()) {
    const std::size_t after = find_column(table, spec.post_peak_strain_column);
    const double length = spec.post_peak_gauge_length > 0 ? spec.post_peak_gauge_length : spec.gauge_length;
    curve.post_peak_strain =
        column_values(table, rows, after, strain_sign * strain_column_factor(table, after, spec, length));
    displacement = displacement || is_displacement(table, after, spec);
  }
  if (spec.gauge_length > 0 && !displacement)
    curve.notes.push_back(fmt::format("gauge_length was not used: column \"{}\" holds a strain, no length",
                                      table.columns[strain].name));
  for (const std::size_t row : rows) curve.row.push_back(table.line[row]);
  return curve;
}

void validate(const CurveOptions& options, const std::string& where) {
  const auto require = [&](bool met, const char* name, double value, const char* bound) {
    if (!met)
      throw InputError(where, fmt::format("{} = {:g}", name, value), fmt::format("{} is allowed", bound));
  };
  const CheckOptions& check = options.check;
  require(check.min_rows >= 3, "min_rows", check.min_rows, "3 or more");
  require(check.strain_noise >= 0 && check.strain_noise < 0.5, "strain_noise", check.strain_noise, "0 to 0.5");
  require(check.unload_depth > 0 && check.unload_depth < 1, "unload_depth", check.unload_depth, "0 to 1");
  require(check.seating >= 0 && check.seating <= 0.1, "seating", check.seating, "0 to 0.1");
  require(check.spike > 0, "spike", check.spike, "more than 0");
  require(options.toe.lower > 0 && options.toe.lower < options.toe.upper, "toe.lower", options.toe.lower,
          "more than 0 and less than toe.upper");
  require(options.toe.upper < 0.9, "toe.upper", options.toe.upper, "less than 0.9");
  require(options.toe.ignore_below >= 0, "toe.ignore_below", options.toe.ignore_below, "0 or more");
  require(options.smooth.window >= 0 && options.smooth.window < 0.5, "smooth.window", options.smooth.window,
          "0 to 0.5");
  require(options.smooth.min_rows >= 5, "smooth.min_rows", options.smooth.min_rows, "5 or more");
  require(options.smooth.max_rows >= 50, "smooth.max_rows", options.smooth.max_rows, "50 or more");
  require(options.resample.points_to_peak >= 10, "resample.points_to_peak", options.resample.points_to_peak,
          "10 or more");
}

LabCurve prepare_curve(const std::filesystem::path& file, const CurveSpec& spec, const CurveOptions& options) {
  validate(options);
  LabCurve curve = loading_branch(read_curve(file, spec), options.check);
  check_curve(curve, options.check);
  curve = correct_toe(make_increasing(curve), options.toe);
  if (options.smooth.enabled) curve = smooth(curve, options.smooth);
  return resample(curve, options.resample);
}

OpeningCurve read_opening_curve(const std::filesystem::path& file, const CurveSpec& spec) {
  const CsvTable table = read_csv(file, spec.csv);
  const std::size_t opening = find_column(table, spec.strain_column);
  const std::size_t stress = find_column(table, spec.stress_column);
  const std::vector<std::size_t> rows = selected_rows(table, spec.only_rows);
  const std::string unit = unit_of(table, opening, spec.strain_unit);
  if (!is_length(unit))
    throw InputError(place(table, opening),
                     fmt::format("\"{}\" is no unit of length, as an opening needs", unit),
                     "write it in the header as in opening[mm]");
  const double sign = sign_factor(spec.sign, Loading::tension);
  OpeningCurve curve;
  curve.file = table.file;
  curve.opening = column_values(table, rows, opening,
                                (spec.strain_sign ? sign_factor(*spec.strain_sign, Loading::tension) : sign) *
                                    dem::unit_factor(unit, dem::Quantity::length, place(table, opening)));
  curve.stress =
      column_values(table, rows, stress,
                    sign * stress_factor(unit_of(table, stress, spec.stress_unit), place(table, stress)));
  const auto [low, high] = std::ranges::minmax_element(curve.opening);
  const double noise = 0.01 * (*high - *low);
  double largest = curve.opening.front();
  for (std::size_t k = 0; k < rows.size(); ++k) {
    if (curve.opening[k] < largest - noise || !(noise > 0))
      throw InputError(
          fmt::format("{}: row {}, column \"{}\"", table.file, table.line[rows[k]], spec.strain_column),
          noise > 0 ? "the opening goes backwards" : "the opening never changes", "leave unloading cycles out");
    largest = std::max(largest, curve.opening[k]);
    curve.opening[k] = largest;
  }
  return curve;
}

}  // namespace lab
