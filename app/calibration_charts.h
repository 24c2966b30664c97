// The charts of a calibration's page.
#pragma once
#include <vector>

#include "app/curve_table.h"
#include "app/report_words.h"
#include "report/page.h"

namespace app {

/// "compression" or "tension": the laboratory's band and mean (or the code's curve), every virtual specimen and
/// the peaks. Without series if there is no such test.
report::Chart test_chart(const Json& result, const std::vector<TestCurve>& curves, const std::string& test);

/// nu and E/E0 over Ks/Kn, as in the paper's Fig. 4: the specimens, the fitted Eq. 1, the constants of the
/// paper and of Hentz et al.
std::vector<report::Chart> elastic_charts(const Json& result);

/// The worst misfit over the evaluations, and the path of the parameters. Empty if nothing was fitted.
std::vector<report::Chart> progress_charts(const Json& result);

}  // namespace app
