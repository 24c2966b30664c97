// A strict reader of TOML input files. A quantity is text with its unit; an unknown key is an error; every
// error is one line that names the file, the line and the key, says what is wrong and what is allowed.
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "libdem/core/units.h"

namespace dem {

/// A table of a TOML file. Ask it for its keys, then call finish() on the table that you read first: it refuses
/// every key that nobody asked for, in this table and in the tables below it. All getters throw InputError.
/// Copies share their state.
class TomlTable {
 public:
  /// Reads a file. Throws InputError if it is missing, empty, or not TOML (the line is named).
  static TomlTable read(const std::filesystem::path& file);
  /// Reads text; `name` stands for the file in messages.
  static TomlTable parse(std::string_view text, const std::string& name);

  /// Refuses at once every key that is not in this list. For tables whose keys are all known beforehand: a
  /// mistyped key is then reported as such, not as a missing one.
  void allow_only(const std::vector<std::string>& keys) const;
  /// Refuses the keys that nobody asked for, here and in the tables below, and suggests the nearest known one.
  void finish() const;

  bool has(std::string_view key) const;
  /// What stands under `key`, for keys that may be written in several ways. A date is `other`.
  enum class Kind { absent, text, number, boolean, list, table, other };
  Kind kind(std::string_view key) const;
  /// All keys in the file's order; they count as asked for. For tables of free text.
  std::vector<std::string> keys() const;

  /// "24 GPa" -> 2.4e10: the SI value. A ratio may also be a bare number.
  double quantity(std::string_view key, Quantity kind) const;
  double quantity(std::string_view key, Quantity kind, double fallback) const;
  std::optional<double> optional_quantity(std::string_view key, Quantity kind) const;
  /// A finite number without unit; an integer will do.
  double number(std::string_view key) const;
  double number(std::string_view key, double fallback) const;
  std::optional<double> optional_number(std::string_view key) const;
  /// An integer within [low, high].
  std::int64_t integer(std::string_view key, std::int64_t low = lowest, std::int64_t high = highest) const;
  std::optional<std::int64_t> optional_integer(std::string_view key, std::int64_t low = lowest,
                                               std::int64_t high = highest) const;
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, std::string_view fallback) const;
  std::optional<std::string> optional_text(std::string_view key) const;
  bool boolean(std::string_view key) const;
  bool boolean(std::string_view key, bool fallback) const;
  /// One of `names`; anything else lists them and suggests the nearest.
  std::string choice(std::string_view key, const std::vector<std::string>& names) const;
  std::string choice(std::string_view key, const std::vector<std::string>& names,
                     std::string_view fallback) const;
  /// The path in `key`, relative to the folder of this file.
  std::filesystem::path file_path(std::string_view key) const;

  /// A table below this one.
  TomlTable table(std::string_view key) const;
  std::optional<TomlTable> optional_table(std::string_view key) const;
  /// [[key]]: the tables of an array, empty if the key is absent.
  std::vector<TomlTable> tables(std::string_view key) const;

  /// Lists. A missing key is an error, an empty list is not.
  std::vector<double> numbers(std::string_view key) const;
  std::vector<std::int64_t> integers(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;
  /// ["1 mm", "2 mm"], or several numbers with one unit at the end: "0.5x0.25x0.25 m".
  std::vector<double> quantities(std::string_view key, Quantity kind) const;

  /// "case.toml:12: loading.velocity", to begin a message with; without the line if the key is absent.
  std::string where(std::string_view key) const;
  /// Throws the InputError "where(key): what_is_wrong; remedy": for bounds that only the caller knows.
  [[noreturn]] void fail(std::string_view key, const std::string& what_is_wrong,
                         const std::string& remedy) const;
  /// The file's name as it was given.
  const std::string& file() const;
  /// Of the whole text that was read.
  const std::string& sha256() const;

 private:
  static constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min();
  static constexpr std::int64_t highest = std::numeric_limits<std::int64_t>::max();
  struct Node;
  struct Access;
  explicit TomlTable(std::shared_ptr<Node> node);
  std::shared_ptr<Node> node;
};

}  // namespace dem
