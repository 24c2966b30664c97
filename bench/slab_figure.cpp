#include "bench/slab_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace bench {
namespace {

constexpr double width = 930, panel_width = 400, panel_height = 220, left = 55, top = 50, gap = 90;
constexpr const char* ink[2] = {"#1f5fa8", "#c2410c"};

/// A step of 1, 2 or 5 times a power of ten, so that `span` has four to ten.
double step_of(double span) {
  const double power = std::pow(10, std::floor(std::log10(span / 4)));
  for (const double factor : {5.0, 2.0})
    if (span / (factor * power) >= 4) return factor * power;
  return power;
}

/// Displacement of one probe over time in both models, millimetres over milliseconds.
std::string curves(const std::array<SlabPicture, 2>& models, std::size_t probe, const char* title, double x0) {
  double low = 0, high = 0, end = 0;
  for (const SlabPicture& model : models)
    for (std::size_t k = 0; k < model.curves.time.size(); ++k) {
      const double u = 1e3 * model.curves.probe[probe][k];
      low = std::min(low, u), high = std::max(high, u), end = std::max(end, 1e3 * model.curves.time[k]);
    }
  const double span = std::max(high - low, 1e-9);
  low -= 0.05 * span, high += 0.05 * span;
  const auto x = [&](double t) { return x0 + panel_width * t / end; };
  const auto y = [&](double u) { return top + panel_height * (high - u) / (high - low); };
  std::string svg = fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"t\">{}</text>\n<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{}\" "
      "height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n",
      x0, top - 8, title, x0, top, panel_width, panel_height);
  const double tick = step_of(high - low), time_tick = step_of(end);
  for (double u = std::ceil(low / tick) * tick; u <= high; u += tick)
    svg += fmt::format(
        "<line x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/><text x=\"{:.1f}\" "
        "y=\"{:.1f}\" text-anchor=\"end\">{:.6g}</text>\n",
        x0, x0 + panel_width, y(u), y(u), x0 - 5, y(u) + 4, std::abs(u) < 1e-6 * tick ? 0.0 : u);
  for (double t = 0; t <= end * (1 + 1e-9); t += time_tick)
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.6g}</text>\n", x(t),
                       top + panel_height + 16, t);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">time, ms</text>\n",
                     x0 + panel_width / 2, top + panel_height + 32);
  for (std::size_t m = 0; m < models.size(); ++m) {
    const SlabCurves& c = models[m].curves;
    const std::size_t stride = std::max<std::size_t>(1, c.time.size() / 400);
    svg += fmt::format("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"{} points=\"", ink[m],
                       m == 1 ? " stroke-dasharray=\"6 3\"" : "");
    for (std::size_t k = 0; k < c.time.size(); k += stride)
      svg += fmt::format("{:.1f},{:.1f} ", x(1e3 * c.time[k]), y(1e3 * c.probe[probe][k]));
    svg += "\"/>\n";
  }
  return svg;
}

/// Damage from above, white to black as in Fig. 18; finite elements in a light tint.
std::string map(const SlabPicture& model, double x0, double y0) {
  const DamagePlan& plan = model.damage;
  const double cell = panel_width / plan.columns;
  std::string svg =
      fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"t\">damage, {}</text>\n", x0, y0 - 8, model.name);
  const auto colour = [&](int i, int j) -> std::string {
    const double damage = plan.mean[static_cast<std::size_t>(j * plan.columns + i)];
    if (damage < 0) return "#d8e6f3";
    const int grey = 255 - static_cast<int>(std::lround(255 * std::clamp(damage, 0.0, 1.0)));
    return fmt::format("rgb({0},{0},{0})", grey);
  };
  for (int j = 0; j < plan.rows; ++j)
    for (int i = 0, end = 0; i < plan.columns; i = end) {
      for (end = i + 1; end < plan.columns && colour(end, j) == colour(i, j);) ++end;
      if (colour(i, j) == "rgb(255,255,255)") continue;  // the picture's own white
      svg += fmt::format(R"(<rect x="{:.1f}" y="{:.1f}" width="{:.2f}" height="{:.2f}" fill="{}"/>)",
                         x0 + cell * i, y0 + cell * (plan.rows - 1 - j), cell * (end - i) + 0.05, cell + 0.05,
                         colour(i, j));
    }
  return svg + fmt::format(
                   "\n<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" "
                   "stroke=\"#888\"/>\n",
                   x0, y0, panel_width, cell * plan.rows);
}

}  // namespace

std::string slab_figure(const std::string& title, const std::array<SlabPicture, 2>& models) {
  const double second = left + panel_width + gap - 35, maps = top + panel_height + 75;
  const double cell = panel_width / models[0].damage.columns;
  const double height = maps + cell * models[0].damage.rows + 15;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {:.0f}\" font-family=\"sans-serif\" "
      "font-size=\"12\">\n<style>.t{{font-weight:bold}}</style>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n<text x=\"{}\" y=\"18\" font-size=\"14\">{}: <tspan fill=\"{}\">{} (solid)</tspan>, "
      "<tspan "
      "fill=\"{}\">{} (dashed)</tspan></text>\n",
      width, height, left, title, ink[0], models[0].name, ink[1], models[1].name);
  svg += curves(models, 0, "displacement under the rock, mm", left);
  svg += curves(models, 1, "displacement half way to a support, mm", second);
  svg += map(models[0], left, maps);
  svg += map(models[1], second, maps);
  return svg + "</svg>\n";
}

}  // namespace bench
