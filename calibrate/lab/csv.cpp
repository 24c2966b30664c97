#include "calibrate/lab/csv.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "libdem/core/error.h"
#include "libdem/core/input_file.h"

namespace lab {
namespace {

using dem::InputError;

struct Line {
  std::string text;
  int number = 0;
};

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

bool is_utf8(const std::string& text) {
  for (std::size_t k = 0; k < text.size();) {
    const auto byte = static_cast<unsigned char>(text[k]);
    const std::size_t length = byte < 0x80 ? 1 : byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : byte >= 0xC2 ? 2 : 0;
    if (length == 0 || k + length > text.size()) return false;
    for (std::size_t j = 1; j < length; ++j)
      if ((static_cast<unsigned char>(text[k + j]) & 0xC0) != 0x80) return false;
    k += length;
  }
  return true;
}

/// Testing machines write Latin-1 (Windows-1252) more often than not: the micro sign, the permil sign, umlauts.
std::string from_latin1(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      result += c;
    } else if (byte == 0x89) {
      result += "\u2030";
    } else {
      result += static_cast<char>(0xC0 | (byte >> 6));
      result += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return result;
}

std::string read_text(const std::filesystem::path& path) {
  const std::string file = path.string();
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) throw InputError(file, "is a folder", "name a CSV file");
  constexpr std::size_t most = std::size_t{1} << 30;
  return dem::content_of_input(path, most, "name a CSV file that you may read");
}

/// Without a byte order mark, and UTF-8 whatever it was.
std::string decoded(std::string text, const std::string& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF") || text.find('\0') != std::string::npos)
    throw InputError(file, "is UTF-16 or no text at all", "save it as CSV in UTF-8");
  return is_utf8(text) ? std::move(text) : from_latin1(text);
}

/// Lines with their numbers; comments and blank lines are left out.
std::vector<Line> split_lines(const std::string& text, char comment) {
  std::vector<Line> lines;
  int number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
    ++number;
    std::string line = text.substr(begin, end - begin);
    begin = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    const std::string content = trimmed(line);
    if (!content.empty() && content.front() != comment) lines.push_back({std::move(line), number});
  }
  return lines;
}

/// The cells of one line. A quoted cell may hold the separator, and quotes if they are doubled.
std::vector<std::string> split_cells(const Line& line, char separator, const std::string& file) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t k = 0; k < line.text.size(); ++k) {
    const char c = line.text[k];
    if (quoted) {
      if (c != '"') {
        cells.back() += c;
      } else if (k + 1 < line.text.size() && line.text[k + 1] == '"') {
        cells.back() += line.text[++k];
      } else {
        quoted = false;
      }
    } else if (c == '"' && trimmed(cells.back()).empty()) {
      cells.back().clear();
      quoted = true;
    } else if (c == separator) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  if (quoted)
    throw InputError(fmt::format("{}: row {}", file, line.number), "a quote is opened and not closed",
                     "close it in the same row");
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

/// The separator that splits the header and splits the most rows in the same way.
char detect_separator(const std::vector<Line>& lines, const std::string& file) {
  char best = ',';
  std::pair<std::size_t, std::size_t> best_score{0, 0};
  const std::size_t count = std::min<std::size_t>(lines.size(), 30);
  for (const char candidate : {'\t', ';', ','}) {
    std::size_t alike = 0;
    std::size_t columns = 0;
    for (std::size_t k = 0; k < count; ++k) {
      std::size_t cells = 1;
      // A quote that is not closed is reported later, with the separator known; here it must not matter.
      try {
        cells = split_cells(lines[k], candidate, file).size();
      } catch (const InputError&) {
      }
      if (k == 0) columns = cells;
      alike += cells == columns;
    }
    if (columns > 1 && std::pair(alike, columns) > best_score) {
      best_score = {alike, columns};
      best = candidate;
    }
  }
  return best;
}

std::optional<double> to_number(std::string text) {
  if (const auto minus = text.find("\u2212"); minus == 0) text.replace(0, 3, "-");
  if (!text.empty() && text.front() == '+') text.erase(0, 1);
  const auto comma = text.find(',');
  if (comma != std::string::npos) {
    if (text.find('.') != std::string::npos || text.find(',', comma + 1) != std::string::npos)
      return std::nullopt;
    text[comma] = '.';
  }
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

/// A cell as a message may show it: short, and without characters that would break the line.
std::string shown(std::string_view cell) {
  std::string text(cell.substr(0, 40));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  while (cell.size() > 40 && !text.empty() && (static_cast<unsigned char>(text.back()) & 0x80) != 0)
    text.pop_back();
  return cell.size() > 40 ? text + "..." : text;
}

CsvColumn parse_header(const std::string& header) {
  CsvColumn column{header, "", header};
  std::size_t open = std::string::npos;
  if (header.ends_with(']')) open = header.rfind('[');
  if (header.ends_with(')')) open = header.rfind('(');
  if (open != std::string::npos) {
    column.unit = trimmed(std::string_view(header).substr(open + 1, header.size() - open - 2));
  } else if ((open = header.find(" / ")) != std::string::npos) {  // as DIN 461 writes it
    column.unit = trimmed(std::string_view(header).substr(open + 3));
  }
  if (open != std::string::npos) column.name = trimmed(std::string_view(header).substr(0, open));
  return column;
}

/// Units in a row of their own: no cell of the row is a number, and no header names a unit.
bool is_unit_row(const std::vector<CsvColumn>& columns, const std::vector<std::string>& cells) {
  return cells.size() > 1 && cells.size() == columns.size() &&
         std::ranges::none_of(cells,
                              [](const auto& cell) { return cell.empty() || to_number(cell).has_value(); }) &&
         std::ranges::all_of(columns, [](const auto& column) { return column.unit.empty(); });
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
      diagonal = above;
    }
  }
  return row.back();
}

std::string cell_place(const CsvTable& table, std::size_t row, std::size_t column) {
  return fmt::format("{}: row {}, column \"{}\"", table.file, table.line[row], table.columns[column].name);
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view name, const std::vector<std::string>& candidates,
                                       std::size_t count) {
  const std::string wanted = lower(name);
  std::vector<std::pair<std::size_t, std::string>> ranked;
  for (const std::string& candidate : candidates) {
    const std::string text = lower(candidate);
    if (text.empty() || wanted.empty()) continue;
    std::size_t distance = edit_distance(wanted, text);
    if (text.find(wanted) != std::string::npos || wanted.find(text) != std::string::npos)
      distance = std::min<std::size_t>(distance, 2);
    if (distance <= std::max<std::size_t>(2, wanted.size() / 2)) ranked.emplace_back(distance, candidate);
  }
  std::ranges::stable_sort(ranked, {}, &std::pair<std::size_t, std::string>::first);
  std::vector<std::string> names;
  for (const auto& [distance, candidate] : ranked)
    if (names.size() < count) names.push_back(candidate);
  return names;
}

CsvTable read_csv(const std::filesystem::path& file, const CsvOptions& options) {
  return parse_csv(read_text(file), file.string(), options);
}

CsvTable parse_csv(std::string text, const std::string& name, const CsvOptions& options) {
  CsvTable table;
  table.file = name;
  std::vector<Line> lines = split_lines(decoded(std::move(text), name), options.comment);
  table.separator = options.separator;
  if (!lines.empty() && lower(lines[0].text).starts_with("sep=") && lines[0].text.size() == 5) {
    if (table.separator == 0) table.separator = lines[0].text[4];
    lines.erase(lines.begin());
  }
  if (lines.empty())
    throw InputError(name, "is empty", "it needs a header such as strain[-],stress[MPa] and rows");
  if (table.separator == 0) table.separator = detect_separator(lines, name);

  for (const std::string& header : split_cells(lines[0], table.separator, name))
    table.columns.push_back(parse_header(header));
  if (std::ranges::all_of(table.columns,
                          [](const auto& column) { return to_number(column.header).has_value(); }))
    throw InputError(fmt::format("{}: row {}", name, lines[0].number), "numbers where the header is due",
                     "put a line such as strain[-],stress[MPa] first");
  std::size_t first = 1;
  if (lines.size() > 1) {
    const auto units = split_cells(lines[1], table.separator, name);
    if (is_unit_row(table.columns, units)) {
      for (std::size_t k = 0; k < units.size(); ++k) {
        const bool bracketed = units[k].size() > 2 && units[k].front() == '[' && units[k].back() == ']';
        table.columns[k].unit = bracketed ? trimmed(units[k].substr(1, units[k].size() - 2)) : units[k];
      }
      first = 2;
    }
  }
  for (std::size_t k = first; k < lines.size(); ++k) {
    auto cells = split_cells(lines[k], table.separator, name);
    // Exports often end every row, though not the header, with a separator.
    while (cells.size() > table.columns.size() && cells.back().empty()) cells.pop_back();
    if (cells.size() != table.columns.size()) {
      const bool doubled = table.separator == ',' && cells.size() == 2 * table.columns.size();
      throw InputError(fmt::format("{}: row {}", name, lines[k].number),
                       fmt::format("has {} cell{} where the header has {}", cells.size(),
                                   cells.size() == 1 ? "" : "s", table.columns.size()),
                       doubled ? "with decimal commas, separate the columns by semicolons or tabs"
                               : "give every row one cell per column; put text with a separator in quotes");
    }
    table.cells.push_back(std::move(cells));
    table.line.push_back(lines[k].number);
  }
  if (table.cells.empty())
    throw InputError(fmt::format("{}: row {}", name, lines[0].number), "a header and no rows below it",
                     "check that the export is complete");
  return table;
}

std::size_t find_column(const CsvTable& table, std::string_view name) {
  std::vector<std::size_t> found;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < table.columns.size(); ++k) {
    const CsvColumn& column = table.columns[k];
    if (column.header == name) return k;
    if (column.name == name) found.push_back(k);
    if (!column.name.empty()) names.push_back(column.name);
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1)
    throw InputError(table.file, fmt::format("there are {} columns \"{}\"", found.size(), name),
                     "name one by its whole header, with the unit");
  const auto near = nearest_names(name, names);
  std::string remedy = near.empty() ? "" : fmt::format("did you mean \"{}\"? ", fmt::join(near, "\" or \""));
  remedy += fmt::format("There are: {}", fmt::join(names, ", "));
  if (names.size() == 1) remedy += " (columns are separated by commas, semicolons or tabs)";
  throw InputError(table.file, fmt::format("no column \"{}\"", name), remedy);
}

double number_at(const CsvTable& table, std::size_t row, std::size_t column) {
  const std::string& cell = table.cells[row][column];
  const std::optional<double> value = to_number(cell);
  if (value && std::isfinite(*value)) return *value;
  throw InputError(
      cell_place(table, row, column),
      cell.empty() ? std::string("the cell is empty") : fmt::format("\"{}\" is no finite number", shown(cell)),
      "correct the cell, or leave the row out by a # in front");
}

std::vector<double> numbers(const CsvTable& table, std::size_t column) {
  std::vector<double> values(table.rows());
  std::optional<std::size_t> with_comma;
  std::optional<std::size_t> with_point;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    values[row] = number_at(table, row, column);
    const std::string& cell = table.cells[row][column];
    if (cell.find(',') != std::string::npos) with_comma = row;
    if (cell.find('.') != std::string::npos) with_point = row;
    if (with_comma && with_point)
      throw InputError(cell_place(table, row, column),
                       fmt::format("\"{}\" here and \"{}\" in row {}: a decimal comma and a decimal point",
                                   cell, table.cells[row == *with_comma ? *with_point : *with_comma][column],
                                   table.line[row == *with_comma ? *with_point : *with_comma]),
                       "use one of them, and nothing between thousands");
  }
  return values;
}

}  // namespace lab
