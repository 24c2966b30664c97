#include "study/design.h"

#include <fmt/format.h>
#include <gsl/gsl_qrng.h>

#include <cmath>
#include <memory>

#include "libdem/core/error.h"
#include "study/statistics/sobol_indices.h"

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

/// The parameters at the shares (0 to 1) of their ranges.
std::vector<double> values_at(const Study& study, const std::vector<double>& shares) {
  std::vector<double> list;
  for (std::size_t p = 0; p < study.parameters.size(); ++p)
    list.push_back(within_range(study.parameters[p], shares[p]));
  return list;
}

std::vector<DesignPoint> sobol(const Study& study) {
  require_not_too_many(study, static_cast<double>(study.points));
  const std::size_t d = study.parameters.size();
  const std::unique_ptr<gsl_qrng, void (*)(gsl_qrng*)> sequence(
      gsl_qrng_alloc(gsl_qrng_sobol, static_cast<unsigned>(d)), gsl_qrng_free);
  if (!sequence) throw std::bad_alloc();
  std::vector<double> shares(d);
  std::vector<DesignPoint> points;
  for (std::size_t row = 0; row < study.points; ++row) {
    gsl_qrng_get(sequence.get(), shares.data());
    points.push_back({values_at(study, shares), "", row});
  }
  return points;
}

std::vector<DesignPoint> sensitivity(const Study& study) {
  const std::size_t d = study.parameters.size();
  require_not_too_many(study, static_cast<double>(study.points) * (static_cast<double>(d) + 2));
  const statistics::SobolDesign design = statistics::sobol_design(d, study.points);
  std::vector<DesignPoint> points;
  for (std::size_t k = 0; k < design.points.size(); ++k) {
    const std::size_t row = k / design.rows_per_base_point(), place = k % design.rows_per_base_point();
    const std::string block = place == 0 ? "A" : place == 1 ? "B" : fmt::format("AB{}", place - 1);
    points.push_back({values_at(study, design.points[k]), block, row});
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
  if (study.design == DesignKind::factorial) return factorial(study);
  return study.sensitivity ? sensitivity(study) : sobol(study);
}

}  // namespace study
