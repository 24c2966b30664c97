// A chart as static SVG (what the page shows without its script) and as the data that the script draws from.
#pragma once
#include <string>
#include <vector>

#include "report/page.h"

namespace report {

/// What an axis shows: from `low` to `high`, in data units, low < high; both positive if logarithmic.
struct Range {
  double low = 0, high = 1;
};

/// The axis's own limits where it has them, else what holds every finite value (every positive one if
/// logarithmic). Begins at zero if the data begin near it.
Range range_of(const Chart& chart, bool horizontal);

/// Where ticks stand (data units) and what they say. `power` is the power of ten that the labels leave out.
struct Ticks {
  std::vector<double> at;
  std::vector<std::string> labels;
  int power = 0;
};

/// About `wanted` ticks at 1, 2 or 5 times a power of ten; decades if logarithmic.
Ticks ticks_of(const Range& range, bool logarithmic, int wanted);

/// The colour (0 to 7) of every series.
std::vector<int> colours_of(const Chart& chart);

/// One <svg> element; `id` must be unique within the page.
std::string static_svg(const Chart& chart, const std::string& id);

/// A small sample of the line or marker of one of the chart's series, for the legend.
std::string swatch_svg(const Chart& chart, std::size_t series, int colour);

/// The data for the script, as JSON that may stand inside a <script> element. Seven significant digits; NaN
/// becomes null.
std::string chart_json(const Chart& chart);

/// "axial strain [permil]"
std::string axis_words(const Axis& axis);

}  // namespace report
