// Readers of values that several tables of a case share.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "impact/scene_parts.h"

namespace impact {

using dem::Quantity;
using dem::TomlTable;

Vec3 read_lengths(const TomlTable& table, std::string_view key, const std::string& example) {
  const std::string remedy = fmt::format("write it as in {} = \"{}\"", key, example);
  if (!table.has(key)) table.fail(key, "the key is missing", remedy);
  const std::vector<double> lengths = table.quantities(key, Quantity::length);
  if (lengths.size() != 3)
    table.fail(key, fmt::format("has {} length{}, not three", lengths.size(), lengths.size() == 1 ? "" : "s"),
               remedy);
  return {lengths[0], lengths[1], lengths[2]};
}

Vec3 read_direction(const TomlTable& table, std::string_view key, const Vec3& fallback) {
  if (!table.has(key)) return fallback;
  const std::vector<double> numbers = table.numbers(key);
  const std::string remedy = fmt::format("write it as in {} = [0, 0, -1]", key);
  if (numbers.size() != 3)
    table.fail(key, fmt::format("has {} number{}, not three", numbers.size(), numbers.size() == 1 ? "" : "s"),
               remedy);
  const Vec3 direction(numbers[0], numbers[1], numbers[2]);
  const double length = direction.stableNorm();
  if (!(length > 0)) table.fail(key, "is zero, so it points nowhere", remedy);
  return direction / length;
}

double read_positive(const TomlTable& table, std::string_view key, Quantity kind) {
  const double value = table.quantity(key, kind);
  if (!(value > 0)) {
    const std::string_view unit = dem::si_unit(kind);
    table.fail(key, fmt::format("is {:g}{}{}", value, unit == "-" ? "" : " ", unit == "-" ? "" : unit),
               "it must be above 0");
  }
  return value;
}

double read_number(const TomlTable& table, std::string_view key, double fallback, bool (*holds)(double),
                   const char* allowed) {
  const double value = table.number(key, fallback);
  if (!holds(value)) table.fail(key, fmt::format("is {:g}", value), fmt::format("allowed: {}", allowed));
  return value;
}

std::filesystem::path read_path(const TomlTable& table, std::string_view key) {
  std::filesystem::path file = table.file_path(key);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    table.fail(key, fmt::format("there is no file \"{}\"", table.text(key)),
               "name a file that exists, relative to the case file");
  return file;
}

std::string read_name(const TomlTable& table, const std::vector<std::string>& taken) {
  std::string name = table.text("name");
  const bool plain = !name.empty() && name.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                          "0123456789_-") == std::string::npos;
  if (!plain)
    table.fail("name", "is no name", "letters, digits, _ and - are allowed: it becomes the title of a column");
  if (std::find(taken.begin(), taken.end(), name) != taken.end())
    table.fail("name", fmt::format("\"{}\" stands twice", name), "each one needs a name of its own");
  return name;
}

double read_length_unit(const TomlTable& table) {
  if (!table.has("unit"))
    table.fail("unit", "the key is missing", "write the file's unit of length, as in unit = \"mm\"");
  return dem::unit_factor(table.text("unit"), Quantity::length, table.where("unit"));
}

Region read_region(const TomlTable& table) {
  const bool corners = table.has("low") || table.has("high");
  const bool middle = table.has("centre") || table.has("size");
  if (corners && middle)
    table.fail(table.has("centre") ? "centre" : "size", "stands beside low and high",
               "a region is given either by low and high or by centre and size");
  Region region;
  if (middle) {
    region.low_key = region.high_key = "size";
    const Vec3 centre = read_lengths(table, "centre", "1.25,1.0,0.14 m");
    const Vec3 half = 0.5 * read_lengths(table, "size", "0.5x0.5x0.28 m");
    region.low = centre - half, region.high = centre + half;
  } else {
    region.low = read_lengths(table, "low", "0,0,0 m");
    region.high = read_lengths(table, "high", "0.025,2.0,0.28 m");
  }
  for (int k = 0; k < 3; ++k)
    if (!(region.low[k] < region.high[k]))
      table.fail(region.low_key,
                 fmt::format("the region reaches from {:g} to {:g} m along {}", region.low[k], region.high[k],
                             axis_name[k]),
                 middle ? "every side must be above 0" : "low must be below high along each axis");
  return region;
}

}  // namespace impact
