// LAMMPS, package BPM: bond_style bpm/rotational, after the manual's page of that name.
//
// Its bond: fr = Kr (r - r0), tension positive, |fs| = Ks |slip|, bending and twisting moments Kb and Kt times
// their angles; it breaks when fr/fcr + |fs|/fcs + |tt|/tct + |tb|/tcb reaches 1. So Kr = Kn = C S_int /
// D_init, Ks = Ks, fcr = T S_int, fcs = Co S_int, Kb = k_r Kn R^2, Kt = k_t Kn R^2. LAMMPS keeps these for a
// bond type, so every link is a type of its own: exact link by link. Where bonds are broken, pair_style
// gran/hooke/history pushes with one stiffness for all pairs, that of two elements of the mean radius R which
// touch: C pi R^2 / (2 R).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>

#include "exchange/link_values.h"
#include "exchange/writers.h"

namespace exchange {
namespace {

constexpr double no_limit = 1e30;  // [N m]

std::vector<std::string> losses(const dem::MaterialCard& card) {
  std::vector<std::string> lost{fmt::format("a bond breaks at once: no softening, zeta = {} is lost, and a "
                                            "specimen's tensile strength comes out lower",
                                            card.softening),
                                fmt::format("tension and shear weaken each other, fr/(T S_int) + |fs|/(Co "
                                            "S_int) = 1 breaks the bond; by the card they do not, "
                                            "and a link in shear slides at Co S_int + Fn tan(phi_i) and holds "
                                            "on; phi_i = {:.4g} rad is lost, pressing "
                                            "strengthens a bond by Co/T instead",
                                            card.internal_friction),
                                "contacts have one stiffness, that of two elements of the mean radius; those "
                                "of broken links begin at Ra + Rb"};
  if (card.link_law == dem::LinkLawKind::moment_transfer)
    lost.emplace_back(
        fmt::format("a bond's moments have no limit and act in tension too: rolling_limit {}, twisting_limit "
                    "{} and slip_softening "
                    "{} are lost; contacts roll freely",
                    card.rolling_limit, card.twisting_limit, card.slip_softening));
  return lost;
}

constexpr const char* head = R"(# Concrete "{name}" in LAMMPS, bond_style bpm/rotational.
# Written by {writer}; for LAMMPS of 2023 or newer with the packages BPM, GRANULAR and MOLECULE: lmp -in {file}
# SI units. A link has S_int = pi min(Ra, Rb)^2 and rests at D_init.
#
# What this law does otherwise than the card:
{lost}
units si
dimension 3
boundary f f f
atom_style bpm/sphere
newton on off
comm_modify vel yes cutoff {cutoff}
special_bonds lj 0.0 1.0 1.0 coul 1.0 1.0 1.0
)";

constexpr const char* with_specimen = R"(
# elements and links, one bond type a link
read_data {data}
neighbor {skin} bin
neigh_modify delay 0 every 1 check yes

# contacts: C pi R / 2 of the mean radius {radius} m, tan(phi_c)
pair_style gran/hooke/history {contact_normal} {contact_shear} 0.0 NULL {contact_slope} 0
pair_coeff * *

# bond_coeff type Kr Ks Kt Kb fcr fcs tct tcb and four dampings
bond_style bpm/rotational smooth no
include {coefficients}

fix motion all nve/bpm/sphere
timestep {time_step}
thermo_style custom step ke bonds
run 0
)";

constexpr const char* without_specimen = R"(
# Your elements, all of about this radius, and bonds of type 1, about this long.
variable R equal 0.01
variable D equal 2.6*v_R
variable C equal {normal_modulus}
variable S equal PI*v_R*v_R
variable Kn equal v_C*v_S/v_D
variable Ks equal {shear_ratio}*v_Kn
variable Kt equal {twisting}*v_Kn*v_R*v_R
variable Kb equal {rolling}*v_Kn*v_R*v_R
variable fcr equal {tensile_strength}*v_S
variable fcs equal {cohesion}*v_S
variable contact equal 0.5*v_C*PI*v_R
variable shear equal {shear_ratio}*v_contact

# read_data yours.data: density of an element {density} kg/m3 over the solid fraction of the packing
pair_style gran/hooke/history ${{contact}} ${{shear}} 0.0 NULL {contact_slope} 0
pair_coeff * *
bond_style bpm/rotational smooth no
bond_coeff 1 ${{Kn}} ${{Ks}} ${{Kt}} ${{Kb}} ${{fcr}} ${{fcs}} {no_limit} {no_limit} 0.0 0.0 0.0 0.0
fix motion all nve/bpm/sphere
)";

std::string data_file(const Request& request, double density) {
  const specimens::Specimen& specimen = *request.specimen;
  const double margin = *std::max_element(specimen.radii.begin(), specimen.radii.end());
  std::string text = fmt::format("concrete {}, by {}\n\n{} atoms\n1 atom types\n{} bonds\n{} bond types\n\n",
                                 request.card.name, request.writer, specimen.elements(), specimen.links.size(),
                                 specimen.links.size());
  const auto out = [&text] { return std::back_inserter(text); };
  for (int axis = 0; axis < 3; ++axis)
    fmt::format_to(out(), "{} {} {}lo {}hi\n", -margin, specimen.size[axis] + margin, "xyz"[axis], "xyz"[axis]);
  text += "\nAtoms # bpm/sphere\n\n";  // id molecule type diameter density x y z
  for (std::size_t k = 0; k < specimen.elements(); ++k)
    fmt::format_to(out(), "{} 1 1 {} {} {} {} {}\n", k + 1, 2 * specimen.radii[k], density,
                   specimen.centres[k].x(), specimen.centres[k].y(), specimen.centres[k].z());
  text += "\nBonds\n\n";  // id type atom atom
  for (std::size_t k = 0; k < specimen.links.size(); ++k)
    fmt::format_to(out(), "{} {} {} {}\n", k + 1, k + 1, specimen.links[k].a + 1, specimen.links[k].b + 1);
  return text;
}

}  // namespace

Exported write_lammps_bpm(const Request& request) {
  const dem::MaterialCard& card = request.card;
  const dem::LinkLaw law = dem::make_link_law(card);
  Exported out;
  out.lost = losses(card);
  const auto begin = [&](const std::string& cutoff) {
    return fmt::format(head, fmt::arg("name", card.name), fmt::arg("writer", request.writer),
                       fmt::arg("file", request.file_name.empty() ? "FILE" : request.file_name),
                       fmt::arg("lost", comment_list(out.lost)), fmt::arg("cutoff", cutoff));
  };
  if (request.specimen == nullptr) {
    out.text = begin("0.05  # above the longest link") +
               fmt::format(without_specimen, fmt::arg("normal_modulus", law.normal_modulus),
                           fmt::arg("shear_ratio", law.shear_ratio),
                           fmt::arg("rolling", law.transfers_moments ? law.moment.rolling_stiffness : 0),
                           fmt::arg("twisting", law.transfers_moments ? law.moment.twisting_stiffness : 0),
                           fmt::arg("tensile_strength", card.tensile_strength),
                           fmt::arg("cohesion", card.cohesion), fmt::arg("density", card.density),
                           fmt::arg("contact_slope", law.contact_slope), fmt::arg("no_limit", no_limit));
    return out;
  }

  const specimens::Specimen& specimen = *request.specimen;
  const double density = card.density * density_factor(specimen);
  double longest = 0;
  std::vector<double> stiffness(specimen.elements(), 0);
  std::string coefficients;
  for (std::size_t k = 0; k < specimen.links.size(); ++k) {
    const specimens::Link& link = specimen.links[k];
    const LinkValues v = link_values(law, specimen, link);
    longest = std::max(longest, link.initial_distance);
    stiffness[static_cast<std::size_t>(link.a)] += v.normal_stiffness;
    stiffness[static_cast<std::size_t>(link.b)] += v.normal_stiffness;
    fmt::format_to(std::back_inserter(coefficients), "bond_coeff {} {} {} {} {} {} {} {} {} 0.0 0.0 0.0 0.0\n",
                   k + 1, v.normal_stiffness, v.shear_stiffness, v.twisting_stiffness, v.rolling_stiffness,
                   v.tensile_force, v.shear_force, no_limit, no_limit);
  }
  // Well below 2/omega of the highest frequency, rotations and shear included.
  double time_step = 1;
  for (std::size_t k = 0; k < specimen.elements(); ++k) {
    const double mass = density * 4. / 3 * std::numbers::pi * std::pow(specimen.radii[k], 3);
    if (stiffness[k] > 0) time_step = std::min(time_step, 0.3 * std::sqrt(mass / stiffness[k]));
  }
  const double mean_radius = std::accumulate(specimen.radii.begin(), specimen.radii.end(), 0.0) /
                             static_cast<double>(specimen.elements());
  const double contact = 0.5 * law.normal_modulus * std::numbers::pi * mean_radius;
  const std::string data = companion_name(request.file_name, ".data");
  const std::string bonds = companion_name(request.file_name, ".bonds");
  out.text =
      begin(fmt::format("{:.6g}", 1.1 * longest)) +
      fmt::format(
          with_specimen, fmt::arg("data", data), fmt::arg("skin", fmt::format("{:.6g}", 0.2 * mean_radius)),
          fmt::arg("radius", fmt::format("{:.4g}", mean_radius)), fmt::arg("contact_normal", contact),
          fmt::arg("contact_shear", law.shear_ratio * contact), fmt::arg("contact_slope", law.contact_slope),
          fmt::arg("coefficients", bonds), fmt::arg("time_step", fmt::format("{:.4g}", time_step)));
  out.beside.push_back({data, data_file(request, density)});
  out.beside.push_back({bonds, std::move(coefficients)});
  return out;
}

}  // namespace exchange
