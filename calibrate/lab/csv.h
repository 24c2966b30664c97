// A careful reader of the CSV tables that laboratories export. A table that is wrong in any way is refused with
// the file, the row (its line in the file, from 1) and the column; nothing is skipped or guessed in silence.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace lab {

/// A column's header taken apart: "stress[MPa]", "stress (MPa)" and "stress / MPa" all have name "stress", unit
/// "MPa".
struct CsvColumn {
  std::string name;    ///< without the unit
  std::string unit;    ///< as written; empty when the header has none
  std::string header;  ///< the whole header cell
};

/// The cells as text, so that a column that nobody asks for may hold anything.
struct CsvTable {
  std::string file;
  char separator = ',';
  std::vector<CsvColumn> columns;
  std::vector<std::vector<std::string>> cells;  ///< [row][column], as many columns in every row
  std::vector<int> line;                        ///< [row]: its line in the file, from 1

  std::size_t rows() const { return cells.size(); }
};

/// How to read a table. The defaults suit most exports.
struct CsvOptions {
  char separator = 0;  ///< ',', ';' or a tab; 0: detected
  char comment = '#';  ///< lines that start with it are left out
};

/// Reads a table: UTF-8 (with or without a byte order mark) or Latin-1, any line ending, quoted cells,
/// comments, blank lines, Excel's "sep=;" line, units in the header or in a row of their own below it. Throws
/// dem::InputError if the file cannot be read, is empty, has no header or nothing but a header, or if a row has
/// more or fewer cells than the header.
CsvTable read_csv(const std::filesystem::path& file, const CsvOptions& options = {});
/// The same of a table in memory; `name` stands for the file in messages.
CsvTable parse_csv(std::string text, const std::string& name, const CsvOptions& options = {});

/// The column called `name` (the name without the unit, or the whole header). Throws dem::InputError, with the
/// nearest names and all that there are, if it is missing or there are several.
std::size_t find_column(const CsvTable& table, std::string_view name);

/// One cell as a number; a decimal comma is understood. Throws dem::InputError if it is empty, text, NaN or
/// infinite.
double number_at(const CsvTable& table, std::size_t row, std::size_t column);

/// A whole column as numbers, in the unit of the file. Throws as number_at does, and also if some of the
/// numbers have a decimal comma and others a decimal point: one of the two must then separate thousands.
std::vector<double> numbers(const CsvTable& table, std::size_t column);

/// Up to `count` of the candidates, the most alike first; those that are not alike at all are left out.
std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& candidates,
                                       std::size_t count = 3);

}  // namespace lab
