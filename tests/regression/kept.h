// Figures that are kept (references.toml): a change that moves one shows the old figure, the new one and the
// tolerance, and the commit that set it. Whoever means the change sets the new figure there, and says why in
// the commit.
#pragma once
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <toml++/toml.h>
#include <cmath>
#include <string>

namespace regression {

/// Whether `value` is the kept figure of that name, within its tolerance (relative, or as it stands where
/// `absolute` is true).
inline testing::AssertionResult is_kept(const std::string& group, const std::string& name, double value) {
  static const toml::table all = toml::parse_file(SPALL_SOURCE_DIR "/tests/regression/references.toml");
  const auto entry = all[group][name];
  const auto old = entry["value"].value<double>(), tolerance = entry["tolerance"].value<double>();
  if (!old || !tolerance)
    return testing::AssertionFailure()
           << fmt::format("references.toml has no [{}] {} with value and tolerance", group, name);
  const bool absolute = entry["absolute"].value_or(false);
  const double off = absolute ? value - *old : value / *old - 1;
  if (std::abs(off) <= *tolerance) return testing::AssertionSuccess();
  return testing::AssertionFailure() << fmt::format(
             "{} of {}: kept {:.6g}, now {:.6g} ({}), tolerance {}; set by commit {}", name, group, *old, value,
             absolute ? fmt::format("{:+.6g}", off) : fmt::format("{:+.3f}%", 100 * off),
             absolute ? fmt::format("{:g}", *tolerance) : fmt::format("{:g}%", 100 * *tolerance),
             all[group]["set_by"].value_or(std::string("unknown")));
}

}  // namespace regression
