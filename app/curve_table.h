// Curves in the CSV files that a run leaves, for the charts of its page.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "report/page.h"

namespace app {

/// One curve of a table with the columns test, curve, kind, strain[-], stress[Pa].
struct TestCurve {
  std::string test, name, kind;
  std::vector<double> strain, stress;  ///< permil, MPa
};
/// Curves in the order of the file; empty if the file is another kind of table, or is not there.
std::vector<TestCurve> read_test_curves(const std::filesystem::path& file);

/// One column of a table of numbers, in the unit that people read: Pa as MPa, strains as permil.
struct Column {
  std::string name, unit;
  std::vector<double> values;  ///< NaN where a cell is no number
};
std::vector<Column> read_columns(const std::filesystem::path& file);

/// Each column over the first, those of one unit in one chart.
std::vector<report::Chart> charts_of(const std::vector<Column>& columns);

}  // namespace app
