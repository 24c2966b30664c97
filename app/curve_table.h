// Curves in the CSV files that a run leaves, as charts of its page.
#pragma once
#include <filesystem>
#include <vector>

#include "report/page.h"

namespace app {

/// Two kinds of table: columns of numbers, each drawn over the first ("strain[-],stress[Pa],..."); or one row a
/// point with the columns test, curve, kind, strain[-], stress[Pa], drawn as one chart a test. Pa are shown as
/// MPa, strains as permil.
std::vector<report::Chart> read_charts(const std::filesystem::path& file);

}  // namespace app
