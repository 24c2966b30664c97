#include "app/console.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/streams.h"

namespace app {
namespace {

constexpr double seconds_between_rewrites = 0.1;
constexpr double seconds_between_lines = 5;

std::size_t terminal_width() {
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 20) return size.ws_col - 1u;
  return 79;
}

std::string count(double value) {
  return std::abs(value) < 1e6 && value == std::floor(value) ? fmt::format("{:.0f}", value)
                                                             : fmt::format("{:.3g}", value);
}

}  // namespace

std::string duration(double seconds) {
  if (!(seconds >= 0) || seconds > 1e9) return "?";
  const long whole = std::lround(seconds);
  if (whole >= 3600) return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
  if (whole >= 60) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} s", whole);
}

std::string progress_line(const dem::Progress& progress, double rate, std::size_t width) {
  std::string line = progress.stage;
  if (progress.total > 0) {
    const double part = std::clamp(progress.done / progress.total, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(std::lround(part * 20));
    line += fmt::format(" [{}{}] {:3.0f}% {}/{} {}", std::string(filled, '='), std::string(20 - filled, ' '),
                        std::floor(100 * part), count(progress.done), count(progress.total), progress.unit);
  } else {
    line += fmt::format(" {} {}", count(progress.done), progress.unit);
  }
  if (rate > 0) line += fmt::format(", {:.3g}/s", rate);
  if (rate > 0 && progress.total > progress.done)
    line += fmt::format(", {} left", duration((progress.total - progress.done) / rate));
  if (!progress.detail.empty()) line += ", " + progress.detail;
  if (line.size() > width) line.resize(width);
  return line;
}

Console::Console(const CommonOptions& common)
    : json(common.json), quiet(common.quiet), terminal(::isatty(STDERR_FILENO) != 0) {}

Console::~Console() { clear_line(); }

dem::ProgressCallback Console::progress() {
  if (quiet || json) return {};
  return [this](const dem::Progress& progress) { show(progress); };
}

void Console::show(const dem::Progress& progress) {
  const auto seconds = [](Clock::duration span) { return std::chrono::duration<double>(span).count(); };
  const Clock::time_point now = Clock::now();
  const bool new_stage = progress.stage != stage || progress.done < done_at_start;
  if (new_stage) {
    stage = progress.stage;
    done_at_start = progress.done;
    stage_start = now;
  }
  const bool finished = progress.total > 0 && progress.done >= progress.total;
  const double since = seconds(now - last_shown);
  if (since < (terminal ? seconds_between_rewrites : seconds_between_lines) &&
      !(terminal && (new_stage || finished)))
    return;
  last_shown = now;
  const double elapsed = seconds(now - stage_start);
  const double rate = elapsed > 0 ? (progress.done - done_at_start) / elapsed : 0;
  if (terminal) {
    put(stderr, "\r\033[K" + progress_line(progress, rate, terminal_width()));
    line_shown = true;
  } else {
    put(stderr, progress_line(progress, rate, 200) + "\n");
  }
  std::fflush(stderr);
}

void Console::clear_line() {
  if (line_shown) put(stderr, "\r\033[K");
  line_shown = false;
}

void Console::say(const std::string& line) {
  if (quiet || json) return;
  clear_line();
  put(stdout, line + "\n");
}

void Console::result(const nlohmann::ordered_json& result) {
  if (!json) return;
  // Bytes of a path that are no UTF-8 must not make a finished run fail.
  put(stdout, result.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

void Console::remark(const std::string& line) {
  if (quiet) return;
  clear_line();
  put(stderr, line + "\n");
}

}  // namespace app
