// A curve with any columns: what a laboratory test notes down over its course.
#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "specimens/virtual_tests/curve.h"

namespace virtual_tests {

struct CurveColumn {
  std::string name;  ///< as in curves.csv: "force"
  std::string unit;  ///< SI: "N", "-"
};

/// Rows of numbers, SI; every quantity of a row belongs to the same moment.
struct CurveTable {
  std::vector<CurveColumn> columns;
  std::vector<double> values;  ///< row by row

  std::size_t rows() const { return columns.empty() ? 0 : values.size() / columns.size(); }
  bool empty() const { return values.empty(); }
  double at(std::size_t row, std::size_t column) const { return values[row * columns.size() + column]; }
  /// The values of one column; empty if there is none of that name.
  std::vector<double> column(std::string_view name) const;
};

/// The curve of a uniaxial test, its columns in the order of CurvePoint.
CurveTable table_of(const Curve& curve);

/// CSV with a header that names units: "force[N]".
std::string to_csv(const CurveTable& table);

}  // namespace virtual_tests
