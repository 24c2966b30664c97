// A chart as an SVG file of its own, for papers: with its style inside, its title, its legend, and a size in
// millimetres.
#pragma once
#include <string>

#include "report/page.h"

namespace report {

/// The file's text. It loads nothing and uses no font by name. `width` in millimetres; the height follows from
/// the legend. Throws std::invalid_argument if the lengths of a series do not agree.
std::string chart_picture(const Chart& chart, double width);

}  // namespace report
