// Targets from codes, for a concrete of which nobody has curves: EN 1992-1-1:2004 and fib Model Code 2010, mean
// values of normal-weight concrete under short-term uniaxial load. Each number says where it comes from.
#pragma once
#include <string>
#include <string_view>

#include "calibrate/lab/curve.h"

namespace lab {

enum class Code { eurocode2_2004, model_code_2010 };

/// What the coarse aggregate is made of; it scales the modulus (Model Code 2010, Table 5.1-6; EN
/// 1992-1-1, 3.1.3(2)).
enum class Aggregate { basalt, quartzite, limestone, sandstone };

Code parse_code(std::string_view text, const std::string& where);  ///< "eurocode2_2004", "model_code_2010"
Aggregate parse_aggregate(std::string_view text,
                          const std::string& where);  ///< "basalt", ... Both throw dem::InputError
std::string_view to_text(Code code);
std::string_view to_text(Aggregate aggregate);

/// A number from a code, in SI units, with its source: "fib Model Code 2010, 5.1-3a, fck = 40 MPa".
struct CodeTarget {
  double value = 0;
  std::string source;
};

/// What a code says about one concrete. A target without a source ("") is one that the code does not give.
struct CodeConcrete {
  Code code = Code::model_code_2010;
  Aggregate aggregate = Aggregate::quartzite;
  double fck = 0;                     ///< Pa, characteristic strength of cylinders
  CodeTarget fcm;                     ///< Pa, mean compressive strength
  CodeTarget fctm;                    ///< Pa, mean tensile strength
  CodeTarget E_initial;               ///< Pa: Eci (Model Code), 1.05 Ecm (Eurocode): the tangent at the origin
  CodeTarget E_secant;                ///< Pa: reduced Ec (Model Code), Ecm (Eurocode: secant from 0 to 0.4 fcm)
  CodeTarget nu;                      ///< -
  CodeTarget strain_at_peak;          ///< - : eps_c1
  CodeTarget strain_limit;            ///< - : eps_c,lim, eps_cu1: where the compression curve ends
  CodeTarget k;                       ///< - : plasticity number of the compression curve
  CodeTarget tension_strain_at_peak;  ///< - : Model Code only
  CodeTarget fracture_energy;         ///< N/m : Model Code only
  LabCurve compression;               ///< 0 to strain_limit, its peak on a point; `file` holds the source
  LabCurve tension;        ///< 0 to the tensile strength; Eurocode: straight to the strength, at E_initial
  OpeningCurve softening;  ///< after the tensile strength; Model Code only, else empty
};

/// The characteristic strength in Pa from "C40/50", "C40" or a quantity ("40 MPa"). Throws dem::InputError,
/// prefixed by `where`, if it is none of these or the cube strength does not belong to the cylinder strength.
double parse_strength_class(std::string_view text, const std::string& where);

/// All targets. fck in Pa: 12 to 90 MPa (Eurocode), 12 to 120 MPa (Model Code). `points_to_peak` as in
/// ResampleOptions. Throws dem::InputError outside that range, and if the aggregate leaves no curve (k not
/// above 1).
CodeConcrete code_concrete(Code code, double fck, Aggregate aggregate = Aggregate::quartzite,
                           int points_to_peak = 100);

/// Stress over strength of both codes' compression curve: (k eta - eta^2) / (1 + (k - 2) eta), eta = strain /
/// eps_c1 (EN 1992-1-1, 3.14; Model Code 2010, 5.1-26).
double sargin(double eta, double k);

}  // namespace lab
