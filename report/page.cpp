#include "report/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "libdem/core/atomic_file.h"
#include "report/assets.h"
#include "report/chart_svg.h"
#include "report/html.h"
#include "report/scene_html.h"

namespace report {
namespace {

void check(const Chart& chart) {
  for (const Series& series : chart.series) {
    const bool band = series.kind == Series::Kind::band;
    if (series.x.size() != series.y.size() || series.upper.size() != (band ? series.x.size() : 0))
      throw std::invalid_argument(fmt::format("chart '{}', series '{}': {} values of x, {} of y, {} of upper",
                                              chart.title, series.name, series.x.size(), series.y.size(),
                                              series.upper.size()));
  }
}

// "3.12", "−0.4 %", "± 2 %"; a dash, for a number that is not there, does too.
bool reads_as_number(const std::string& cell) {
  if (cell == "–") return true;
  const char* begin = cell.c_str();
  for (const std::string_view sign : {"−", "± "})
    if (cell.starts_with(sign)) begin += sign.size();
  char* end = nullptr;
  std::strtod(begin, &end);
  return end != begin && (*end == '\0' || *end == ' ' || *end == '%');
}

// The error (the worst single one, if there are several) as a dot within its tolerance, drawn over twice the
// tolerance to either side; farther out it sits at the edge.
std::string deviation_svg(const Target& target) {
  const double error = target.worst.value_or(target.relative_error);
  if (!std::isfinite(error) || !(target.tolerance > 0)) return "";
  const double place = 60 + 27.5 * std::clamp(error / target.tolerance, -2.0, 2.0);
  return fmt::format(
      "<svg class=\"deviation\" viewBox=\"0 0 120 16\" aria-hidden=\"true\"><path class=\"reach\" d=\"M2 "
      "8H118\"/>"
      "<rect class=\"allowed\" x=\"32.5\" y=\"3\" width=\"55\" height=\"10\" rx=\"2\"/><path class=\"aim\" "
      "d=\"M60 1V15\"/>"
      "<circle class=\"{}\" cx=\"{:.1f}\" cy=\"8\" r=\"4\"/></svg>",
      target.met ? "met" : "missed", place);
}

// Writes blocks one after another; charts count up, since their clip paths need names of their own.
class Writer {
 public:
  std::string html;

  void operator()(const Text& text) {
    for (std::size_t begin = 0; begin < text.body.size();) {
      const std::size_t end = std::min(text.body.find("\n\n", begin), text.body.size());
      if (end > begin) html += fmt::format("<p>{}</p>\n", escape(text.body.substr(begin, end - begin)));
      begin = end + 2;
    }
  }

  void operator()(const List& list) {
    html += "<ul class=\"remarks\">\n";
    for (const std::string& item : list.items) html += fmt::format("<li>{}</li>\n", escape(item));
    html += "</ul>\n";
  }

  void operator()(const KeyValues& table) {
    html += "<div class=\"scroll\"><table class=\"facts\"><tbody>\n";
    for (const auto& [key, value] : table.rows)
      html += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escape(key), escape(value));
    html += "</tbody></table></div>\n";
  }

  void operator()(const Table& table) {
    html += "<div class=\"scroll\"><table><thead><tr>";
    // A column is set right if its cells are numbers, and then so is its heading.
    std::vector<bool> numeric(table.columns.size(), !table.rows.empty());
    for (const auto& row : table.rows)
      for (std::size_t k = 0; k < numeric.size(); ++k)
        if (k >= row.size() || !reads_as_number(row[k])) numeric[k] = false;
    const auto side = [&](std::size_t k) {
      return k < numeric.size() && numeric[k] ? " class=\"number\"" : "";
    };
    for (std::size_t k = 0; k < table.columns.size(); ++k)
      html += fmt::format("<th scope=\"col\"{}>{}</th>", side(k), escape(table.columns[k]));
    html += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
      html += "<tr>";
      for (std::size_t k = 0; k < row.size(); ++k)
        html += fmt::format("<td{}>{}</td>", side(k), escape(row[k]));
      html += "</tr>\n";
    }
    html += "</tbody></table></div>\n";
  }

  void operator()(const Targets& targets) {
    const bool singles = std::any_of(targets.rows.begin(), targets.rows.end(),
                                     [](const Target& target) { return target.worst.has_value(); });
    html += fmt::format(
        "<div class=\"scroll\"><table class=\"targets\"><thead><tr><th scope=\"col\">Target</th>"
        "<th scope=\"col\" class=\"number\">Asked</th><th scope=\"col\" class=\"number\">{}</th>"
        "<th scope=\"col\" class=\"number\">Error</th>{}<th scope=\"col\" class=\"number\">Tolerance</th>"
        "<th scope=\"col\" class=\"reading\"><span class=\"unseen\">Error within tolerance</span></th>"
        "<th scope=\"col\">Result</th></tr></thead><tbody>\n",
        singles ? "Mean" : "Achieved", singles ? "<th scope=\"col\" class=\"number\">Worst single</th>" : "");
    for (const Target& target : targets.rows) {
      const auto with_unit = [&](double value) {
        return escape(number_text(value) +
                      (target.unit.empty() || !std::isfinite(value) ? "" : " " + target.unit));
      };
      const auto cell = [](const std::string& text) {
        return fmt::format("<td class=\"number\">{}</td>", text);
      };
      html += fmt::format(
          "<tr><th scope=\"row\">{}{}</th>", escape(target.name),
          target.source.empty() ? "" : fmt::format("<span class=\"source\">{}</span>", escape(target.source)));
      html += cell(with_unit(target.target)) + cell(with_unit(target.achieved)) +
              cell(signed_percent(target.relative_error));
      if (singles) html += cell(target.worst ? signed_percent(*target.worst) : "–");
      html += cell(target.tolerance > 0 ? "± " + number_text(100 * target.tolerance, 3) + " %" : "none set");
      html += fmt::format(
          "<td class=\"reading\">{}</td><td class=\"{}\"><span class=\"mark\" aria-hidden=\"true\">{}</span> "
          "{}</td></tr>\n",
          deviation_svg(target), target.met ? "met" : "missed", target.met ? "✓" : "✗",
          target.met ? "met" : "not met");
    }
    html += "</tbody></table></div>\n";
  }

  void operator()(const Chart& chart) {
    check(chart);
    html +=
        fmt::format("<figure class=\"chart\"><div class=\"head\"><h3>{}</h3></div>\n<ul class=\"legend\">\n",
                    escape(chart.title));
    const std::vector<int> colours = colours_of(chart);
    for (std::size_t k = 0; k < chart.series.size(); ++k)
      html += fmt::format("<li>{}{}</li>\n", swatch_svg(chart, k, colours[k]), escape(chart.series[k].name));
    html += fmt::format("</ul>\n<div class=\"canvas\">{}</div>\n",
                        static_svg(chart, fmt::format("clip{}", ++charts)));
    if (!chart.caption.empty()) html += fmt::format("<figcaption>{}</figcaption>\n", escape(chart.caption));
    html += fmt::format("<script type=\"application/json\">{}</script></figure>\n", chart_json(chart));
  }

  void operator()(const Scene& scene) {
    html += scene_html(scene);
    ++scenes;
  }

  int charts = 0, scenes = 0;
};

std::string verdict_html(const Page& page) {
  if (page.verdict_words.empty()) return "";
  const char* look = page.verdict == Verdict::met       ? "met"
                     : page.verdict == Verdict::not_met ? "missed"
                                                        : "neutral";
  const char* mark = page.verdict == Verdict::met ? "✓" : page.verdict == Verdict::not_met ? "✗" : "•";
  return fmt::format(
      "<p class=\"verdict {}\"><span class=\"mark\" aria-hidden=\"true\">{}</span><span>{}</span></p>\n", look,
      mark, escape(page.verdict_words));
}

}  // namespace

std::string to_html(const Page& page) {
  Writer body;
  for (const Section& section : page.sections) {
    body.html += "<section>\n";
    if (!section.title.empty()) body.html += fmt::format("<h2>{}</h2>\n", escape(section.title));
    for (const Block& block : section.blocks) std::visit(body, block);
    body.html += "</section>\n";
  }
  if (!page.provenance.empty()) {
    body.html += "<footer>\n<h2>Provenance</h2>\n";
    body(KeyValues{page.provenance});
    body.html += "</footer>\n";
  }
  // The policy keeps the promise that the page loads nothing, whatever its text may hold; images are those that
  // the page makes itself when a picture is saved.
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; "
      "script-src 'unsafe-inline'; img-src data: blob:; form-action 'none'; base-uri 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light "
      "dark\">\n<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n"
      "<header>\n<h1>{}</h1>\n{}{}</header>\n{}</main>\n",
      escape(page.title), assets::style(), escape(page.title),
      page.subtitle.empty() ? "" : fmt::format("<p class=\"subtitle\">{}</p>\n", escape(page.subtitle)),
      verdict_html(page), body.html);
  const auto add_script = [&html](std::string_view script) {
    html.append("<script>\n").append(script).append("</script>\n");
  };
  add_script(assets::page());
  if (body.charts > 0) add_script(assets::curves());
  if (body.scenes > 0) add_script(assets::space());
  return html + "</body>\n</html>\n";
}

void write_page(const std::filesystem::path& file, const Page& page) {
  dem::write_file_atomically(file, to_html(page));
}

}  // namespace report
