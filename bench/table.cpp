#include "bench/table.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "libdem/core/atomic_file.h"

namespace bench {
namespace {

/// Three digits, as many as the measurement is good for.
std::string digits(double value) {
  const double size = std::abs(value);
  return fmt::format("{:.{}f}", value, size >= 100 ? 0 : size >= 10 ? 1 : 2);
}

std::string with_unit(const std::string& number, const std::string& unit) {
  return unit.empty() ? number : fmt::format("{}{}{}", number, unit == "%" ? "" : " ", unit);
}

std::string measured(const Row& row) {
  std::string text = with_unit(digits(row.median), row.unit);
  if (row.turns > 1) text += fmt::format(" ({} to {}, {} turns)", digits(row.low), digits(row.high), row.turns);
  return text;
}

}  // namespace

std::optional<double> Row::ratio_to_floor() const {
  if (!floor || !(*floor > 0) || !(median > 0)) return std::nullopt;
  return at_most ? median / *floor : *floor / median;
}

std::string to_markdown(const std::vector<Row>& rows, const Machine& machine) {
  std::string text =
      fmt::format("{}, {}: {:.0f} GFLOP/s", machine.processor, machine.instructions, machine.operations / 1e9);
  for (const MemoryLevel& level : machine.levels)
    text +=
        fmt::format("; {} {:.1f} GB/s (triad {:.1f})", level.name, level.bandwidth() / 1e9, level.triad / 1e9);
  text +=
      "; one core\n\n| what | goal | measured: median (lowest to highest) | met | floor | ratio to floor |\n"
      "|---|---|---|---|---|---|\n";
  for (const Row& row : rows) {
    const auto ratio = row.ratio_to_floor();
    text +=
        fmt::format("| {}{} | {} {} | {} | {} | {} | {} |\n", row.what,
                    row.remark.empty() ? std::string() : fmt::format(" ({})", row.remark),
                    row.at_most ? "at most" : "at least", with_unit(fmt::format("{:g}", row.goal), row.unit),
                    measured(row), row.met() ? "yes" : "no",
                    row.floor ? with_unit(digits(*row.floor), row.unit) : "", ratio ? digits(*ratio) : "");
  }
  return text;
}

void write_table(const std::filesystem::path& folder, const std::vector<Row>& rows, const Machine& machine) {
  nlohmann::ordered_json json;
  json["machine"] = {{"processor", machine.processor},
                     {"instructions", machine.instructions},
                     {"operations_per_second", machine.operations}};
  for (const MemoryLevel& level : machine.levels)
    json["machine"]["bytes_per_second"][level.name] = {
        {"working_set", level.bytes}, {"triad", level.triad}, {"update", level.update}};
  for (const Row& row : rows) {
    nlohmann::ordered_json one = {{"part", row.part},     {"what", row.what},  {"remark", row.remark},
                                  {"unit", row.unit},     {"goal", row.goal},  {"at_most", row.at_most},
                                  {"median", row.median}, {"lowest", row.low}, {"highest", row.high},
                                  {"turns", row.turns},   {"met", row.met()}};
    if (row.floor) one["floor"] = *row.floor;
    if (const auto ratio = row.ratio_to_floor()) one["ratio_to_floor"] = *ratio;
    json["rows"].push_back(one);
  }
  std::filesystem::create_directories(folder);
  dem::write_file_atomically(folder / "table.md", to_markdown(rows, machine));
  dem::write_file_atomically(folder / "table.json", json.dump(2) + "\n");
}

}  // namespace bench
