#include "specimens/packing.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "libdem/core/error.h"
#include "libdem/core/interrupt.h"
#include "libdem/core/memory.h"
#include "libdem/core/random.h"
#include "specimens/interaction_range.h"
#include "specimens/relaxation.h"
#include "specimens/representative.h"
#include "specimens/space_filling_curve.h"
#include "specimens/start_sites.h"

namespace specimens {
namespace {

// At the peak of packing and linking, see docs/limits.md.
constexpr double bytes_an_element = 700;

void require_between(const char* name, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw dem::InputError(fmt::format("packing: {}", name), fmt::format("is {:.4g}", value),
                          fmt::format("allowed: {:.4g} to {:.4g}", low, high));
}

}  // namespace

void PackingOptions::validate() const {
  for (int axis = 0; axis < 3; ++axis)
    if (!(size[axis] > 0) || !std::isfinite(size[axis]))
      throw dem::InputError("packing: size", fmt::format("is {:.4g} m along axis {}", size[axis], axis),
                            "each side must be positive");
  if (shape == Shape::cylinder && size.x() != size.y())
    throw dem::InputError("packing: size",
                          fmt::format("has two diameters, {:.4g} and {:.4g} m", size.x(), size.y()),
                          "a cylinder's size is diameter x diameter x length");
  if (elements < 1 || elements > 100'000'000)
    throw dem::InputError("packing: elements", fmt::format("is {}", elements), "allowed: 1 to 100000000");
  if (threads < 0) throw dem::InputError("packing: threads", fmt::format("is {}", threads), "0 (all) or more");
  require_between("dense_solid_fraction", dense_solid_fraction, 0.45, 0.64);
  require_between("solid_fraction", solid_fraction, 0.1, 0.9 * dense_solid_fraction);
  grading.validate();
}

Specimen pack(const PackingOptions& options, const dem::ProgressCallback& progress) {
  options.validate();
  dem::require_memory(bytes_an_element * static_cast<double>(options.elements), "packing: elements",
                      fmt::format("a specimen of {} elements", options.elements));
  Specimen specimen;
  specimen.shape = options.shape;
  specimen.size = options.size;
  specimen.seed = options.seed;
  specimen.origin = fmt::format("packed, seed {}", options.seed);

  dem::Random random(options.seed);
  std::vector<Vec3> centres = start_sites(options.shape, options.size, options.elements, random);
  std::vector<double> radii = spread_evenly(options.grading.radii(options.elements), random);
  double solid = 0;
  for (const double radius : radii) solid += 4 * std::numbers::pi / 3 * radius * radius * radius;
  const double scale = std::cbrt(options.dense_solid_fraction * specimen.volume() / solid);
  for (double& radius : radii) radius *= scale;
  if (2 * *std::max_element(radii.begin(), radii.end()) > options.size.minCoeff())
    throw dem::InputError(
        "packing: size",
        fmt::format("the smallest side is {:.3g} m, less than one element", options.size.minCoeff()),
        "take more elements or a thicker shape");

  RelaxationOptions relaxation;
  relaxation.shape = options.shape;
  relaxation.size = options.size;
  const double shrink = std::cbrt(options.solid_fraction / options.dense_solid_fraction);
  relaxation.wall_share = shrink;  // so that the shrunk elements touch the faces from inside
  relaxation.threads = options.threads > 0 ? options.threads : omp_get_max_threads();
  relaxation.after_sweep = [&](std::size_t sweep, double overlap) {
    if (dem::interrupt_requested())
      throw dem::Interrupted("packing was stopped; nothing was written, start it again");
    if (progress && sweep % 20 == 0)
      progress({"packing", static_cast<double>(sweep), 0, "sweeps",
                fmt::format("largest overlap {:.1f}%", 100 * overlap)});
  };
  const RelaxationResult relaxed = relax(centres, radii, relaxation);
  if (relaxed.largest_overlap >= 1 - shrink)
    throw dem::RunError(
        fmt::format("packing: overlaps of {:.1f}% are left after {} sweeps; lower dense_solid_fraction "
                    "(now {:.3g}) or take more elements",
                    100 * relaxed.largest_overlap, relaxed.sweeps, options.dense_solid_fraction));
  for (double& radius : radii) radius *= shrink;

  const auto order = hilbert_order(centres, Vec3::Zero(), options.size.maxCoeff());
  specimen.centres = in_order(order, centres);
  specimen.radii = in_order(order, radii);
  if (progress)
    progress({"packing", static_cast<double>(relaxed.sweeps), static_cast<double>(relaxed.sweeps), "sweeps",
              fmt::format("largest overlap {:.1f}%", 100 * relaxed.largest_overlap)});
  return specimen;
}

Specimen make_specimen(const PackingOptions& options, const dem::ProgressCallback& progress) {
  options.validate();
  require_enough_elements(options.shape, options.size, options.elements);
  Specimen specimen = pack(options, progress);
  if (progress) progress({"linking", 0, 0, "links", ""});
  link(specimen, options.threads);
  require_representative(specimen);
  return specimen;
}

}  // namespace specimens
