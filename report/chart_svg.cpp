#include "report/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "report/html.h"

namespace report {
namespace {

// The drawing's size and margins, in CSS pixels.
constexpr double kWidth = 860, kHeight = 430;
constexpr double kLeft = 66, kRight = 18, kTop = 16, kBottom = 52;

bool usable(double value, bool logarithmic) { return std::isfinite(value) && (!logarithmic || value > 0); }

// From data to pixels along one axis.
struct Scale {
  Range range;
  bool logarithmic;
  double begin, end;

  double operator()(double value) const {
    const auto along = [this](double v) { return logarithmic ? std::log10(v) : v; };
    return begin + (end - begin) * (along(value) - along(range.low)) / (along(range.high) - along(range.low));
  }
};

// Points closer than this to the last one drawn are left out: the eye cannot tell, and long histories stay
// small.
constexpr double kVisible = 0.35;

// A polyline through the usable points, broken where one is not.
std::string polyline(const std::vector<double>& x, const std::vector<double>& y, const Scale& across,
                     const Scale& up) {
  std::string path;
  bool drawing = false;
  double last_x = 0, last_y = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (!usable(x[k], across.logarithmic) || !usable(y[k], up.logarithmic)) {
      drawing = false;
      continue;
    }
    const double px = across(x[k]), py = up(y[k]);
    const bool last = k + 1 == x.size();
    if (drawing && !last && std::hypot(px - last_x, py - last_y) < kVisible) continue;
    path += fmt::format("{}{:.1f} {:.1f}", drawing ? "L" : "M", px, py);
    drawing = true;
    last_x = px;
    last_y = py;
  }
  return path;
}

// The area between both edges of a band; points without both edges are left out.
std::string area(const Series& series, const Scale& across, const Scale& up) {
  std::string path;
  const auto edge = [&](std::size_t k, double value) {
    if (!usable(series.x[k], across.logarithmic) || !usable(series.y[k], up.logarithmic) ||
        !usable(series.upper[k], up.logarithmic))
      return;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", across(series.x[k]), up(value));
  };
  for (std::size_t k = 0; k < series.x.size(); ++k) edge(k, series.y[k]);
  for (std::size_t k = series.x.size(); k-- > 0;) edge(k, series.upper[k]);
  return path.empty() ? "" : path + "Z";
}

// One marker; the shape goes with the colour, so that series can be told apart without it. The same shapes are
// in report/web/src/curves/figure.ts.
std::string marker(double x, double y, int colour) {
  static constexpr std::array<std::string_view, 8> shapes = {
      "m-3.4 0a3.4 3.4 0 1 0 6.8 0a3.4 3.4 0 1 0 -6.8 0Z",
      "m-3 -3h6v6h-6Z",
      "m0 -4.4l4 7h-8Z",
      "m0 -4l4 4l-4 4l-4 -4Z",
      "m0 4.4l4 -7h-8Z",
      "m-3.4 -2l1.4 -1.4l2 2l2 -2l1.4 1.4l-2 2l2 2l-1.4 1.4l-2 -2l-2 2l-1.4 -1.4l2 -2Z",
      "m0 -4l3.9 2.8l-1.5 4.5h-4.8l-1.5 -4.5Z",
      "m-1.2 -3.6h2.4v2.4h2.4v2.4h-2.4v2.4h-2.4v-2.4h-2.4v-2.4h2.4Z"};
  return fmt::format("M{:.1f} {:.1f}{}", x, y, shapes[static_cast<std::size_t>(colour % 8)]);
}

// `at_most` of them, evenly taken; 0 means all.
std::string markers(const Series& series, int colour, const Scale& across, const Scale& up,
                    std::size_t at_most = 0) {
  std::string path;
  const std::size_t stride = at_most > 0 ? (series.x.size() + at_most - 1) / at_most : 1;
  for (std::size_t k = 0; k < series.x.size(); k += stride)
    if (usable(series.x[k], across.logarithmic) && usable(series.y[k], up.logarithmic))
      path += marker(across(series.x[k]), up(series.y[k]), colour);
  return path;
}

// Whether curves carry markers: where several stand side by side and colour alone would tell them apart.
bool is_marked(const Chart& chart, const Series& one) {
  const auto is_curve = [](const Series& series) {
    return !series.thin && (series.kind == Series::Kind::line || series.kind == Series::Kind::dashed);
  };
  return is_curve(one) && std::count_if(chart.series.begin(), chart.series.end(), is_curve) > 1;
}
constexpr std::size_t kMarks = 9;

const char* class_of(Series::Kind kind) {
  switch (kind) {
    case Series::Kind::line:
      return "line";
    case Series::Kind::dashed:
      return "dashed";
    case Series::Kind::band:
      return "band";
    case Series::Kind::points:
      return "points";
  }
  return "line";
}

std::string drawn(const Series& series, int colour, const Scale& across, const Scale& up) {
  const std::string path = series.kind == Series::Kind::band     ? area(series, across, up)
                           : series.kind == Series::Kind::points ? markers(series, colour, across, up)
                                                                 : polyline(series.x, series.y, across, up);
  return path.empty() ? ""
                      : fmt::format("<path class=\"{}{} c{}\" d=\"{}\"/>", class_of(series.kind),
                                    series.thin ? " thin" : "", colour, path);
}

nlohmann::json rounded(const std::vector<double>& values) {
  auto out = nlohmann::json::array();
  for (const double value : values) {
    if (std::isfinite(value))
      out.push_back(std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr));
    else
      out.push_back(nullptr);
  }
  return out;
}

nlohmann::json axis_json(const Axis& axis, const Range& range) {
  return {{"title", axis.title},
          {"unit", axis.unit},
          {"log", axis.logarithmic},
          {"low", range.low},
          {"high", range.high}};
}

std::string decade_words(int power) {
  return power >= -3 && power <= 4 ? fmt::format("{:g}", std::pow(10.0, power)) : "10" + superscript(power);
}

Ticks linear_ticks(const Range& range, int wanted) {
  Ticks ticks;
  const double rough = (range.high - range.low) / std::max(1, wanted);
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  const double step = power * (rough <= 1.0001 * power   ? 1
                               : rough <= 2.0001 * power ? 2
                               : rough <= 5.0001 * power ? 5
                                                         : 10);
  const double largest = std::max(std::abs(range.low), std::abs(range.high));
  if (largest >= 1e5 || largest < 1e-2) ticks.power = static_cast<int>(std::floor(std::log10(largest)));
  const double factor = std::pow(10.0, ticks.power);
  const int decimals = std::clamp(static_cast<int>(-std::floor(std::log10(step / factor) + 1e-9)), 0, 12);
  for (double k = std::ceil(range.low / step - 1e-6); k * step <= range.high + 1e-6 * step; ++k) {
    ticks.at.push_back(k * step);
    std::string label = fmt::format("{:.{}f}", std::abs(k * step / factor), decimals);
    ticks.labels.push_back(k < 0 ? "−" + label : label);
  }
  return ticks;
}

}  // namespace

Range range_of(const Chart& chart, bool horizontal) {
  const Axis& axis = horizontal ? chart.x : chart.y;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](const std::vector<double>& values) {
    for (const double value : values) {
      if (!usable(value, axis.logarithmic)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
  };
  for (const Series& series : chart.series) {
    take(horizontal ? series.x : series.y);
    if (!horizontal) take(series.upper);
  }
  if (!(low <= high)) low = axis.logarithmic ? 1 : 0, high = axis.logarithmic ? 10 : 1;
  if (axis.logarithmic) {
    const double margin = low < high ? std::pow(high / low, 0.04) : 2;
    low /= margin;
    high *= margin;
  } else {
    const double margin = low < high ? 0.05 * (high - low) : std::max(1e-12, 0.1 * std::abs(high));
    const bool from_zero = low >= 0 && low <= 0.35 * high, to_zero = high <= 0 && high >= 0.35 * low;
    low = from_zero ? 0 : low - margin;
    high = to_zero ? 0 : high + margin;
  }
  if (axis.from && usable(*axis.from, axis.logarithmic)) low = *axis.from;
  if (axis.to && usable(*axis.to, axis.logarithmic)) high = *axis.to;
  if (!(low < high)) high = axis.logarithmic ? 10 * low : low + 1;
  return {low, high};
}

Ticks ticks_of(const Range& range, bool logarithmic, int wanted) {
  if (!logarithmic) return linear_ticks(range, wanted);
  const double first = std::log10(range.low), last = std::log10(range.high);
  if (last - first < 1.2) {  // too few decades to read by: ticks as on a linear axis
    Ticks ticks = linear_ticks(range, wanted);
    if (!ticks.at.empty() && ticks.at.front() <= 0) {
      ticks.at.erase(ticks.at.begin());
      ticks.labels.erase(ticks.labels.begin());
    }
    return ticks;
  }
  Ticks ticks;
  const int stride = std::max(1, static_cast<int>(std::ceil((last - first) / std::max(1, wanted))));
  for (int power = static_cast<int>(std::ceil(first - 1e-9)); power <= last + 1e-9; power += stride) {
    ticks.at.push_back(std::pow(10.0, power));
    ticks.labels.push_back(decade_words(power));
  }
  return ticks;
}

std::vector<int> colours_of(const Chart& chart) {
  std::vector<bool> given(8, false);
  for (const Series& series : chart.series)
    if (series.colour >= 0) given[static_cast<std::size_t>(series.colour % 8)] = true;
  std::vector<int> free;
  for (int colour = 0; colour < 8; ++colour)
    if (!given[static_cast<std::size_t>(colour)]) free.push_back(colour);
  if (free.empty()) free.push_back(0);
  std::vector<int> colours;
  std::size_t next = 0;
  for (const Series& series : chart.series)
    colours.push_back(series.colour >= 0 ? series.colour % 8 : free[next++ % free.size()]);
  return colours;
}

std::string axis_words(const Axis& axis) {
  return axis.unit.empty() ? axis.title : fmt::format("{} [{}]", axis.title, axis.unit);
}

std::string static_svg(const Chart& chart, const std::string& id) {
  const Scale across{range_of(chart, true), chart.x.logarithmic, kLeft, kWidth - kRight};
  const Scale up{range_of(chart, false), chart.y.logarithmic, kHeight - kBottom, kTop};
  std::string grid, words;
  const auto text = [&](double x, double y, const char* anchor, const std::string& what,
                        const char* more = "") {
    words += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\"{}>{}</text>", x, y, anchor, more,
                         escape(what));
  };
  const Ticks x_ticks = ticks_of(across.range, across.logarithmic, 8);
  for (std::size_t k = 0; k < x_ticks.at.size(); ++k) {
    const double x = across(x_ticks.at[k]);
    grid += fmt::format("M{:.1f} {:.1f}V{:.1f}", x, kTop, kHeight - kBottom);
    text(x, kHeight - kBottom + 18, "middle", x_ticks.labels[k]);
  }
  const Ticks y_ticks = ticks_of(up.range, up.logarithmic, 6);
  for (std::size_t k = 0; k < y_ticks.at.size(); ++k) {
    const double y = up(y_ticks.at[k]);
    grid += fmt::format("M{:.1f} {:.1f}H{:.1f}", kLeft, y, kWidth - kRight);
    text(kLeft - 8, y + 4, "end", y_ticks.labels[k]);
  }
  std::string zero;
  const auto crosses = [](const Scale& scale) {
    return !scale.logarithmic && scale.range.low < 0 && scale.range.high > 0;
  };
  if (crosses(across)) zero += fmt::format("M{:.1f} {:.1f}V{:.1f}", across(0), kTop, kHeight - kBottom);
  if (crosses(up)) zero += fmt::format("M{:.1f} {:.1f}H{:.1f}", kLeft, up(0), kWidth - kRight);
  const auto with_power = [](const Axis& axis, int power) {
    return axis_words(axis) + (power == 0 ? "" : "  ×10" + superscript(power));
  };
  const double middle = (kTop + kHeight - kBottom) / 2;
  text((kLeft + kWidth - kRight) / 2, kHeight - 10, "middle", with_power(chart.x, x_ticks.power),
       " class=\"title\"");
  text(16, middle, "middle", with_power(chart.y, y_ticks.power),
       fmt::format(" class=\"title\" transform=\"rotate(-90 16 {:.1f})\"", middle).c_str());

  std::string curves;
  const std::vector<int> colours = colours_of(chart);
  for (std::size_t k = 0; k < chart.series.size(); ++k)
    curves += drawn(chart.series[k], colours[k], across, up);
  for (std::size_t k = 0; k < chart.series.size(); ++k)
    if (is_marked(chart, chart.series[k]))
      curves += fmt::format("<path class=\"mark-on c{}\" d=\"{}\"/>", colours[k],
                            markers(chart.series[k], colours[k], across, up, kMarks));
  return fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{label}\">"
      "<clipPath id=\"{id}\"><rect x=\"{l}\" y=\"{t}\" width=\"{iw}\" height=\"{ih}\"/></clipPath>"
      "<path class=\"grid\" d=\"{grid}\"/><path class=\"zero\" d=\"{zero}\"/><path class=\"frame\" d=\"M{l} "
      "{t}V{b}H{r}\"/>"
      "<g class=\"words\">{words}</g><g clip-path=\"url(#{id})\">{curves}</g></svg>",
      fmt::arg("w", kWidth), fmt::arg("h", kHeight),
      fmt::arg("label",
               escape(fmt::format("{}: {} over {}", chart.title, axis_words(chart.y), axis_words(chart.x)))),
      fmt::arg("id", id), fmt::arg("l", kLeft), fmt::arg("t", kTop), fmt::arg("b", kHeight - kBottom),
      fmt::arg("r", kWidth - kRight), fmt::arg("iw", kWidth - kLeft - kRight),
      fmt::arg("ih", kHeight - kTop - kBottom), fmt::arg("grid", grid), fmt::arg("zero", zero),
      fmt::arg("words", words), fmt::arg("curves", curves));
}

std::string swatch_svg(const Chart& chart, std::size_t index, int colour) {
  const Series& series = chart.series[index];
  const std::string path = series.kind == Series::Kind::band     ? "M1 1H29V11H1Z"
                           : series.kind == Series::Kind::points ? marker(15, 6, colour)
                                                                 : "M1 6H29";
  return fmt::format(
      "<svg class=\"swatch\" viewBox=\"0 0 30 12\" aria-hidden=\"true\"><path class=\"{}{} c{}\" "
      "d=\"{}\"/>{}</svg>",
      class_of(series.kind), series.thin ? " thin" : "", colour, path,
      is_marked(chart, series)
          ? fmt::format("<path class=\"mark-on c{}\" d=\"{}\"/>", colour, marker(15, 6, colour))
          : "");
}

std::string chart_json(const Chart& chart) {
  nlohmann::json series = nlohmann::json::array();
  const std::vector<int> colours = colours_of(chart);
  for (std::size_t k = 0; k < chart.series.size(); ++k) {
    const Series& one = chart.series[k];
    nlohmann::json entry = {{"name", one.name},
                            {"kind", class_of(one.kind)},
                            {"colour", colours[k]},
                            {"x", rounded(one.x)},
                            {"y", rounded(one.y)}};
    if (one.kind == Series::Kind::band) entry["upper"] = rounded(one.upper);
    if (one.thin) entry["thin"] = true;
    if (is_marked(chart, one)) entry["marked"] = true;
    series.push_back(std::move(entry));
  }
  const nlohmann::json all = {{"title", chart.title},
                              {"x", axis_json(chart.x, range_of(chart, true))},
                              {"y", axis_json(chart.y, range_of(chart, false))},
                              {"series", std::move(series)}};
  return script_json(all.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace report
