#include "specimens/representative.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "libdem/core/error.h"
#include "specimens/interaction_range.h"
#include "specimens/isotropy.h"

namespace specimens {
namespace {

std::string described(Shape shape, const Vec3& size, std::size_t elements) {
  return fmt::format("specimen ({} elements in a {} of {:.4g} x {:.4g} x {:.4g} m)", elements, name_of(shape),
                     size.x(), size.y(), size.z());
}

constexpr const char* remedy = "too small to be representative: take more elements, or a larger region";

std::string too_few_across(double smallest_side, double element_size) {
  const double across = element_size > 0 ? smallest_side / element_size : 0;
  if (across >= least_elements_across) return {};
  return fmt::format("{:.1f} elements across the smallest side, at least {} are needed", across,
                     least_elements_across);
}

}  // namespace

std::string why_not_representative(const Specimen& specimen) {
  if (auto few = too_few_across(specimen.size.minCoeff(), specimen.element_size()); !few.empty()) return few;
  const auto internal = internal_elements(specimen);
  const auto count = std::accumulate(internal.begin(), internal.end(), std::size_t{0});
  if (count < least_internal_elements)
    return fmt::format("{} elements are deeper than two element sizes, at least {} are needed", count,
                       least_internal_elements);
  const double coordination = mean_interior_coordination(specimen);
  if (std::abs(coordination - wanted_coordination) > 0.05)
    return fmt::format("internal elements have {:.2f} links on average instead of {}", coordination,
                       wanted_coordination);
  const Isotropy isotropy = isotropy_of(specimen);
  if (!isotropy.isotropic)
    return fmt::format(
        "the links are not isotropic: eigenvalues of the fabric tensor {:.3f}, {:.3f}, {:.3f}, allowed 1/3 "
        "+- {:.3f}",
        isotropy.eigenvalues[0], isotropy.eigenvalues[1], isotropy.eigenvalues[2], isotropy.tolerance);
  return {};
}

void require_representative(const Specimen& specimen) {
  const std::string reason = why_not_representative(specimen);
  if (!reason.empty())
    throw dem::InputError(described(specimen.shape, specimen.size, specimen.elements()), reason, remedy);
}

void require_enough_elements(Shape shape, const Vec3& size, std::size_t elements) {
  Specimen nominal;
  nominal.shape = shape;
  nominal.size = size;
  const double element_size = std::cbrt(nominal.volume() / static_cast<double>(elements));
  const std::string few = too_few_across(size.minCoeff(), element_size);
  if (!few.empty()) throw dem::InputError(described(shape, size, elements), few, remedy);
}

void require_enough_inside(Shape shape, const Vec3& size, std::size_t elements) {
  Specimen nominal;
  nominal.shape = shape;
  nominal.size = size;
  const double element = std::cbrt(nominal.volume() / static_cast<double>(elements));
  nominal.size = (nominal.size - Vec3::Constant(4 * element)).cwiseMax(0);
  const double inside = nominal.volume() / (element * element * element);
  if (inside < static_cast<double>(least_internal_elements))
    throw dem::InputError(
        fmt::format("{} elements", elements),
        fmt::format("about {:.0f} of them are deeper than two element sizes, at least {} are needed", inside,
                    least_internal_elements),
        "too small to be representative: take more elements");
}

}  // namespace specimens
