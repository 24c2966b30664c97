// Formulas that engineers use for hard missiles on concrete, to print beside a run: modified NDRC and CEA-EDF.
//
// Both are fits to tests of rigid missiles at normal incidence on walls. Sources:
//   [1] R.P. Kennedy, A review of procedures for the analysis and design of concrete structures to resist
//   missile
//       impact effects, Nuclear Engineering and Design 37 (1976) 183-203
//   [2] Q.M. Li, S.R. Reid, H.M. Wen, A.R. Telford, Local impact effects of hard missiles on concrete targets,
//       International Journal of Impact Engineering 32 (2005) 224-284: the SI forms
//   [3] C. Berriaud, A. Sokolovsky, R. Gueraud, J. Dulac, R. Labrot, Comportement local des enceintes en beton
//   sous
//       l'impact d'un projectile rigide, Nuclear Engineering and Design 45 (1978) 457-469
//   [4] DOE-STD-3014, Accident analysis for aircraft crash into hazardous facilities, appendix C: the ranges of
//   [1]
#pragma once
#include <string>
#include <vector>

namespace impact {

/// A hard missile and the wall that it strikes.
struct MissileCase {
  double mass = 0;      ///< M [kg]
  double velocity = 0;  ///< V, normal to the wall [m/s]
  /// d [m]. Of a missile that is not round: NDRC takes the diameter of equal cross-section area, CEA-EDF that
  /// of equal perimeter. The two functions are given the one that they need.
  double diameter = 0;
  double compressive_strength = 0;  ///< f_c of the concrete, cylinder [Pa]
  double density = 0;               ///< rho of the concrete; CEA-EDF only [kg/m3]
  double thickness = 0;             ///< e of the wall [m]
  double nose_factor = 1;           ///< N of NDRC, see below [-]
};

/// N: how sharp the nose is.
inline constexpr double flat_nose = 0.72, hemispherical_nose = 0.84, spherical_nose = 1.0, sharp_nose = 1.14;

/// A quantity that a formula was fitted to within bounds.
struct ValidityRange {
  std::string quantity;  ///< such as "e/d" or "V [m/s]"
  double low = 0, high = 0;
  double value = 0;  ///< of the case at hand
  std::string source;

  bool holds() const { return value >= low && value <= high; }
};

/// Whether the case lies in all ranges of the formula.
bool applies(const std::vector<ValidityRange>& ranges);

struct NdrcResult {
  double impact_function = 0;        ///< G [-]
  double penetration_depth = 0;      ///< x into a very thick wall [m]
  double perforation_thickness = 0;  ///< e that is just perforated [m]
  double scabbing_thickness = 0;     ///< h_s that just scabs [m]
  std::vector<ValidityRange> perforation_ranges, scabbing_ranges;

  bool perforates(double thickness) const { return thickness < perforation_thickness; }
  bool scabs(double thickness) const { return thickness < scabbing_thickness; }
};

/// Modified NDRC [1], in the SI form of [2]:
///   G = 3.8e-5 N M / (d sqrt(f_c)) (V/d)^1.8;  x/d = 2 sqrt(G) if G <= 1, else G + 1
///   e/d = 3.19 (x/d) - 0.718 (x/d)^2 if x/d <= 1.35, else 1.32 + 1.24 (x/d)
///   h_s/d = 7.91 (x/d) - 5.06 (x/d)^2 if x/d <= 0.65, else 2.12 + 1.36 (x/d)
/// Throws InputError that names `where` if a quantity that it needs is not positive and finite.
NdrcResult modified_ndrc(const MissileCase& missile, const std::string& where);

struct CeaEdfResult {
  double perforation_velocity = 0;   ///< V_p that just perforates the given thickness [m/s]
  double perforation_thickness = 0;  ///< e that is just perforated at the given velocity [m]
  std::vector<ValidityRange> ranges;

  bool perforates(double velocity) const { return velocity > perforation_velocity; }
};

/// CEA-EDF [3] for flat-nosed missiles: V_p = 1.3 rho^(1/6) f_c^(1/2) (d e^2 / M)^(2/3), in SI units; the
/// thickness is its inverse, the e/d = 0.82 M^(1/2) V^(3/4) / (rho^(1/8) f_c^(3/8) d^(3/2)) of [2] with 0.82 =
/// 1.3^(-3/4). The ranges are those usually quoted with it; they were not compared with [3] itself. Throws
/// InputError that names `where` if a quantity that it needs is not positive and finite.
CeaEdfResult cea_edf(const MissileCase& missile, const std::string& where);

}  // namespace impact
