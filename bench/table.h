// The table of what is to be reached, what was measured, and how far the floor is.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bench/machine.h"

namespace bench {

/// One row. Numbers are in `unit`; `goal` is a least or a most.
struct Row {
  std::string part;  ///< the name that runs it, see `spall_performance --help`
  std::string what;
  std::string unit;
  double goal = 0;
  bool at_most = false;  ///< smaller is better
  double median = 0, low = 0, high = 0;
  std::size_t turns = 1;
  std::optional<double> floor;  ///< what the machine, or arithmetic, allows at best
  std::string remark;

  bool met() const { return at_most ? median <= goal : median >= goal; }
  /// How many times the floor, 1 at best; nothing where there is no floor.
  std::optional<double> ratio_to_floor() const;
};

/// As Markdown, which also reads well on a terminal.
std::string to_markdown(const std::vector<Row>& rows, const Machine& machine);
/// table.md and table.json in `folder`, which is made if it is missing. Throws RunError.
void write_table(const std::filesystem::path& folder, const std::vector<Row>& rows, const Machine& machine);

}  // namespace bench
