// What became of a slab: crater in front, scab behind, and whether the impactor came through.
#pragma once
#include <span>
#include <string_view>

#include "impact/outcome/fragments.h"
#include "libdem/core/vector.h"

namespace impact {

/// A slab before the impact. Depth counts from the front face along the inward normal.
struct Slab {
  Vec3 front = Vec3::Zero();     ///< a point of the face that is struck [m]
  Vec3 outward = Vec3::UnitZ();  ///< unit normal of that face, against the impactor
  double thickness = 0;          ///< [m]

  double depth(const Vec3& point) const { return (front - point).dot(outward); }
  /// Throws InputError that names `where` if the normal is no unit vector or the thickness not positive.
  void validate(std::string_view where) const;
};

/// Material lost on one side. Where elements were counts, not where they are.
struct Loss {
  std::size_t elements = 0;
  double mass = 0;    ///< [kg]
  double volume = 0;  ///< of concrete: the elements' spheres over the pack's solid fraction [m3]
  double depth = 0;   ///< from its face to the far side of the deepest lost element [m]
  /// Of a disc that spreads the lost volume about its middle as far: sqrt(2) times the radius of gyration in
  /// the plane of the face. An element far off counts by its size only [m]
  double equivalent_radius = 0;
};

/// The crater is what is detached of the slab's front half, the scab what is detached of its rear half:
/// elements that are not part of the main body, by their depth before the impact against half the thickness.
struct SlabLoss {
  Loss crater, scab;
};

/// `initial_position`, `radius` and `mass` by element, as `fragments` was made of. `solid_fraction` is that of
/// the pack, spheres over volume, above 0 and at most 1. Throws InputError if a column differs in length or the
/// solid fraction is out of bounds.
SlabLoss find_losses(const Slab& slab, const Fragments& fragments, std::span<const Vec3> initial_position,
                     std::span<const double> radius, std::span<const double> mass, double solid_fraction);

/// Where an impactor is and where it goes.
enum class Passage {
  approaching,  ///< before the slab, coming
  inside,       ///< its nose is behind the plane of the front face, its centre not behind that of the back face
  rebounded,    ///< wholly before the front face, leaving
  perforated    ///< its centre of mass is behind the back face and moves on
};
std::string_view name_of(Passage passage);

struct ImpactorOutcome {
  Passage passage = Passage::approaching;
  /// The criterion of perforation: the impactor's centre of mass has passed the plane that the back face had
  /// before the impact and still moves on. Contact can only push, so it will not come back.
  bool perforated = false;
  bool clear = false;     ///< perforated, and its tail has passed that plane too
  double nose_depth = 0;  ///< of its foremost point now, behind the initial front face [m]
  double residual_velocity =
      0;  ///< of its centre of mass along the inward normal; negative when it leaves [m/s]
};

/// From the impactor's centre of mass, velocity, and how far it reaches from its centre along the inward and
/// along the outward normal [m].
ImpactorOutcome judge(const Slab& slab, const Vec3& centre, const Vec3& velocity, double inward_reach,
                      double outward_reach);

}  // namespace impact
