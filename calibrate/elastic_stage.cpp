#include "calibrate/elastic_stage.h"

#include <ceres/ceres.h>
#include <fmt/format.h>

#include <cmath>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/parallel.h"
#include "specimens/virtual_tests/elastic.h"

namespace calibrate {
namespace {

constexpr double poisson_scale =
    0.05;  // an error of 0.0005 in nu weighs like one of 1% in E: alpha is nu's alone

/// Eq. 1 against one measured point.
struct MicroMacroResidual {
  ElasticPoint point;

  template <class T>
  bool operator()(const T* abc, T* residual) const {
    const double r = point.shear_ratio;
    const T stiffness = (abc[1] + abc[2] * r) / (abc[0] + r);
    const T poisson = (1 - r) / (abc[0] + r);
    residual[0] = stiffness / point.stiffness - 1.0;
    residual[1] = (poisson - point.poisson_ratio) / poisson_scale;
    return true;
  }
};

dem::Vec3 solve(const std::vector<ElasticPoint>& points, dem::Mat3* covariance) {
  double abc[3] = {3.7, 2.2, 3.8};
  ceres::Problem problem;
  for (const ElasticPoint& p : points)
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<MicroMacroResidual, 2, 3>(new MicroMacroResidual{p}), nullptr, abc);
  for (int k = 0; k < 3; ++k) problem.SetParameterLowerBound(abc, k, 0.1);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.function_tolerance = 1e-14;
  options.parameter_tolerance = 1e-12;
  options.max_num_iterations = 200;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable())
    throw dem::RunError("the fit of alpha, beta, gamma failed: " + summary.message);
  if (covariance != nullptr) {
    ceres::Covariance estimate{ceres::Covariance::Options{}};
    const std::vector<std::pair<const double*, const double*>> blocks{{abc, abc}};
    if (estimate.Compute(blocks, &problem)) {
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor> block;
      estimate.GetCovarianceBlock(abc, abc, block.data());
      const double freedom = std::max(1.0, 2.0 * static_cast<double>(points.size()) - 3);
      *covariance = block * (2 * summary.final_cost / freedom);
    }
  }
  return {abc[0], abc[1], abc[2]};
}

/// The ratio where nu, linear between the measured points, falls to `wanted`.
double ratio_for(const std::vector<ElasticPoint>& mean, double wanted) {
  if (wanted > mean.front().poisson_ratio)
    throw dem::InputError("nu", fmt::format("{} is more than these specimens can show", wanted),
                          fmt::format("allowed: up to {:.3f} (Ks/Kn = {:.2g})", mean.front().poisson_ratio,
                                      mean.front().shear_ratio));
  for (std::size_t k = 1; k < mean.size(); ++k)
    if (wanted >= mean[k].poisson_ratio) {
      const double t =
          (mean[k - 1].poisson_ratio - wanted) / (mean[k - 1].poisson_ratio - mean[k].poisson_ratio);
      return mean[k - 1].shear_ratio + t * (mean[k].shear_ratio - mean[k - 1].shear_ratio);
    }
  return mean.back().shear_ratio;
}

std::vector<std::vector<ElasticPoint>> responses(const std::vector<specimens::Specimen>& specimens,
                                                 const std::vector<double>& ratios, int threads) {
  std::vector<std::vector<ElasticPoint>> all(specimens.size());
  dem::for_each_in_parallel(specimens.size(), threads,
                            [&](std::size_t k) { all[k] = elastic_response(specimens[k], ratios); });
  return all;
}

std::vector<ElasticPoint> mean_of(const std::vector<std::vector<ElasticPoint>>& all) {
  std::vector<ElasticPoint> mean(all.front().size());
  for (std::size_t k = 0; k < mean.size(); ++k) {
    mean[k].shear_ratio = all.front()[k].shear_ratio;
    for (const auto& points : all) {
      mean[k].stiffness += points[k].stiffness / static_cast<double>(all.size());
      mean[k].poisson_ratio += points[k].poisson_ratio / static_cast<double>(all.size());
    }
  }
  return mean;
}

}  // namespace

std::vector<double> default_ratios() { return {0.05, 0.17, 0.29, 0.41, 0.53, 0.65, 0.77, 0.89, 1.0}; }

std::vector<ElasticPoint> elastic_response(const specimens::Specimen& specimen,
                                           const std::vector<double>& ratios) {
  std::vector<ElasticPoint> points;
  std::vector<double> field;
  for (const double ratio : ratios) {
    if (dem::interrupt_requested()) throw dem::Interrupted("stopped by a signal");
    const virtual_tests::ElasticResult result = virtual_tests::run_elastic(specimen, 1e9, ratio, {}, &field);
    points.push_back({ratio, result.young_modulus / 1e9, result.poisson_ratio});
  }
  return points;
}

MicroMacroFit fit_micro_macro(const std::vector<ElasticPoint>& points) {
  MicroMacroFit fit;
  const dem::Vec3 abc = solve(points, &fit.covariance);
  fit.alpha = abc[0], fit.beta = abc[1], fit.gamma = abc[2];
  for (const ElasticPoint& p : points) {
    const double r = p.shear_ratio, e = (fit.beta + fit.gamma * r) / (fit.alpha + r) / p.stiffness - 1;
    const double n = (1 - r) / (fit.alpha + r) - p.poisson_ratio;
    fit.stiffness_rms += e * e / static_cast<double>(points.size());
    fit.poisson_rms += n * n / static_cast<double>(points.size());
  }
  fit.stiffness_rms = std::sqrt(fit.stiffness_rms);
  fit.poisson_rms = std::sqrt(fit.poisson_rms);
  return fit;
}

ElasticFit fit_elastic(const std::vector<specimens::Specimen>& specimens, double poisson_ratio, int threads) {
  ElasticFit fit;
  auto all = responses(specimens, default_ratios(), threads);
  // nu(Ks/Kn) is curved between the nine points, so the operating point is solved for itself and looked up
  // again.
  std::vector<ElasticPoint> mean = mean_of(all);
  fit.operating_ratio = ratio_for(mean, poisson_ratio);
  std::vector<ElasticPoint> operating;
  for (int pass = 0; pass < 2; ++pass) {
    const auto at = responses(specimens, {fit.operating_ratio}, threads);
    operating.clear();
    for (const auto& points : at) operating.push_back(points.front());
    const ElasticPoint measured = mean_of(at).front();
    if (pass == 0) {
      // Eq. 1's own slope: d(nu)/d(Ks/Kn) = -(1 + nu)/(alpha + Ks/Kn), alpha + Ks/Kn = (1 - Ks/Kn)/nu.
      const double slope = -(1 + measured.poisson_ratio) * measured.poisson_ratio / (1 - measured.shear_ratio);
      fit.operating_ratio =
          std::max(0.0, fit.operating_ratio + (poisson_ratio - measured.poisson_ratio) / slope);
    }
  }

  std::vector<ElasticPoint> points;
  for (std::size_t s = 0; s < specimens.size(); ++s) {
    std::vector<ElasticPoint> own;
    own = all[s];
    own.push_back(operating[s]);
    fit.by_specimen.push_back(solve(own, nullptr));
    points.insert(points.end(), own.begin(), own.end());
  }
  const MicroMacroFit all_points = fit_micro_macro(points);
  fit.alpha = all_points.alpha, fit.beta = all_points.beta, fit.gamma = all_points.gamma;
  fit.covariance = all_points.covariance;
  fit.stiffness_rms = all_points.stiffness_rms, fit.poisson_rms = all_points.poisson_rms;
  fit.points = std::move(points);
  return fit;
}

}  // namespace calibrate
