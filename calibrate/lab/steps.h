// The steps between the rows of a file and a clean curve. Each takes a curve and gives a new one; none reads a
// file.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace lab {

enum class Loading { compression, tension };

/// A stress-strain curve. SI units, the loading direction positive.
struct LabCurve {
  std::string file;
  Loading loading = Loading::compression;
  std::vector<double> strain;  ///< -
  std::vector<double> stress;  ///< Pa
  std::vector<double>
      post_peak_strain;  ///< -, the second strain of a file; empty if there is none or once it is joined
  std::vector<int> row;  ///< the points' lines in the file; empty once points are no rows any more
  double toe_shift = 0;  ///< - : the shift of the origin that correct_toe applied
  std::vector<std::string> notes;  ///< what the steps did, one sentence each, for the report

  std::size_t size() const { return strain.size(); }
};

/// Limits of what is accepted. Fractions "of the strain" are of the strain between the branch's first row and
/// the peak.
struct CheckOptions {
  int min_rows = 20;  ///< fewer say too little
  double strain_noise =
      0.01;  ///< a step back of the strain by more than this fraction of the strain is refused
  double unload_depth = 0.05;  ///< an unloading by more than this fraction of the strength begins a loop
  double seating = 0.02;       ///< rows before the peak below this fraction of the strength are left out
  double spike = 0.25;  ///< a highest row that exceeds its neighbours by more than this fraction is refused
  double fall_after_peak = 0.01;  ///< the stress must fall by this fraction of the strength to prove a peak ...
  double flat_at_end =
      0.25;  ///< ... or the curve must have become flatter than this fraction of its first slope
  bool may_end_at_peak = false;  ///< true: the last row may be the peak (brittle failure under force control)
  double min_strength = 0.1e6, max_strength = 300e6;      ///< Pa
  double min_peak_strain = 1e-5, max_peak_strain = 0.05;  ///< -
};

/// Bedding and toe: the straight part is extended to zero stress, and the origin moves there.
struct ToeOptions {
  bool enabled = true;
  double lower = 0.10, upper = 0.33;  ///< the straight part, as fractions of the strength
  /// A shift below this fraction of the strain at the peak is left alone: the curvature of sound concrete alone
  /// gives about half a percent, and a clean curve should pass unchanged.
  double ignore_below = 0.01;
};

/// The index of the highest stress. The curve must not be empty.
std::size_t peak_index(const LabCurve& curve);

/// The last monotonic loading and what follows it. Leaves out, with a note: cycles before it (the rows up to
/// the last unloading during which the strain went back), rows below the seating stress, and after the peak the
/// rows behind the largest strain (the machine's stop) and below zero stress. A second strain is joined
/// (join_post_peak). Throws dem::InputError if there are too few rows, the signs are wrong, or the highest row
/// is a spike.
LabCurve loading_branch(const LabCurve& curve, const CheckOptions& options = {});

/// After the peak, strain := post_peak_strain, shifted to be continuous at the peak.
LabCurve join_post_peak(const LabCurve& curve);

/// Refuses (dem::InputError, with the row) a loading branch with too few rows, whose strain goes backwards,
/// whose stress reaches no peak, or whose strength or strain at the peak is implausible, with a hint about
/// units.
void check_curve(const LabCurve& curve, const CheckOptions& options = {});

/// Strain strictly increasing: rows that step back within the noise are pooled into their mean. The peak stays.
LabCurve make_increasing(const LabCurve& curve);

/// Moves the origin (see ToeOptions) and starts the curve there; the rows of the toe give way to the straight
/// line. Throws dem::InputError if the branch has no straight part to fit.
LabCurve correct_toe(const LabCurve& curve, const ToeOptions& options = {});

}  // namespace lab
