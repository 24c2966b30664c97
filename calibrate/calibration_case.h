// A calibration case: what is wanted, on which specimens, with what held fixed. `read_case` makes it from
// case.toml.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/lab/series.h"
#include "calibrate/target.h"
#include "libdem/config/toml_reader.h"
#include "libdem/core/input_file.h"
#include "libdem/core/vector.h"
#include "libdem/drive/platens.h"
#include "libdem/material/material_card.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/test_options.h"

namespace calibrate {

/// A strength parameter of the fit: held at `value`, or free to move from it between the bounds.
struct Parameter {
  double value = 0, low = 0, high = 0;
  bool free = true;
  bool given = false;  ///< the case names the value; otherwise the fit chooses where to start
};

/// How the press of one kind of test is imitated.
struct PressOptions {
  dem::EndCondition ends = dem::EndCondition::free;
  double platen_friction = 0.1;  ///< of rough platens
  double rate = 0;               ///< see UniaxialOptions; 0: its default
};

/// Another laboratory test, some of whose quantities are targets.
struct LaboratoryTest {
  std::string name;  ///< unique in the case
  virtual_tests::TestOptions options;
  std::optional<specimens::PackingOptions> packing;  ///< of specimens of its own, with the case's seeds
  std::vector<std::string> quantities;               ///< keys of those that are targets
};

struct CalibrationCase {
  std::string name;
  std::filesystem::path file;
  std::string concrete;               ///< in words, for the card and the report
  specimens::PackingOptions packing;  ///< shape and size of the specimens; the seed is set for each
  std::vector<std::uint64_t> fit_seeds, check_seeds;
  std::filesystem::path structure;  ///< if not empty, specimens are cut out of this .h5, at these centres [m]
  std::vector<dem::Vec3> fit_centres, check_centres;
  dem::MaterialCard card;  ///< density, friction angles, named choices; E and nu are the targets
  Parameter tensile_strength, cohesion, softening;  ///< T [Pa], Co [Pa], zeta [-]
  Parameter slip_softening;                         ///< zeta_s [-], of the law that transfers moments
  PressOptions tension, compression;
  double damping = 0.3;
  std::vector<Target> targets;
  std::vector<LaboratoryTest> laboratory;
  double check_tolerance = 0.06;  ///< relative, of targets on specimens that the fit never saw
  std::optional<lab::Series> tension_series, compression_series;  ///< laboratory curves, if there are any
  std::optional<lab::LabCurve> tension_reference,
      compression_reference;           ///< a code's curve, to draw beside the result
  std::vector<std::string> notes;      ///< what a reader of the card should know
  std::vector<dem::InputFile> inputs;  ///< every file that was read, for the provenance

  const Target* target(Quantity quantity) const;
};

/// Reads case.toml and the curves that it names (docs/cases.md lists the keys). Throws InputError.
CalibrationCase read_case(const std::filesystem::path& file);
/// The same of a table from elsewhere; paths in it are relative to the folder of the file that it names.
CalibrationCase case_of(const dem::TomlTable& root);

}  // namespace calibrate
