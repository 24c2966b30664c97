// Pages with made-up content for the browser tests: views in space of any size, and a chart of every kind.
//   browser_make_pages <folder>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "report/page.h"
#include "tests/scenes/report_scene.h"

namespace {

void write_scene(const std::filesystem::path& file, std::size_t elements, std::size_t frames) {
  report::Page page;
  page.title = "A slab of " + std::to_string(elements) + " elements";
  page.sections = {{"In space", {scenes::report_scene(elements, frames)}}};
  report::write_page(file, page);
}

report::Series curve(const char* name, double frequency,
                     report::Series::Kind kind = report::Series::Kind::line) {
  report::Series series;
  series.name = name;
  series.kind = kind;
  for (int k = 0; k <= 100; ++k) {
    series.x.push_back(0.01 * k);
    series.y.push_back(3 * std::sin(frequency * 0.01 * k));
  }
  return series;
}

void write_charts(const std::filesystem::path& file) {
  report::Page page;
  page.title = "Charts of every kind";
  report::Chart many;
  many.title = "Several curves";
  many.x = {"axial strain", "‰"};
  many.y = {"stress", "MPa"};
  report::Series band = curve("laboratory, range", 3, report::Series::Kind::band);
  for (double& y : band.y) band.upper.push_back(y + 0.4), y -= 0.4;
  band.colour = 0;
  many.series = {band, curve("laboratory, mean", 3, report::Series::Kind::dashed), curve("seed 1 <b>&", 2.8),
                 curve("seed 2", 3.2)};
  many.series[1].colour = 0;
  report::Chart logarithmic;
  logarithmic.title = "Decades";
  logarithmic.x = {"evaluation", ""};
  logarithmic.y = {"objective", "", true};
  report::Series points = curve("objective", 1, report::Series::Kind::points);
  for (std::size_t k = 0; k < points.x.size(); ++k)
    points.y[k] = k == 50 ? 0 : std::pow(10.0, -4 * points.x[k]);
  logarithmic.series = {points};
  page.sections = {{"", {many, logarithmic}}};
  report::write_page(file, page);
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return std::fputs("browser_make_pages <folder>\n", stderr), 2;
  try {
    const std::filesystem::path folder = words[1];
    std::filesystem::create_directories(folder);
    write_charts(folder / "charts.html");
    write_scene(folder / "scene-20000.html", 20000, 20);
    write_scene(folder / "scene-120808.html", 120808, 12);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
