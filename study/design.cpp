#include "study/design.h"

#include <fmt/format.h>
#include <gsl/gsl_qrng.h>

#include <cmath>
#include <memory>

#include "libdem/core/error.h"

namespace study {
namespace {

constexpr double most_points = 1e6;

void require_not_too_many(const Study& study, double count) {
  if (count > most_points)
    throw dem::InputError(study.file.string() + ": vary", fmt::format("there would be {:.3g} points", count),
                          "at most a million: take fewer values, or design = \"sobol\"");
}

std::vector<DesignPoint> factorial(const Study& study) {
  double count = 1;
  for (const Parameter& parameter : study.parameters) count *= static_cast<double>(parameter.values.size());
  require_not_too_many(study, count);
  std::vector<DesignPoint> points(static_cast<std::size_t>(count));
  for (std::size_t k = 0; k < points.size(); ++k) {
    points[k].values.resize(study.parameters.size());
    std::size_t rest = k;
    for (std::size_t p = study.parameters.size(); p-- > 0;) {
      const std::vector<double>& values = study.parameters[p].values;
      points[k].values[p] = values[rest % values.size()];
      rest /= values.size();
    }
  }
  return points;
}

std::vector<DesignPoint> sobol(const Study& study) {
  const std::size_t d = study.parameters.size();
  require_not_too_many(
      study, static_cast<double>(study.points) * (study.sensitivity ? static_cast<double>(d) + 2 : 1));
  const std::size_t dimensions = study.sensitivity ? 2 * d : d;
  const std::unique_ptr<gsl_qrng, void (*)(gsl_qrng*)> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(dimensions)), gsl_qrng_free);
  if (!sequence) throw std::bad_alloc();
  std::vector<double> shares(dimensions);
  std::vector<DesignPoint> points;
  for (std::size_t row = 0; row < study.points; ++row) {
    gsl_qrng_get(sequence.get(), shares.data());
    const auto values = [&](std::size_t first, std::size_t swapped) {
      std::vector<double> list(d);
      for (std::size_t p = 0; p < d; ++p)
        list[p] = within_range(study.parameters[p], shares[(p == swapped ? d : first) + p]);
      return list;
    };
    if (!study.sensitivity) {
      points.push_back({values(0, d), "", row});
      continue;
    }
    points.push_back({values(0, d), "A", row});
    points.push_back({values(d, d), "B", row});
    for (std::size_t p = 0; p < d; ++p) points.push_back({values(0, p), fmt::format("AB{}", p + 1), row});
  }
  return points;
}

}  // namespace

double within_range(const Parameter& parameter, double share) {
  if (share <= 0) return parameter.from;
  if (share >= 1) return parameter.to;
  return parameter.logarithmic ? parameter.from * std::pow(parameter.to / parameter.from, share)
                               : parameter.from + share * (parameter.to - parameter.from);
}

std::vector<DesignPoint> design_points(const Study& study) {
  return study.design == DesignKind::sobol ? sobol(study) : factorial(study);
}

}  // namespace study
