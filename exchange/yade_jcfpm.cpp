// Yade's jointed cohesive frictional particle model (Scholtes and Donze, 2013), JCFpmMat in Yade 2023.02a.
//
// Its link: S = pi min(Ra, Rb)^2, Fn = kn (D_init - D), breaks at Fn < -tensileStrength S; |Fs| = ks |slip|,
// breaks at |Fs| > cohesion S + Fn tan(frictionAngle). So tensileStrength = T, cohesion = Co, frictionAngle =
// phi_i are the card's own. Its stiffness is kn = 2 young Ra Rb / (Ra + Rb), ks = poisson kn, which goes with
// the radii otherwise than Kn = C S / D_init (Eq. 1): each link is given Eq. 1's after the first step, which is
// exact. What remains of `young` are new contacts: between equal spheres that touch, C pi R^2 / (2 R) = young R
// gives young = pi C / 2. A contact that was never a link has the friction residualFrictionAngle = phi_c.
#include <fmt/format.h>

#include "exchange/writers.h"
#include "exchange/yade.h"

namespace exchange {

Exported write_yade_jcfpm(const Request& request) {
  const dem::MaterialCard& card = request.card;
  std::vector<std::string> lost{
      fmt::format(
          "a link breaks at once when its tension reaches T S_int: JCFpm has no softening, zeta = {} is lost, "
          "and a specimen's tensile strength comes out lower",
          card.softening),
      "a link breaks when its shear force reaches Co S_int + Fn tan(phi_i); by the card it slides there and "
      "holds on",
      "a new contact has kn = 2 young Ra Rb / (Ra + Rb), which is the card's for equal spheres only"};
  if (card.internal_friction != card.contact_friction)
    lost.emplace_back(
        "a link that broke in shear while it was pressed keeps phi_i until its elements part; only new "
        "contacts have phi_c");
  add_common_losses(card, lost);
  YadeLaw law;
  law.title = "JCFpm (jointed cohesive frictional particle model)";
  law.material = R"(concrete = O.materials.append(JCFpmMat(
    young=0.5 * math.pi * normal_modulus,  # of new contacts; the links get theirs below
    poisson=shear_ratio,  # JCFpm's name for ks / kn
    frictionAngle=internal_friction,
    residualFrictionAngle=contact_friction,
    tensileStrength=tensile_strength,
    cohesion=cohesion,
    density=density,
    label="concrete",
)))";
  law.physics = "Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1)";
  law.law = "Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM()";
  law.stiffness = R"(    for link in links:
        distance = (O.bodies[link.id2].state.pos - O.bodies[link.id1].state.pos).norm()
        link.phys.kn = normal_modulus * link.phys.crossSection / distance
        link.phys.ks = shear_ratio * link.phys.kn
)";
  return yade_script(request, law, std::move(lost));
}

}  // namespace exchange
