// The law between an element and an impactor. The element is a sphere of radius R, the impactor rigid; they
// touch where the impactor's surface is nearest to the element's centre, at the distance phi. Overlap u = R -
// phi.
//
//   normal      linear: F_n = k u;  hertz: F_n = 4/3 E sqrt(R) u^(3/2);  plus a dashpot c du/dt; never below 0
//   tangential  spring k_t, carried with the contact as a link's shear force is (Eq. 2), |F_t| <= mu F_n
//
// Forces act at the middle of the overlap, as between elements: at (R + phi)/2 from the element's centre. The
// springs' energy depends on positions alone, and phi is continuous over faces, edges and corners (also over
// the dents of a concave mesh, where only its direction jumps), so sliding across them costs nothing.
#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "libdem/core/vector.h"

namespace impact {

using dem::Vec3;

enum class NormalSpring { linear, hertz };

struct ContactLaw {
  NormalSpring spring = NormalSpring::linear;
  /// linear: C = Kn D_init / S_int of the element's links. Only the element's half of a link deforms, so that
  /// S = pi R^2 and D = R: k = C pi R. hertz: E/(1 - nu^2) of the element [Pa]
  double modulus = 0;
  std::optional<double> stiffness;  ///< linear: k itself, the same for all elements [N/m]
  double shear_ratio = 1;           ///< k_t over C pi R, or over the given k [-]
  double friction = 0;              ///< mu, the tangent of the friction angle [-]
  double damping_ratio = 0;         ///< c over the critical 2 sqrt(m k) of the two bodies [-]

  /// Throws InputError that names `where` and the violated bound.
  void validate(const std::string& where) const;
  /// k of the linear spring [N/m].
  double normal_stiffness(double radius) const;
  /// k_t [N/m], in both laws that of the linear spring.
  double tangential_stiffness(double radius) const;
};

/// What one contact remembers.
struct ContactHistory {
  std::int32_t element = 0;
  Vec3 shear = Vec3::Zero();   ///< F_t on the element [N]
  Vec3 normal = Vec3::Zero();  ///< outward from the impactor, when `shear` was written
  double dashpot = 0;          ///< the dashpot's part of F_n [N]
};

/// How element and impactor meet.
struct ContactGeometry {
  double overlap = 0;                 ///< u at t_n, positive if they touch [m]
  Vec3 normal = Vec3::Zero();         ///< outward from the impactor at t_n
  Vec3 middle_normal = Vec3::Zero();  ///< the same at t_(n-1/2), when the velocities are taken
  Vec3 velocity = Vec3::Zero();       ///< of the element past the impactor at the contact point [m/s]
  double twist_rate = 0;              ///< mean spin of both about the normal [rad/s]
  double radius = 0;                  ///< of the element [m]
  double reduced_mass = 0;            ///< 1/(1/m + 1/M), M infinite where it is locked; for the dashpot [kg]
};

struct ContactForce {
  Vec3 force = Vec3::Zero();  ///< on the element [N]
  double normal = 0;          ///< F_n [N]
  double stored = 0;          ///< energy in the springs at t_n [J]
  double sliding = 0;         ///< dissipated by friction in the step to t_n [J]
  double damped = 0;          ///< dissipated by the dashpot in the step to t_n [J]
};

/// One contact over one step. Call it once more after the overlap has ended: it settles what the springs still
/// held. Updates the history.
ContactForce evaluate(const ContactLaw& law, const ContactGeometry& geometry, double time_step,
                      ContactHistory& history);

}  // namespace impact
