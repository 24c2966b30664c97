#include "specimens/grading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libdem/core/error.h"

namespace specimens {
namespace {

constexpr double largest_ratio = 10;  // beyond, the small elements would lie loose between the large ones

// Inverts a growing function by bisection: slow, but exact to the last bits and used once per element.
template <class Function>
double invert(Function&& function, double value, double low, double high) {
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (function(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double normal_cumulative(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// Between two sieves the mass is even in log d, hence the number goes as d^-3 d(log d).
std::vector<double> sieved_radii(const std::vector<Sieve>& sieves, std::size_t count) {
  struct Class {
    double from, to, number;
  };
  std::vector<Class> classes;
  double total = 0;
  for (std::size_t k = 1; k < sieves.size(); ++k) {
    const double from = sieves[k - 1].diameter, to = sieves[k].diameter;
    const double mass = sieves[k].passing - sieves[k - 1].passing;
    if (mass <= 0) continue;
    const double number = mass / (3 * std::log(to / from)) * (std::pow(from, -3) - std::pow(to, -3));
    classes.push_back({from, to, number});
    total += number;
  }
  std::vector<double> radii;
  std::size_t current = 0;
  double below = 0;  // the number of elements in smaller classes
  for (std::size_t k = 0; k < count; ++k) {
    const double wanted = total * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    while (current + 1 < classes.size() && wanted > below + classes[current].number)
      below += classes[current++].number;
    const Class& c = classes[current];
    const double share = std::clamp((wanted - below) / c.number, 0.0, 1.0);
    const double from3 = std::pow(c.from, -3), to3 = std::pow(c.to, -3);
    radii.push_back(0.5 * std::pow(from3 - share * (from3 - to3), -1.0 / 3));
  }
  return radii;
}

void validate_sieves(const std::vector<Sieve>& sieves) {
  const auto refuse = [](const std::string& wrong) {
    throw dem::InputError(
        "grading: sieves", wrong,
        "give at least two, diameters ascending, passing from 0 at the first to 1 at the last");
  };
  if (sieves.size() < 2) refuse(fmt::format("there are {}", sieves.size()));
  for (std::size_t k = 0; k < sieves.size(); ++k) {
    if (!(sieves[k].diameter > 0) || !std::isfinite(sieves[k].diameter))
      refuse(fmt::format("diameter {} is not positive", sieves[k].diameter));
    if (k > 0 && !(sieves[k].diameter > sieves[k - 1].diameter)) refuse("the diameters do not ascend");
    if (k > 0 && !(sieves[k].passing >= sieves[k - 1].passing)) refuse("the passing fractions do not ascend");
  }
  if (sieves.front().passing != 0 || sieves.back().passing != 1) refuse("passing does not go from 0 to 1");
  if (sieves.back().diameter > largest_ratio * sieves.front().diameter)
    throw dem::InputError("grading: sieves",
                          fmt::format("the largest is {:.3g} times the smallest",
                                      sieves.back().diameter / sieves.front().diameter),
                          fmt::format("at most {} times; leave out the finer sieves", largest_ratio));
}

}  // namespace

void Grading::validate() const {
  if (kind == Kind::uniform && !(size_ratio >= 1 && size_ratio <= largest_ratio))
    throw dem::InputError("grading: size_ratio", fmt::format("is {}", size_ratio),
                          fmt::format("allowed: 1 to {}", largest_ratio));
  if (kind == Kind::lognormal && !(log_deviation > 0 && log_deviation <= 0.5))
    throw dem::InputError("grading: log_deviation", fmt::format("is {}", log_deviation),
                          "allowed: above 0 up to 0.5");
  if (kind == Kind::sieve) validate_sieves(sieves);
}

std::vector<double> Grading::radii(std::size_t count) const {
  validate();
  if (kind == Kind::sieve) return sieved_radii(sieves, count);
  std::vector<double> radii(count, 1.0);
  if (kind == Kind::equal) return radii;
  constexpr double cut = 2;  // deviations
  for (std::size_t k = 0; k < count; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / static_cast<double>(count);
    if (kind == Kind::uniform) {
      radii[k] = 1 + (size_ratio - 1) * share;
    } else {
      const double low = normal_cumulative(-cut), high = normal_cumulative(cut);
      radii[k] = std::exp(log_deviation * invert(normal_cumulative, low + (high - low) * share, -cut, cut));
    }
  }
  return radii;
}

}  // namespace specimens
