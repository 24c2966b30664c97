// The material card: everything that a discrete-element concrete needs to know about itself. Calibration writes
// it, virtual tests and impacts read it unchanged.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "libdem/core/units.h"

namespace dem {

/// The law of a pair: the paper's, in which elements roll freely, or the one that transfers moments.
enum class LinkLawKind { paper, moment_transfer };
/// How a link unloads from the softening branch: towards the origin, or parallel to the elastic loading.
enum class SofteningUnloading { secant, elastic };
/// Whether the link's cohesion (Co) stays whole until the link breaks, or shrinks with its remaining tensile
/// strength.
enum class CohesionDuringSoftening { constant, proportional };
/// The distance below which the two elements of a broken link push on each other: D_init, or Ra + Rb.
enum class BrokenLinkContact { initial_distance, radii };

/// Parameters of the paper's model. SI units; angles in radians; compression positive.
struct MaterialCard {
  std::string name = "unnamed";
  double young_modulus = 30e9;                     ///< E [Pa], macroscopic
  double poisson_ratio = 0.2;                      ///< nu [-], macroscopic, must stay below 1/alpha
  double density = 2400;                           ///< mass per volume of the concrete [kg/m3]
  double tensile_strength = 3.1e6;                 ///< T [Pa], of a link, local
  double cohesion = 3.6e6;                         ///< Co [Pa], of a link, local
  double softening = 5;                            ///< zeta [-]: the softening slope is -Kn/zeta
  double internal_friction = 0.10471975511965978;  ///< phi_i [rad], of an intact link (6 degrees in the paper)
  double contact_friction = 0.10471975511965978;   ///< phi_c [rad], of a broken link or a new contact
  double alpha = 3.7;                              ///< Eq. 1, Eq. 3 [-]
  double beta = 2.198;                             ///< Eq. 1, Eq. 3 [-]
  double gamma = 3.79;                             ///< Eq. 1, Eq. 3 [-]
  LinkLawKind link_law = LinkLawKind::paper;
  // The law that transfers moments (libdem/law/moment_transfer.h); without effect in the paper's.
  double slip_softening = 0;        ///< zeta_s [-]: cohesion is gone at a slip of zeta_s Co S_int/Ks; 0: never
  double rolling_stiffness = 0.25;  ///< k_r [-]: rolling stiffness over Kn R^2
  double rolling_limit = 0.5;       ///< eta_r [-]: rolling moment at most eta_r R F_n
  double twisting_stiffness = 0;    ///< k_t [-]: the same about the link's own axis
  double twisting_limit = 0;        ///< eta_t [-]
  SofteningUnloading unloading = SofteningUnloading::secant;
  CohesionDuringSoftening cohesion_during_softening = CohesionDuringSoftening::constant;
  BrokenLinkContact broken_link_contact = BrokenLinkContact::initial_distance;
  /// Where the card comes from and how well it fits: free text by key, kept in order, carried through
  /// unchanged.
  std::vector<std::pair<std::string, std::string>> provenance;

  /// Throws InputError that names the key and the violated bound; `where` is the file or the object that holds
  /// the card.
  void validate(const std::string& where) const;
};

/// Reads card.toml. Throws InputError (unknown or missing key, wrong unit, bound violated).
MaterialCard read_card(const std::filesystem::path& file);
/// The text of card.toml, with units and comments; reading it back gives the same bits.
std::string to_toml(const MaterialCard& card);

/// One number of a card: its key in card.toml, its SI value, what kind of quantity it is and what it means.
struct CardNumber {
  std::string_view key;
  double value;
  Quantity kind;
  std::string_view meaning;
};
/// All the numbers that the card's law uses, in the order of card.toml: for listings, exporters and hashes.
std::vector<CardNumber> numbers_of(const MaterialCard& card);

/// All its named choices, key and value, in the order of card.toml.
std::vector<std::pair<std::string_view, std::string_view>> choices_of(const MaterialCard& card);
/// Everything that physics depends on, to the last bit: what hashes are made of.
std::string identity_text(const MaterialCard& card);

std::string_view name_of(LinkLawKind choice);
std::string_view name_of(SofteningUnloading choice);
std::string_view name_of(CohesionDuringSoftening choice);
std::string_view name_of(BrokenLinkContact choice);

}  // namespace dem
