#include "exchange/yade.h"

#include <fmt/format.h>

#include <iterator>

#include "exchange/link_rule.h"
#include "exchange/writers.h"
#include "libdem/law/cohesive_link.h"

namespace exchange {
namespace {

constexpr const char* head = R"(# Concrete "{name}" in Yade, {title}.
# Written by {writer}; for Yade 2023.02a or newer: yade -n -x {file}
# SI units. C and the ratio are Eq. 1 of the card; a link has S_int = pi min(Ra, Rb)^2 and rests at D_init.
#
# What this law does otherwise than the card:
{lost}
import math
{imports}
normal_modulus = {normal_modulus}  # C = Kn D_init / S_int [Pa]
shear_ratio = {shear_ratio}  # Ks / Kn [-]
tensile_strength = {tensile_strength}  # T [Pa]
cohesion = {cohesion}  # Co [Pa]
softening = {softening}  # zeta [-]
internal_friction = {internal_friction}  # phi_i [rad]
contact_friction = {contact_friction}  # phi_c [rad]
{density}
{factor}

{material}

detection = Ig2_Sphere_Sphere_ScGeom(avoidGranularRatcheting=False)  # slip at the contact point itself (Eq. 2)
boxes = Bo1_Sphere_Aabb()
O.engines = [
    ForceResetter(),
    InsertionSortCollider([boxes]),
    InteractionLoop([detection], [{physics}], [{law}]),
    NewtonIntegrator(damping=0.4, label="newton"),
]


def make_links():
    """Links the elements that are there, at rest where they are. Call it once, before any other step; gives their number."""
    detection.interactionDetectionFactor = boxes.aabbEnlargeFactor = interaction_factor
    O.dt = 0.3 * PWaveTimeStep()
    O.step()
    detection.interactionDetectionFactor = boxes.aabbEnlargeFactor = 1
    links = [link for link in O.interactions if link.isReal and link.phys.isCohesive]
{stiffness}    return len(links)
)";

constexpr const char* with_specimen = R"(

# The elements, x y z radius in metres, lie beside this file.
O.bodies.append(ymport.text(os.path.join(os.path.dirname(os.path.abspath(__file__)), "{spheres}"), material=concrete))
links = make_links()
if links != {links}:
    raise RuntimeError("Yade made %d links, the specimen has {links}" % links)
print("specimen of %d elements and %d links" % (len(O.bodies), links))
)";

constexpr const char* without_specimen = R"(

# Append your spheres with material=concrete, then: make_links()
)";

std::string spheres_of(const specimens::Specimen& specimen) {
  std::string text = "# x y z radius [m]\n";
  for (std::size_t k = 0; k < specimen.elements(); ++k)
    fmt::format_to(std::back_inserter(text), "{} {} {} {}\n", specimen.centres[k].x(), specimen.centres[k].y(),
                   specimen.centres[k].z(), specimen.radii[k]);
  return text;
}

}  // namespace

void add_common_losses(const dem::MaterialCard& card, std::vector<std::string>& lost) {
  if (card.broken_link_contact == dem::BrokenLinkContact::initial_distance)
    lost.emplace_back(
        "a link that broke in tension is taken away: its elements push on each other again where the spheres "
        "touch "
        "(Ra + Rb), without force at first; the card lets them push below D_init");
  else
    lost.emplace_back("a new contact begins without force where Yade first finds the spheres overlapping");
  if (card.link_law == dem::LinkLawKind::moment_transfer)
    lost.emplace_back(fmt::format(
        "elements roll and twist freely: rolling_stiffness {}, rolling_limit {}, twisting_stiffness {}, "
        "twisting_limit "
        "{} and slip_softening {} have no counterpart, and compressive strength comes out far too low",
        card.rolling_stiffness, card.rolling_limit, card.twisting_stiffness, card.twisting_limit,
        card.slip_softening));
}

Exported yade_script(const Request& request, const YadeLaw& yade, std::vector<std::string> lost) {
  const dem::MaterialCard& card = request.card;
  const dem::LinkLaw link = dem::make_link_law(card);
  const specimens::Specimen* specimen = request.specimen;
  Exported out;
  out.lost = std::move(lost);
  const std::string density =
      specimen != nullptr
          ? fmt::format("density = {}  # of a sphere: the specimen weighs {} kg/m3, the voids included [kg/m3]",
                        card.density * density_factor(*specimen), card.density)
          : fmt::format(
                "solid_fraction = 0.42  # of your packing, here that of Spall's: the spheres carry the "
                "concrete's {0} kg/m3 [-]\n"
                "density = {0} / solid_fraction  # of a sphere [kg/m3]",
                card.density);
  const std::string factor =
      specimen != nullptr
          ? fmt::format("interaction_factor = {}  # links join centres within so many Ra + Rb [-]",
                        interaction_factor(*specimen))
          : "interaction_factor = 1.5  # tune it until an element inside has 12 links on average, as the card "
            "takes it [-]";
  out.text = fmt::format(
      head, fmt::arg("name", card.name), fmt::arg("title", yade.title), fmt::arg("writer", request.writer),
      fmt::arg("file", request.file_name.empty() ? "FILE" : request.file_name),
      fmt::arg("lost", comment_list(out.lost)),
      fmt::arg("imports", specimen != nullptr ? "import os\n\nfrom yade import ymport\n" : ""),
      fmt::arg("normal_modulus", link.normal_modulus), fmt::arg("shear_ratio", link.shear_ratio),
      fmt::arg("tensile_strength", card.tensile_strength), fmt::arg("cohesion", card.cohesion),
      fmt::arg("softening", card.softening), fmt::arg("internal_friction", card.internal_friction),
      fmt::arg("contact_friction", card.contact_friction), fmt::arg("density", density),
      fmt::arg("factor", factor), fmt::arg("material", yade.material), fmt::arg("physics", yade.physics),
      fmt::arg("law", yade.law), fmt::arg("stiffness", yade.stiffness));
  if (specimen == nullptr) {
    out.text += without_specimen;
    return out;
  }
  const std::string spheres = companion_name(request.file_name, ".spheres");
  out.text +=
      fmt::format(with_specimen, fmt::arg("spheres", spheres), fmt::arg("links", specimen->links.size()));
  out.beside.push_back({spheres, spheres_of(*specimen)});
  return out;
}

}  // namespace exchange
