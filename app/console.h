// What people see while a job runs. Progress and remarks go to standard error, results to standard output.
#pragma once
#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/command.h"
#include "libdem/core/progress.h"

namespace app {

/// "1 h 12 min", "3 min 20 s", "12 s".
std::string duration(double seconds);

/// One line of progress, at most `width` characters: stage, bar (if the total is known), rate, time left,
/// detail.
std::string progress_line(const dem::Progress& progress, double rate, std::size_t width);

/// On a terminal: a line that is rewritten. Otherwise: a plain line now and then. With --quiet or --json:
/// nothing.
class Console {
 public:
  explicit Console(const CommonOptions& common);
  ~Console();
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;

  /// To hand to a long job; the console must outlive it.
  dem::ProgressCallback progress();
  /// A line of the result, on standard output; nothing with --quiet or --json.
  void say(const std::string& line);
  /// The result as JSON, on standard output, if --json asked for it.
  void result(const nlohmann::ordered_json& result);
  /// A line that --json does not silence (but --quiet does), on standard error.
  void remark(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  void show(const dem::Progress& progress);
  void clear_line();

  bool json, quiet, terminal;
  bool line_shown = false;
  std::string stage;
  double done_at_start = 0;  // of the stage: a resumed job does not begin at 0
  Clock::time_point stage_start, last_shown;
};

}  // namespace app
