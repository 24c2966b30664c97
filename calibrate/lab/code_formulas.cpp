#include "calibrate/lab/code_formulas.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "libdem/core/error.h"
#include "libdem/core/units.h"

namespace lab {
namespace {

using dem::InputError;

constexpr double MPa = 1e6;

constexpr std::array<std::string_view, 2> code_names{"eurocode2_2004", "model_code_2010"};
constexpr std::array<std::string_view, 4> aggregate_names{"basalt", "quartzite", "limestone", "sandstone"};
constexpr std::array<double, 4> aggregate_factor{1.2, 1.0, 0.9, 0.7};  // alpha_E

template <class Enum, std::size_t count>
Enum parse_name(std::string_view text, const std::array<std::string_view, count>& names,
                const std::string& where) {
  std::string all;
  for (std::size_t k = 0; k < count; ++k) {
    if (names[k] == text) return static_cast<Enum>(k);
    all += fmt::format("{}\"{}\"", k == 0 ? "" : ", ", names[k]);
  }
  throw InputError(where, fmt::format("\"{}\" is not known here", text), "allowed: " + all);
}

/// fib Model Code 2010, Table 5.1-8; between the classes, linear.
struct CompressionRow {
  double fck, strain_at_peak, strain_limit, k;  // MPa, permil, permil, - (of quartzite)
};
constexpr std::array<CompressionRow, 17> table_5_1_8{{{12, 1.9, 3.5, 2.44},
                                                      {16, 2.0, 3.5, 2.36},
                                                      {20, 2.1, 3.5, 2.28},
                                                      {25, 2.2, 3.5, 2.15},
                                                      {30, 2.3, 3.5, 2.04},
                                                      {35, 2.3, 3.5, 1.92},
                                                      {40, 2.4, 3.5, 1.82},
                                                      {45, 2.5, 3.5, 1.74},
                                                      {50, 2.6, 3.4, 1.66},
                                                      {55, 2.6, 3.4, 1.61},
                                                      {60, 2.7, 3.3, 1.55},
                                                      {70, 2.7, 3.2, 1.47},
                                                      {80, 2.8, 3.1, 1.41},
                                                      {90, 2.9, 3.0, 1.36},
                                                      {100, 3.0, 3.0, 1.32},
                                                      {110, 3.0, 3.0, 1.24},
                                                      {120, 3.0, 3.0, 1.18}}};

CompressionRow compression_row(double fck) {
  std::size_t k = 1;
  while (k + 1 < table_5_1_8.size() && table_5_1_8[k].fck < fck) ++k;
  const CompressionRow& a = table_5_1_8[k - 1];
  const CompressionRow& b = table_5_1_8[k];
  const double t = (fck - a.fck) / (b.fck - a.fck);
  return {fck, std::lerp(a.strain_at_peak, b.strain_at_peak, t), std::lerp(a.strain_limit, b.strain_limit, t),
          std::lerp(a.k, b.k, t)};
}

double tensile_strength(double fck) {  // MPa; the same in both codes
  return fck <= 50 ? 0.3 * std::pow(fck, 2.0 / 3) : 2.12 * std::log(1 + 0.1 * (fck + 8));
}

LabCurve compression_curve(const CodeConcrete& c, int points_to_peak) {
  LabCurve curve;
  curve.file = c.k.source;
  const double step = c.strain_at_peak.value / points_to_peak;
  const auto points = static_cast<int>(c.strain_limit.value / step + 1e-9);
  for (int k = 0; k <= points; ++k) {
    const double eta = static_cast<double>(k) / points_to_peak;
    curve.strain.push_back(eta * c.strain_at_peak.value);
    curve.stress.push_back(std::max(0.0, sargin(eta, c.k.value)) * c.fcm.value);
  }
  return curve;
}

constexpr double tension_strain_at_peak = 0.00015;  // Model Code 2010, 5.1.8.2

/// Straight to 0.9 fctm, then flatter up to fctm at 0.15 permil (Model Code 2010, 5.1.8.2).
LabCurve tension_curve(const CodeConcrete& c, int points_to_peak, bool with_knee) {
  LabCurve curve;
  curve.loading = Loading::tension;
  const double ft = c.fctm.value;
  const double knee = 0.9 * ft / c.E_initial.value;
  with_knee = with_knee && knee < tension_strain_at_peak;
  const double end = with_knee ? tension_strain_at_peak : ft / c.E_initial.value;
  for (int k = 0; k <= points_to_peak; ++k) {
    const double strain = end * k / points_to_peak;
    curve.strain.push_back(strain);
    curve.stress.push_back(with_knee && strain > knee ? ft * (1 - 0.1 * (end - strain) / (end - knee))
                                                      : c.E_initial.value * strain);
  }
  curve.stress.back() = ft;
  curve.file =
      fmt::format("{}", with_knee ? "fib Model Code 2010, 5.1.8.2" : "straight line to the tensile strength");
  return curve;
}

/// Bilinear from fctm over (w1, 0.2 fctm) to (wc, 0), w1 = GF / fctm, wc = 5 w1: its area is GF (Model Code
/// 2010, 5.1.8.2).
OpeningCurve softening_curve(const CodeConcrete& c, int points) {
  OpeningCurve curve;
  curve.file = "fib Model Code 2010, 5.1.8.2";
  const double ft = c.fctm.value;
  const double w1 = c.fracture_energy.value / ft;
  for (int k = 0; k <= 5 * points; ++k) {
    const double u = static_cast<double>(k) / points;  // w / w1
    curve.opening.push_back(u * w1);
    curve.stress.push_back(ft * (u <= 1 ? 1 - 0.8 * u : 0.25 - 0.05 * u));
  }
  curve.stress.back() = 0;
  return curve;
}

}  // namespace

Code parse_code(std::string_view text, const std::string& where) {
  return parse_name<Code>(text, code_names, where);
}
Aggregate parse_aggregate(std::string_view text, const std::string& where) {
  return parse_name<Aggregate>(text, aggregate_names, where);
}
std::string_view to_text(Code code) { return code_names[static_cast<std::size_t>(code)]; }
std::string_view to_text(Aggregate aggregate) { return aggregate_names[static_cast<std::size_t>(aggregate)]; }

double sargin(double eta, double k) { return (k * eta - eta * eta) / (1 + (k - 2) * eta); }

double parse_strength_class(std::string_view text, const std::string& where) {
  const std::string remedy = "write a class such as \"C40/50\" or a strength such as \"40 MPa\"";
  const bool is_class = text.starts_with('C') || text.starts_with('c');
  if (!is_class && text.find_first_of("0123456789") != 0)
    throw InputError(where, fmt::format("\"{}\" is no strength class", text), remedy);
  if (!is_class) return dem::parse_quantity(text, dem::Quantity::stress, where);
  const auto number = [&](std::string_view part) -> double {
    double value = 0;
    const auto [end, error] =
        std::from_chars(part.data(), part.data() + part.size(), value, std::chars_format::fixed);
    if (error != std::errc{} || end != part.data() + part.size() || !(value > 0))
      throw InputError(where, fmt::format("\"{}\" is no strength class", text), remedy);
    return value;
  };
  const auto slash = text.find('/');
  const double cylinder = number(text.substr(1, slash == std::string_view::npos ? slash : slash - 1));
  if (slash != std::string_view::npos) {
    const double cube = number(text.substr(slash + 1));
    // "C50/40" or "C40/80" is a slip of the pen; the classes lie between 1.15 and 1.25.
    if (cube < 1.1 * cylinder || cube > 1.3 * cylinder)
      throw InputError(
          where, fmt::format("\"{}\" is no strength class: cylinder {:g}, cube {:g} MPa", text, cylinder, cube),
          remedy);
  }
  return cylinder * MPa;
}

CodeConcrete code_concrete(Code code, double fck_pascal, Aggregate aggregate, int points_to_peak) {
  const bool eurocode = code == Code::eurocode2_2004;
  const std::string name = eurocode ? "EN 1992-1-1:2004" : "fib Model Code 2010";
  const double fck = fck_pascal / MPa;
  const double highest = eurocode ? 90 : 120;
  if (!(fck >= 12 - 1e-9 && fck <= highest + 1e-9))
    throw InputError(name, fmt::format("fck = {:.4g} MPa", fck),
                     fmt::format("it covers 12 to {:g} MPa", highest));
  if (points_to_peak < 2)
    throw InputError(name, fmt::format("{} points to the peak", points_to_peak), "give at least 2");

  const std::string of = fmt::format("fck = {:.4g} MPa", fck);
  const auto source = [&](std::string_view clause) { return fmt::format("{}, {}, {}", name, clause, of); };
  const auto source_aggregate = [&](std::string_view clause) {
    return fmt::format("{}, {} aggregate", source(clause), to_text(aggregate));
  };
  const double fcm = fck + 8;
  const double alpha = aggregate_factor[static_cast<std::size_t>(aggregate)];
  CodeConcrete c;
  c.code = code;
  c.aggregate = aggregate;
  c.fck = fck_pascal;
  const double fctm = tensile_strength(fck);
  if (eurocode) {
    const double Ecm = alpha * 22000 * std::pow(fcm / 10, 0.3);
    const double strain_at_peak = std::min(0.7 * std::pow(fcm, 0.31), 2.8) * 1e-3;
    const double strain_limit = fck <= 50 ? 3.5e-3 : (2.8 + 27 * std::pow((98 - fcm) / 100, 4)) * 1e-3;
    c.fcm = {fcm * MPa, source("Table 3.1")};
    c.fctm = {fctm * MPa, source("Table 3.1")};
    c.E_secant = {Ecm * MPa, source_aggregate("Table 3.1, 3.1.3(2)")};
    c.E_initial = {1.05 * Ecm * MPa, source_aggregate("3.1.5, 1.05 Ecm")};
    c.nu = {0.2, fmt::format("EN 1992-1-1:2004, 3.1.3(4), uncracked, {}", of)};
    c.strain_at_peak = {strain_at_peak, source("Table 3.1")};
    c.strain_limit = {strain_limit, source("Table 3.1")};
    c.k = {1.05 * Ecm * strain_at_peak / fcm, source_aggregate("3.14")};
  } else {
    const CompressionRow row = compression_row(fck);
    const double Eci = 21500 * alpha * std::cbrt(fcm / 10);
    c.fcm = {fcm * MPa, source("5.1-1")};
    c.fctm = {fctm * MPa, source(fck <= 50 ? "5.1-3a" : "5.1-3b")};
    c.E_initial = {Eci * MPa, source_aggregate("5.1-21")};
    c.E_secant = {std::min(0.8 + 0.2 * fcm / 88, 1.0) * Eci * MPa, source_aggregate("5.1-23, 5.1-24")};
    c.nu = {0.2, fmt::format("EN 1992-1-1:2004, 3.1.3(4), uncracked, {}", of)};
    c.strain_at_peak = {row.strain_at_peak * 1e-3, source("Table 5.1-8")};
    c.strain_limit = {row.strain_limit * 1e-3, source("Table 5.1-8")};
    // k = Eci / Ec1: the table's is of quartzite, and the aggregate scales Eci.
    c.k = {alpha * row.k, source_aggregate("5.1-26, Table 5.1-8")};
    if (0.9 * c.fctm.value < tension_strain_at_peak * c.E_initial.value)
      c.tension_strain_at_peak = {tension_strain_at_peak, source("5.1.8.2")};
    c.fracture_energy = {73 * std::pow(fcm, 0.18), source("5.1-9")};
  }
  // With k at 1 the secant at the peak is the tangent at the origin: no curve could bend in between.
  if (!(c.k.value > 1))
    throw InputError(name,
                     fmt::format("{} aggregate with {} gives k = {:.3g}", to_text(aggregate), of, c.k.value),
                     "k must be above 1: choose a stiffer aggregate or a lower strength");
  c.compression = compression_curve(c, points_to_peak);
  c.tension = tension_curve(c, points_to_peak, !eurocode);
  if (!eurocode) c.softening = softening_curve(c, points_to_peak);
  return c;
}

}  // namespace lab
