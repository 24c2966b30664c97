#include "impact/outcome/slab_damage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "libdem/core/error.h"

namespace impact {
namespace {

/// First and second moments in the plane of the face, for the radius.
struct Spread {
  Vec3 first = Vec3::Zero();
  double second = 0;
};

void finish(Loss& loss, const Spread& spread, double solid_fraction) {
  if (loss.volume > 0) {
    const double square = spread.second / loss.volume - (spread.first / loss.volume).squaredNorm();
    loss.equivalent_radius = std::sqrt(2 * std::max(0.0, square));
  }
  loss.volume /= solid_fraction;
}

}  // namespace

void Slab::validate(std::string_view where) const {
  if (!(std::abs(outward.norm() - 1) < 1e-9))
    throw dem::InputError(std::string(where), fmt::format("the slab's normal has length {}", outward.norm()),
                          "it must be a unit vector");
  if (!(thickness > 0 && std::isfinite(thickness)))
    throw dem::InputError(std::string(where), fmt::format("the slab's thickness is {} m", thickness),
                          "it must be positive and finite");
}

SlabLoss find_losses(const Slab& slab, const Fragments& fragments, std::span<const Vec3> initial_position,
                     std::span<const double> radius, std::span<const double> mass, double solid_fraction) {
  slab.validate("slab losses");
  const std::size_t count = fragments.of_element.size();
  if (initial_position.size() != count || radius.size() != count || mass.size() != count)
    throw dem::InputError("slab losses",
                          fmt::format("{} elements, {} positions, {} radii, {} masses", count,
                                      initial_position.size(), radius.size(), mass.size()),
                          "every element needs one of each");
  if (!(solid_fraction > 0 && solid_fraction <= 1))
    throw dem::InputError("slab losses", fmt::format("the solid fraction is {}", solid_fraction),
                          "it must be above 0 and at most 1");
  SlabLoss losses;
  Spread front, back;
  for (std::size_t i = 0; i < count; ++i) {
    if (!fragments.detached(i)) continue;
    const double depth = slab.depth(initial_position[i]);
    const bool crater = depth < 0.5 * slab.thickness;
    Loss& loss = crater ? losses.crater : losses.scab;
    Spread& spread = crater ? front : back;
    const double r = radius[i], sphere = 4.0 / 3 * std::numbers::pi * r * r * r;
    const Vec3 from = initial_position[i] - slab.front;
    const Vec3 in_plane = from - from.dot(slab.outward) * slab.outward;
    ++loss.elements;
    loss.mass += mass[i];
    loss.volume += sphere;
    loss.depth = std::max(loss.depth, (crater ? depth : slab.thickness - depth) + r);
    spread.first += sphere * in_plane;
    // A sphere's own spread in a plane is 2/5 r^2.
    spread.second += sphere * (in_plane.squaredNorm() + 0.4 * r * r);
  }
  finish(losses.crater, front, solid_fraction);
  finish(losses.scab, back, solid_fraction);
  return losses;
}

std::string_view name_of(Passage passage) {
  switch (passage) {
    case Passage::approaching:
      return "approaching";
    case Passage::inside:
      return "inside";
    case Passage::rebounded:
      return "rebounded";
    case Passage::perforated:
      return "perforated";
  }
  return "";
}

ImpactorOutcome judge(const Slab& slab, const Vec3& centre, const Vec3& velocity, double inward_reach,
                      double outward_reach) {
  slab.validate("the impactor's outcome");
  ImpactorOutcome outcome;
  const double depth = slab.depth(centre);
  outcome.nose_depth = depth + inward_reach;
  outcome.residual_velocity = -velocity.dot(slab.outward);
  outcome.perforated = depth > slab.thickness && outcome.residual_velocity > 0;
  outcome.clear = outcome.perforated && depth - outward_reach > slab.thickness;
  if (outcome.perforated)
    outcome.passage = Passage::perforated;
  else if (outcome.nose_depth > 0)
    outcome.passage = Passage::inside;
  else
    outcome.passage = outcome.residual_velocity < 0 ? Passage::rebounded : Passage::approaching;
  return outcome;
}

}  // namespace impact
