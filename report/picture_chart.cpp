#include "report/picture_chart.h"

#include <fmt/format.h>

#include <stdexcept>

#include "report/chart_svg.h"
#include "report/html.h"
#include "report/picture_colours.h"

namespace report {
namespace {

// The drawing's own pixels, see chart_svg.cpp.
constexpr double drawing_width = 860, drawing_height = 430, title_height = 34, legend_row = 20;

/// Fonts differ: a guess that is rather too wide.
double width_of(const std::string& words) {
  std::size_t letters = 0;
  for (const char c : words) letters += (static_cast<unsigned char>(c) & 0xC0u) != 0x80u;
  return 7.4 * static_cast<double>(letters);
}

std::string style() {
  std::string text =
      "text{font-family:sans-serif;fill:#3b444d;font-size:12.5px}.title{fill:#1d2126;font-size:13px}"
      ".head{fill:#1d2126;font-size:16px;font-weight:bold}"
      ".line,.dashed{fill:none;stroke-width:2;stroke-linejoin:round;stroke-linecap:round}"
      ".dashed{stroke-dasharray:7 5;stroke-linecap:butt}.thin{stroke-width:1.1}.dashed.thin{stroke-dasharray:4 "
      "3}"
      ".band{fill-opacity:.16;stroke-opacity:.35;stroke-width:.75}.points{fill:#fff;stroke-width:1.6}"
      ".grid{fill:none;stroke:#e6e8ea;stroke-width:1}.zero{fill:none;stroke:#c9ced3;stroke-width:1.5}"
      ".frame{fill:none;stroke:#5b646e;stroke-width:1}";
  for (int c = 0; c < 8; ++c)
    text += fmt::format(
        ".line.c{0},.dashed.c{0},.points.c{0},.band.c{0}{{stroke:{1}}}.band.c{0},.mark-on.c{0}{{fill:{1}}}", c,
        series_colour(c));
  return text;
}

/// Puts an <svg> that has only a viewBox at a place of the size that it names.
std::string placed(const std::string& svg, double x, double y, double width, double height) {
  return fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", x, y, width, height) +
         svg.substr(std::string("<svg").size());
}

void require_equal_lengths(const Chart& chart) {
  for (const Series& series : chart.series)
    if (series.y.size() != series.x.size() ||
        (series.kind == Series::Kind::band && series.upper.size() != series.x.size()))
      throw std::invalid_argument(fmt::format("chart \"{}\": series \"{}\" has columns of different lengths",
                                              chart.title, series.name));
}

}  // namespace

std::string chart_picture(const Chart& chart, double width) {
  require_equal_lengths(chart);
  const std::vector<int> colours = colours_of(chart);
  std::string legend;
  double x = 20, y = title_height + 8;
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const double wide = 38 + width_of(chart.series[k].name) + 22;
    if (x > 20 && x + wide > drawing_width) x = 20, y += legend_row;
    legend += placed(swatch_svg(chart, k, colours[k]), x, y - 10, 30, 12) +
              fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", x + 38, y, escape(chart.series[k].name));
    x += wide;
  }
  const double top = y + 8, height = top + drawing_height;
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" "
      "height=\"{:.2f}mm\" "
      "viewBox=\"0 0 {} {}\">\n<title>{}</title>\n<style>{}</style>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"#fff\"/>\n<text "
      "class=\"head\" x=\"20\" y=\"22\">{}</text>\n{}\n{}\n</svg>\n",
      width, width * height / drawing_width, drawing_width, height, escape(chart.title), style(),
      escape(chart.title), legend, placed(static_svg(chart, "inside"), 0, top, drawing_width, drawing_height));
}

}  // namespace report
