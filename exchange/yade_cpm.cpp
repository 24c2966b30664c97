// Yade's concrete particle model (Smilauer, 2010), CpmMat in Yade 2023.02a.
//
// Its link: S = pi min(Ra, Rb)^2, kn = young S / D_init, ks = poisson kn: Eq. 1 with young = C, poisson =
// Ks/Kn. With damLaw = 0 the damage omega = (1 - e0/k) / (1 - e0/ef), k the largest strain so far, e0 =
// epsCrackOnset, ef = relDuctility e0, makes the stress (1 - omega) C strain fall in a straight line from C e0
// at e0 to zero at ef, and unload towards the origin. That is Fig. 1 with e0 = T/C and ef = (1 + zeta) T/C, so
// relDuctility = 1 + zeta. In compression omega does not count. In shear (yieldSurfType = 0) |Fs| <= S max(0,
// sigmaT (1 - omega)) + Fn tan(frictionAngle): it slides, as by the card, with sigmaT = Co. Rate effects are
// off.
#include <fmt/format.h>

#include "exchange/writers.h"
#include "exchange/yade.h"

namespace exchange {

Exported write_yade_cpm(const Request& request) {
  const dem::MaterialCard& card = request.card;
  std::vector<std::string> lost{card.cohesion_during_softening == dem::CohesionDuringSoftening::constant
                                    ? "a link's cohesion shrinks by 1 - omega as soon as it softens; by the "
                                      "card it stays Co until the link breaks"
                                    : "a link's cohesion shrinks by 1 - omega as it softens, by the card in "
                                      "proportion to the tension that it "
                                      "still holds, which is slower"};
  if (card.unloading == dem::SofteningUnloading::elastic)
    lost.emplace_back(
        "a softened link unloads towards the origin; by the card parallel to the elastic loading");
  if (card.internal_friction != card.contact_friction)
    lost.emplace_back("contacts have the friction phi_i of links: CPM knows one angle");
  add_common_losses(card, lost);
  YadeLaw law;
  law.title = "CPM (concrete particle model)";
  law.material = R"(concrete = O.materials.append(CpmMat(
    young=normal_modulus,
    poisson=shear_ratio,  # CPM's name for ks / kn
    frictionAngle=internal_friction,
    sigmaT=cohesion,  # CPM's name for the cohesion
    epsCrackOnset=tensile_strength / normal_modulus,
    relDuctility=1 + softening,
    damLaw=0,  # a straight softening branch
    density=density,
    label="concrete",
)))";
  law.physics = "Ip2_CpmMat_CpmMat_CpmPhys(cohesiveThresholdIter=1)";
  law.law = "Law2_ScGeom_CpmPhys_Cpm(yieldSurfType=0, omegaThreshold=1)";
  return yade_script(request, law, std::move(lost));
}

}  // namespace exchange
