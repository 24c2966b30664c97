#include "specimens/extract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdem/core/error.h"
#include "specimens/interaction_range.h"
#include "specimens/representative.h"

namespace specimens {
namespace {

void require_size(Shape shape, const Vec3& centre, const Vec3& size) {
  if (!centre.allFinite()) throw dem::InputError("extract: centre", "is not finite", "give three lengths");
  if (!size.allFinite() || !(size.minCoeff() > 0))
    throw dem::InputError("extract: size",
                          fmt::format("is {:.4g} x {:.4g} x {:.4g} m", size.x(), size.y(), size.z()),
                          "each side must be positive");
  if (shape == Shape::cylinder && size.x() != size.y())
    throw dem::InputError("extract: size",
                          fmt::format("has two diameters, {:.4g} and {:.4g} m", size.x(), size.y()),
                          "a cylinder's size is diameter x diameter x length");
}

// How far the region stays from the faces of `larger` [m]; negative if it sticks out.
double clearance(const Specimen& larger, Shape shape, const Vec3& centre, const Vec3& size) {
  const double along_z = std::min(centre.z() - size.z() / 2, larger.size.z() - centre.z() - size.z() / 2);
  double across = std::numeric_limits<double>::infinity();
  if (larger.shape == Shape::box) {
    for (int axis = 0; axis < 2; ++axis)
      across =
          std::min({across, centre[axis] - size[axis] / 2, larger.size[axis] - centre[axis] - size[axis] / 2});
  } else {
    const double radius = larger.size.x() / 2;
    const double x = std::abs(centre.x() - radius), y = std::abs(centre.y() - radius);
    across = shape == Shape::cylinder ? radius - std::hypot(x, y) - size.x() / 2
                                      : radius - std::hypot(x + size.x() / 2, y + size.y() / 2);
  }
  return std::min(along_z, across);
}

}  // namespace

Specimen cut_out(const Specimen& larger, Shape shape, const Vec3& centre, const Vec3& size) {
  require_size(shape, centre, size);
  const double hair = 1e-9 * larger.size.maxCoeff();  // the region may share a face, whatever the rounding
  if (const double found = clearance(larger, shape, centre, size); found < -hair)
    throw dem::InputError(
        "extract",
        fmt::format(
            "the region of {:.4g} x {:.4g} x {:.4g} m around ({:.4g}, {:.4g}, {:.4g}) m sticks out by {:.3g} m "
            "of the {} of {:.4g} x {:.4g} x {:.4g} m",
            size.x(), size.y(), size.z(), centre.x(), centre.y(), centre.z(), -found, name_of(larger.shape),
            larger.size.x(), larger.size.y(), larger.size.z()),
        "move it or make it smaller");

  Specimen cut;
  cut.shape = shape;
  cut.size = size;
  cut.seed = larger.seed;
  cut.origin =
      fmt::format("extracted around ({:.6g}, {:.6g}, {:.6g}) m from a {} of {:.6g} x {:.6g} x {:.6g} m ({})",
                  centre.x(), centre.y(), centre.z(), name_of(larger.shape), larger.size.x(), larger.size.y(),
                  larger.size.z(), larger.origin);
  const Vec3 origin = centre - size / 2;
  for (std::size_t k = 0; k < larger.elements(); ++k) {
    const Vec3 moved = larger.centres[k] - origin;
    if (cut.depth(moved) < 0) continue;
    cut.centres.push_back(moved);
    cut.radii.push_back(larger.radii[k]);
  }
  if (cut.elements() == 0) throw dem::InputError("extract", "the region holds no element", "make it larger");
  return cut;
}

Specimen extract(const Specimen& larger, Shape shape, const Vec3& centre, const Vec3& size) {
  Specimen cut = cut_out(larger, shape, centre, size);
  require_enough_elements(cut.shape, cut.size, cut.elements());
  link(cut);
  require_representative(cut);
  return cut;
}

}  // namespace specimens
