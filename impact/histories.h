// The histories of an impact as a table: what is noted down at every sample, by name and unit.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "impact/impact_run.h"
#include "impact/scene.h"

namespace impact {

/// One recorded quantity. "displacement/centre" in history.h5 is displacement_centre_x[m], ..._y, ..._z in
/// curves.csv.
struct HistoryColumn {
  std::string name, unit;
  std::string meaning;
  std::size_t components = 1;  ///< 3 for a vector
  std::vector<double> values;  ///< one sample after the other
};

/// Time first. Without an impactor its force, impulse and motion are left out; energies if they were not taken.
std::vector<HistoryColumn> history_columns(const Scene& scene, std::span<const Sample> history);

/// One row a sample; a column's name carries its unit: "force_z[N]".
std::string curves_csv(const Scene& scene, std::span<const Sample> history);

/// The same as named datasets with their units as attributes, whole or not at all. Throws RunError if it cannot
/// be written.
void write_history(const std::filesystem::path& file, const Scene& scene, std::span<const Sample> history);

}  // namespace impact
