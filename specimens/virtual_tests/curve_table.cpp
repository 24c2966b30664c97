#include "specimens/virtual_tests/curve_table.h"

#include <fmt/format.h>

namespace virtual_tests {

std::vector<double> CurveTable::column(std::string_view name) const {
  std::vector<double> found;
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].name == name)
      for (std::size_t row = 0; row < rows(); ++row) found.push_back(at(row, c));
  return found;
}

CurveTable table_of(const Curve& curve) {
  CurveTable table;
  table.columns = {{"strain", "-"},         {"stress", "Pa"}, {"strain_axial", "-"},
                   {"strain_lateral", "-"}, {"broken", "-"},  {"unbalanced", "-"}};
  for (const CurvePoint& p : curve)
    table.values.insert(table.values.end(),
                        {p.strain, p.stress, p.strain_axial, p.strain_lateral, p.broken, p.unbalanced});
  return table;
}

std::string to_csv(const CurveTable& table) {
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c)
    text += fmt::format("{}{}[{}]", c == 0 ? "" : ",", table.columns[c].name, table.columns[c].unit);
  text += "\n";
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const bool part = table.columns[c].name == "broken" || table.columns[c].name == "unbalanced";
      text +=
          fmt::format("{:.{}g}{}", table.at(row, c), part ? 6 : 9, c + 1 == table.columns.size() ? "\n" : ",");
    }
  return text;
}

}  // namespace virtual_tests
