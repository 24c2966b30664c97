// The rooms of read_case: what it asks of the targets and of the specimens. Only the case_*.cpp files include
// it.
#pragma once
#include <string>

#include "calibrate/calibration_case.h"
#include "libdem/config/toml_reader.h"

namespace calibrate {

// case_targets.cpp

/// [targets] without its tolerances: the given values, within the bounds of what can be meant.
void read_targets(const dem::TomlTable& targets, CalibrationCase& result);
/// What the curves of one test say. Values that are given stay; one that is far from the curves is refused.
void add_series_targets(CalibrationCase& result, const lab::Series& series, bool tension, bool with_curve);
/// [code]: fills in the targets that are neither given nor measured.
void read_code(const dem::TomlTable& code, CalibrationCase& result);
/// 0.2 of EN 1992-1-1 if nobody says what nu is, with a note.
void default_poisson_ratio(CalibrationCase& result);
/// [targets.tolerance], once all targets are known.
void read_tolerances(const dem::TomlTable& targets, CalibrationCase& result);
/// Targets that are missing, or that no concrete can meet together, are refused before a minute is spent on
/// them.
void refuse_impossible_targets(const CalibrationCase& result);

// case_laboratory.cpp

/// [[test]]: other laboratory tests and their targets. Once [specimen] is read.
void read_laboratory_tests(const dem::TomlTable& root, CalibrationCase& result);

// case_specimens.cpp

/// [specimen]: packed from seeds, or cut out of a structure (which is read and cut once here, so that whatever
/// is wrong with it is told before anything is computed or written).
void read_specimens(const dem::TomlTable& specimen, CalibrationCase& result);
/// shape, size, elements and size_ratio of a packing, checked.
specimens::PackingOptions read_packing(const dem::TomlTable& table);

}  // namespace calibrate
