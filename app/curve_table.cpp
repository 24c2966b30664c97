#include "app/curve_table.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace app {
namespace {

using Row = std::vector<std::string>;

std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::vector<Row> rows;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// A header such as "stress[Pa]", with the unit that people read and the factor into it.
struct Header {
  std::string name, unit;
  double factor = 1;
};

Header header_of(const std::string& text) {
  Header header{text, "", 1};
  if (const auto bracket = text.find('['); bracket != std::string::npos) {
    header.name = text.substr(0, bracket);
    header.unit = text.substr(bracket + 1, text.find(']') - bracket - 1);
  }
  if (header.unit == "Pa") return {header.name, "MPa", 1e-6};
  if (header.unit == "N") return {header.name, "kN", 1e-3};
  if (header.unit == "m") return {header.name, "mm", 1e3};
  if (header.unit == "-")
    return header.name.rfind("strain", 0) == 0 ? Header{header.name, "‰", 1e3} : Header{header.name, "", 1};
  return header;
}

double number(const Row& row, std::size_t column) {
  if (column >= row.size()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(row[column].c_str(), &end);
  return end == row[column].c_str() ? std::numeric_limits<double>::quiet_NaN() : value;
}

}  // namespace

std::vector<TestCurve> read_test_curves(const std::filesystem::path& file) {
  const std::vector<Row> rows = read_rows(file);
  std::vector<TestCurve> curves;
  if (rows.empty() || rows.front() != Row{"test", "curve", "kind", "strain[-]", "stress[Pa]"}) return curves;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const Row& row = rows[r];
    if (row.size() < 5) continue;
    if (curves.empty() || curves.back().test != row[0] || curves.back().name != row[1] ||
        curves.back().kind != row[2])
      curves.push_back({row[0], row[1], row[2], {}, {}});
    curves.back().strain.push_back(1e3 * number(row, 3));
    curves.back().stress.push_back(1e-6 * number(row, 4));
  }
  return curves;
}

std::vector<Column> read_columns(const std::filesystem::path& file) {
  const std::vector<Row> rows = read_rows(file);
  std::vector<Column> columns;
  if (rows.size() < 2) return columns;
  for (std::size_t k = 0; k < rows.front().size(); ++k) {
    const Header header = header_of(rows.front()[k]);
    columns.push_back({header.name, header.unit, {}});
    for (std::size_t r = 1; r < rows.size(); ++r)
      columns.back().values.push_back(header.factor * number(rows[r], k));
  }
  return columns;
}

std::vector<report::Chart> charts_of(const std::vector<Column>& columns) {
  std::vector<report::Chart> charts;
  for (std::size_t k = 1; k < columns.size(); ++k) {
    auto chart = std::find_if(charts.begin(), charts.end(),
                              [&](const report::Chart& c) { return c.y.unit == columns[k].unit; });
    if (chart == charts.end()) {
      report::Chart fresh;
      fresh.x = {columns[0].name, columns[0].unit, false, {}, {}};
      fresh.y.unit = columns[k].unit;
      charts.push_back(std::move(fresh));
      chart = std::prev(charts.end());
    }
    chart->y.title += (chart->y.title.empty() ? "" : ", ") + columns[k].name;
    chart->title = chart->y.title + " over " + columns[0].name;
    report::Series series;
    series.name = columns[k].name;
    series.x = columns[0].values;
    series.y = columns[k].values;
    chart->series.push_back(std::move(series));
  }
  return charts;
}

}  // namespace app
