#include "study/number_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "libdem/core/error.h"

namespace study {
namespace {

constexpr std::uint64_t most_numbers = 1'000'000;
constexpr const char* remedy = "write numbers and ranges as in \"1-10, 12\"";

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

std::uint64_t whole_number(std::string_view text, std::uint64_t low, std::uint64_t high,
                           const std::string& where) {
  text = trim(text);
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || stop != end || error == std::errc::invalid_argument)
    throw dem::InputError(where, fmt::format("\"{}\" is not a whole number", text), remedy);
  if (error != std::errc{} || value < low || value > high)
    throw dem::InputError(where, fmt::format("{} is out of range", text),
                          fmt::format("allowed: {} to {}", low, high));
  return value;
}

}  // namespace

std::vector<std::uint64_t> parse_number_list(std::string_view text, std::uint64_t low, std::uint64_t high,
                                             const std::string& where) {
  std::vector<std::uint64_t> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = trim(text.substr(begin, end - begin));
    const std::size_t dash = part.find('-');
    const std::uint64_t first = whole_number(part.substr(0, dash), low, high, where);
    const std::uint64_t last =
        dash == std::string_view::npos ? first : whole_number(part.substr(dash + 1), low, high, where);
    if (last < first)
      throw dem::InputError(where, fmt::format("the range {} runs down", part),
                            fmt::format("write it as \"{}-{}\"", last, first));
    if (last - first >= most_numbers - numbers.size())
      throw dem::InputError(where, "names more than a million numbers", "split it");
    for (std::uint64_t number = first;; ++number) {
      numbers.push_back(number);
      if (number == last) break;
    }
    begin = end + 1;
  }
  std::vector<std::uint64_t> sorted = numbers;
  std::sort(sorted.begin(), sorted.end());
  if (const auto twice = std::adjacent_find(sorted.begin(), sorted.end()); twice != sorted.end())
    throw dem::InputError(where, fmt::format("{} stands twice", *twice), "name each number once");
  return numbers;
}

}  // namespace study
