#include "libdem/config/nearest_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace dem {

double edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char letter) { return std::tolower(static_cast<unsigned char>(letter)); };
  const auto letter_cost = [&](char x, char y) { return x == y ? 0.0 : lower(x) == lower(y) ? 0.5 : 1.0; };
  std::vector<double> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<double>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = static_cast<double>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + letter_cost(a[i - 1], b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

std::string nearest_name(std::string_view name, const std::vector<std::string>& allowed) {
  std::string best;
  double best_distance = 0;
  for (const std::string& candidate : allowed) {
    const double distance = edit_distance(name, candidate);
    // Half of the letters may differ; a name that begins like the other ("cohesion", "Co") is near as well.
    const std::size_t shorter = std::min(name.size(), candidate.size());
    bool begins_alike = shorter > 0;
    for (std::size_t k = 0; k < shorter; ++k)
      begins_alike = begins_alike && std::tolower(static_cast<unsigned char>(name[k])) ==
                                         std::tolower(static_cast<unsigned char>(candidate[k]));
    const double longest = static_cast<double>(std::max(name.size(), candidate.size()));
    if (distance > longest / 2 && !begins_alike) continue;
    if (best.empty() || distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& allowed) {
  if (allowed.empty()) return "nothing is allowed here";
  const std::string nearest = nearest_name(name, allowed);
  std::string text = nearest.empty() ? "" : fmt::format("did you mean \"{}\"? ", nearest);
  text += "allowed: ";
  for (std::size_t k = 0; k < allowed.size(); ++k) text += (k > 0 ? ", " : "") + allowed[k];
  return text;
}

}  // namespace dem
