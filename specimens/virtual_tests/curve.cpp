#include "specimens/virtual_tests/curve.h"

#include <fmt/format.h>

#include <algorithm>

namespace virtual_tests {

std::size_t peak_of(const Curve& curve) {
  const auto best = std::max_element(
      curve.begin(), curve.end(), [](const CurvePoint& a, const CurvePoint& b) { return a.stress < b.stress; });
  return static_cast<std::size_t>(best - curve.begin());
}

Moduli moduli_of(const Curve& curve) {
  if (curve.empty()) return {};
  const std::size_t peak = peak_of(curve);
  const double low = curve[peak].stress / 10, high = curve[peak].stress / 3;
  double n = 0, x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0;
  for (std::size_t k = 0; k < peak; ++k) {
    const CurvePoint& p = curve[k];
    if (p.stress < low || p.stress > high) continue;
    n += 1, x += p.strain_axial, y += p.stress, z += p.strain_lateral;
    xx += p.strain_axial * p.strain_axial, xy += p.strain_axial * p.stress,
        xz += p.strain_axial * p.strain_lateral;
  }
  const double spread = n * xx - x * x;
  if (n < 3 || spread <= 0) return {};
  return {(n * xy - x * y) / spread, -(n * xz - x * z) / spread};
}

double work_of_fracture(const Curve& curve, double gauge_length, double young_modulus) {
  if (curve.size() < 2) return 0;
  double work = 0;
  for (std::size_t k = 1; k < curve.size(); ++k)
    work += 0.5 * (curve[k].stress + curve[k - 1].stress) * (curve[k].strain - curve[k - 1].strain);
  const double last = curve.back().stress;
  const double returned = young_modulus > 0 ? 0.5 * last * last / young_modulus : 0;
  return (work - returned) * gauge_length;
}

std::string to_csv(const Curve& curve) {
  std::string text = "strain[-],stress[Pa],strain_axial[-],strain_lateral[-],broken[-],unbalanced[-]\n";
  for (const CurvePoint& p : curve)
    text += fmt::format("{:.9g},{:.9g},{:.9g},{:.9g},{:.6g},{:.6g}\n", p.strain, p.stress, p.strain_axial,
                        p.strain_lateral, p.broken, p.unbalanced);
  return text;
}

}  // namespace virtual_tests
