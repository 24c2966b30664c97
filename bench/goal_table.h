// Goals beside what was measured, as the parts of spall_validation print them.
#pragma once
#include <optional>
#include <string>
#include <vector>

namespace bench {

struct GoalRow {
  std::string what;
  std::string goal;  ///< empty: for information
  std::string measured;
  std::optional<bool> met;
};

/// As Markdown, which also reads well on a terminal.
std::string to_markdown(const std::vector<GoalRow>& rows);

/// A part of a whole as "0.0312%", with three digits.
std::string percent(double part);

/// A row that asks for |measured| at most `goal`, both parts of a whole.
GoalRow at_most(std::string what, double goal, double measured, const std::string& remark = {});

}  // namespace bench
