#include "app/curve_table.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

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
struct Column {
  std::string name, unit;
  double factor = 1;
};

Column column_of(const std::string& header) {
  Column column{header, "", 1};
  if (const auto bracket = header.find('['); bracket != std::string::npos) {
    column.name = header.substr(0, bracket);
    column.unit = header.substr(bracket + 1, header.find(']') - bracket - 1);
  }
  if (column.unit == "Pa") return {column.name, "MPa", 1e-6};
  if (column.unit == "-")
    return column.name.rfind("strain", 0) == 0 ? Column{column.name, "permil", 1e3}
                                               : Column{column.name, "", 1};
  return column;
}

double number(const Row& row, std::size_t column) {
  if (column >= row.size()) return std::numeric_limits<double>::quiet_NaN();
  char* end = nullptr;
  const double value = std::strtod(row[column].c_str(), &end);
  return end == row[column].c_str() ? std::numeric_limits<double>::quiet_NaN() : value;
}

report::Axis axis(const Column& column) { return {column.name, column.unit, false, {}, {}}; }

std::vector<report::Chart> charts_of_columns(const std::vector<Row>& rows) {
  std::vector<Column> columns;
  for (const std::string& header : rows.front()) columns.push_back(column_of(header));
  std::vector<report::Chart> charts;
  for (std::size_t k = 1; k < columns.size(); ++k) {
    // Columns of one unit share a chart.
    auto chart = std::find_if(charts.begin(), charts.end(),
                              [&](const report::Chart& c) { return c.y.unit == columns[k].unit; });
    if (chart == charts.end()) {
      charts.push_back({"", axis(columns[0]), {"", columns[k].unit, false, {}, {}}, {}, ""});
      chart = std::prev(charts.end());
    }
    chart->y.title += (chart->y.title.empty() ? "" : ", ") + columns[k].name;
    chart->title = chart->y.title + " over " + columns[0].name;
    report::Series series;
    series.name = columns[k].name;
    for (std::size_t r = 1; r < rows.size(); ++r) {
      series.x.push_back(columns[0].factor * number(rows[r], 0));
      series.y.push_back(columns[k].factor * number(rows[r], k));
    }
    chart->series.push_back(std::move(series));
  }
  return charts;
}

std::vector<report::Chart> charts_of_tests(const std::vector<Row>& rows) {
  const Column x = column_of(rows.front()[3]), y = column_of(rows.front()[4]);
  std::vector<report::Chart> charts;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const Row& row = rows[r];
    if (row.size() < 5) continue;
    if (charts.empty() || charts.back().title != row[0]) {
      const auto known =
          std::find_if(charts.begin(), charts.end(), [&](const report::Chart& c) { return c.title == row[0]; });
      if (known == charts.end())
        charts.push_back({row[0], axis(x), axis(y), {}, ""});
      else
        std::rotate(known, known + 1, charts.end());
    }
    std::vector<report::Series>& all = charts.back().series;
    if (all.empty() || all.back().name != row[1]) {
      report::Series series;
      series.name = row[1];
      // One colour a kind: what counts is virtual against laboratory, not which seed.
      series.colour = row[2] == "fitted" ? 0 : row[2] == "unseen" ? 1 : row[2] == "laboratory" ? 2 : 3;
      series.kind =
          row[2] == "unseen" || row[2] == "code" ? report::Series::Kind::dashed : report::Series::Kind::line;
      all.push_back(std::move(series));
    }
    all.back().x.push_back(x.factor * number(row, 3));
    all.back().y.push_back(y.factor * number(row, 4));
  }
  return charts;
}

}  // namespace

std::vector<report::Chart> read_charts(const std::filesystem::path& file) {
  const std::vector<Row> rows = read_rows(file);
  if (rows.size() < 2) return {};
  const bool by_test = rows.front().size() == 5 && rows.front()[0] == "test";
  return by_test ? charts_of_tests(rows) : charts_of_columns(rows);
}

}  // namespace app
