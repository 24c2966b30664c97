// Laboratory curves: from a CSV file to a stress-strain curve that a fit can trust. Inside, SI units, and the
// direction of loading positive: shortening and compression in a compression test, elongation and tension in a
// tension test.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/lab/csv.h"
#include "calibrate/lab/smooth.h"
#include "calibrate/lab/steps.h"

namespace lab {

/// Which sign the file gives to what. tension_positive and negative_is_compression say the same of a file; each
/// is the natural word for one kind of test. In a tension test with compression_positive the values are turned
/// round.
enum class SignConvention { compression_positive, tension_positive, negative_is_compression };

/// "compression" or "tension"; "compression_positive", ... Throw dem::InputError, prefixed by `where`, with the
/// nearest.
Loading parse_loading(std::string_view text, const std::string& where);
SignConvention parse_sign_convention(std::string_view text, const std::string& where);
std::string_view to_text(Loading loading);
std::string_view to_text(SignConvention sign);

/// Keeps the rows whose cell in `column` equals `value`, e.g. phase = 1.
struct RowFilter {
  std::string column;
  double value = 0;
};

/// Where a curve is in its files, and what its columns mean. Columns are named without their unit or by the
/// whole header.
struct CurveSpec {
  std::vector<std::filesystem::path> files;  ///< one file per specimen
  Loading loading = Loading::compression;
  SignConvention sign = SignConvention::compression_positive;
  std::optional<SignConvention> strain_sign;  ///< only if the strain has another sign than the stress
  std::string strain_column = "strain";
  std::string stress_column = "stress";
  std::string strain_unit;  ///< when the header has none; a strain without any unit is taken as "-"
  std::string stress_unit;  ///< when the header has none
  /// The strain that drives after the peak, joined so that it is continuous there. Gauges on the specimen lose
  /// their meaning once a crack runs through or past them. Empty: the strain column drives throughout.
  std::string post_peak_strain_column;
  /// The length over which a displacement was measured, m. With it a strain column may hold a length (mm).
  double gauge_length = 0;
  double post_peak_gauge_length = 0;
  std::optional<RowFilter> only_rows;
  CsvOptions csv;
};

/// The options of all steps.
struct CurveOptions {
  CheckOptions check;
  ToeOptions toe;
  SmoothOptions smooth;
  ResampleOptions resample;
};

/// Throws dem::InputError, prefixed by `where`, that names the first option out of its bounds. prepare_curve
/// calls it.
void validate(const CurveOptions& options, const std::string& where = "curve options");

/// Stress against crack opening, for tension after the peak.
struct OpeningCurve {
  std::string file;
  std::vector<double> opening;  ///< m, increasing
  std::vector<double> stress;   ///< Pa, tension positive
};

/// Reads the rows as they are: in SI units and the loading direction positive, not yet checked. Throws
/// dem::InputError for all that read_csv, find_column and numbers refuse, for a unit that is no stress or
/// strain, and for a filter that keeps no row.
LabCurve read_curve(const std::filesystem::path& file, const CurveSpec& spec);

/// All steps in their order: read_curve, loading_branch, check_curve, make_increasing, correct_toe, smooth,
/// resample. The result starts at the origin, is uniform in strain and has its peak on a point. Throws
/// dem::InputError.
LabCurve prepare_curve(const std::filesystem::path& file, const CurveSpec& spec,
                       const CurveOptions& options = {});

/// Reads a tension curve against opening (strain_column names the opening, a length; it must not go backwards
/// by more than 1% of its range). Throws dem::InputError.
OpeningCurve read_opening_curve(const std::filesystem::path& file, const CurveSpec& spec);

/// The factor from a unit of strain to 1: "-", "%", "permil", "‰", "um/m", "microstrain", "mm/m", "mm/100mm",
/// ... and from a unit of stress to Pa: "MPa", "N/mm2", "psi", ... Throw dem::InputError, prefixed by `where`.
double strain_factor(std::string_view unit, const std::string& where);
double stress_factor(std::string_view unit, const std::string& where);

}  // namespace lab
