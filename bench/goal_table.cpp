#include "bench/goal_table.h"

#include <fmt/format.h>

#include <cmath>

namespace bench {

std::string to_markdown(const std::vector<GoalRow>& rows) {
  std::string text = "| what | goal | measured | met |\n|---|---|---|---|\n";
  for (const GoalRow& row : rows)
    text += fmt::format("| {} | {} | {} | {} |\n", row.what, row.goal, row.measured,
                        !row.met   ? ""
                        : *row.met ? "yes"
                                   : "no");
  return text;
}

std::string percent(double part) { return fmt::format("{:.3g}%", 100 * part); }

GoalRow at_most(std::string what, double goal, double measured, const std::string& remark) {
  return {std::move(what), fmt::format("at most {:g}%", 100 * goal), percent(measured) + remark,
          std::abs(measured) <= goal};
}

}  // namespace bench
