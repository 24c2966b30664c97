// The charts of an impact's page.
#pragma once
#include <vector>

#include "app/curve_table.h"
#include "report/page.h"

namespace app {

/// Displacements of the probes, contact force and impulse, the impactor's velocity, energy and broken links
/// over time; those for which there are columns.
std::vector<report::Chart> impact_charts(const std::vector<Column>& columns);

}  // namespace app
