// The report: one file that loads nothing, escapes whatever it is given, and has the numbers.
#include "report/page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "libdem/core/error.h"
#include "report/chart_svg.h"
#include "report/html.h"

using testing::HasSubstr;
using testing::Not;

namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();

report::Chart stress_strain() {
  report::Chart chart;
  chart.title = "Uniaxial tension";
  chart.x = {"axial strain", "permil"};
  chart.y = {"stress", "MPa"};
  chart.series.push_back(
      {"range over seeds", report::Series::Kind::band, {0, 0.1, 0.2}, {0, 2.5, 1.0}, {0, 3.0, 1.5}, 0});
  chart.series.push_back({"fitted, mean", report::Series::Kind::line, {0, 0.1, 0.2}, {0, 2.75, 1.25}, {}, 0});
  chart.series.push_back({"measured", report::Series::Kind::points, {0, 0.1, 0.15}, {0, 2.8125, kNan}, {}});
  return chart;
}

report::Page example() {
  report::Page page;
  page.title = "Calibration of M7";
  page.subtitle = "3 specimens";
  page.verdict = report::Verdict::not_met;
  page.verdict_words = "2 of 3 targets met.";
  page.sections = {
      {"Targets",
       {report::Text{"First.\n\nSecond."},
        report::Targets{{{"tensile strength", "MPa", 2.8, 2.8222, 0.0079286, 0.03, true},
                         {"compressive strength", "MPa", 40, 33.5, -0.1625, 0.05, false},
                         {"strain at peak", "permil", 0.1, kNan, kNan, 0.1, false}}},
        report::KeyValues{{{"E", "30.0 GPa"}}}, report::Table{{"seed", "ft"}, {{"1", "2.91"}, {"2", "3.02"}}}}},
      {"Curves", {stress_strain(), stress_strain()}}};
  page.provenance = {{"command", "spall calibrate case.toml"}};
  return page;
}

// The JSON between the chart's script tags.
nlohmann::json embedded_data(const std::string& html) {
  const std::string open = "<script type=\"application/json\">";
  const auto begin = html.find(open) + open.size();
  return nlohmann::json::parse(html.substr(begin, html.find("</script>", begin) - begin));
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++found;
  return found;
}

}  // namespace

TEST(Report, IsOneFileThatLoadsNothing) {
  const std::string html = report::to_html(example());
  // The scripts are others' code and name what they never load (the policy forbids it, and tests/browser
  // looks).
  std::string own = html;
  for (std::size_t at; (at = own.find("<script>")) != std::string::npos;)
    own.erase(at, own.find("</script>", at) + 9 - at);
  EXPECT_FALSE(std::regex_search(
      own, std::regex("https?:|\\ssrc=|<link|@import|url\\((?!#)|fetch\\(|XMLHttp|WebSocket")));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  EXPECT_THAT(html, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_LT(own.size(), 60000u);
  EXPECT_LT(html.size(), 1500000u);
}

TEST(Report, SaysNumbersVerdictsAndErrorsInWords) {
  const std::string html = report::to_html(example());
  for (const char* expected :
       {"2 of 3 targets met.", "2.822 MPa", "+0.79 %", "−16.2 %", "± 3 %", "30.0 GPa", "<p>First.</p>",
        "<p>Second.</p>", "<td class=\"number\">3.02</td>", "spall calibrate case.toml"})
    EXPECT_THAT(html, HasSubstr(expected));
  EXPECT_EQ(count(html, "</span> met</td>"), 1u);
  EXPECT_EQ(count(html, "</span> not met</td>"), 2u);
  EXPECT_FALSE(std::regex_search(html, std::regex("[> ]-?nan[< ]")));
}

TEST(Report, CarriesTheDataOfItsCharts) {
  const auto data = embedded_data(report::to_html(example()));
  EXPECT_EQ(data["series"][0]["kind"], "band");
  EXPECT_EQ(data["series"][0]["upper"][1], 3.0);
  EXPECT_EQ(data["series"][1]["y"][1], 2.75);
  EXPECT_TRUE(data["series"][2]["y"][2].is_null());
  EXPECT_EQ(data["x"]["unit"], "permil");
  EXPECT_EQ(data["series"][1]["colour"], data["series"][0]["colour"]);
  EXPECT_NE(data["series"][2]["colour"], data["series"][0]["colour"]);
}

TEST(Report, DrawsItsCurvesWithoutTheScript) {
  const std::string svg = report::static_svg(stress_strain(), "clip1");
  EXPECT_EQ(count(svg, "class=\"band c0\""), 1u);
  EXPECT_EQ(count(svg, "class=\"line c0\""), 1u);
  EXPECT_THAT(svg, HasSubstr("axial strain [permil]"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  // Clip paths need names of their own.
  const std::string html = report::to_html(example());
  EXPECT_EQ(count(html, "<clipPath id=\"clip1\">"), 1u);
  EXPECT_EQ(count(html, "<clipPath id=\"clip2\">"), 1u);
}

TEST(Report, EscapesWhateverItIsGiven) {
  const std::string bad = "</script><script>alert(1)</script><!-- \" ' & \x01 \xff";
  report::Page page = example();
  page.title = page.subtitle = page.verdict_words = bad;
  page.provenance = {{bad, bad}};
  auto chart = stress_strain();
  chart.title = chart.x.title = chart.y.unit = chart.caption = chart.series[1].name = bad;
  page.sections = {{bad,
                    {report::Text{bad}, report::KeyValues{{{bad, bad}}}, report::Table{{bad}, {{bad}}},
                     report::Targets{{{bad, bad, 1, 1, 0, 0.1, true}}}, chart}}};
  const std::string html = report::to_html(page);
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<!-- ")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)"));
  const std::string kept = embedded_data(html)["series"][1]["name"];
  EXPECT_THAT(kept, HasSubstr("</script><script>alert(1)</script><!-- \" ' & "));
}

TEST(Report, RefusesSeriesOfUnequalLengths) {
  report::Page page = example();
  auto chart = stress_strain();
  chart.series[1].y.pop_back();
  page.sections = {{"", {chart}}};
  try {
    report::to_html(page);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("Uniaxial tension"), HasSubstr("fitted, mean")));
  }
  chart = stress_strain();
  chart.series[0].upper.clear();
  page.sections = {{"", {chart}}};
  EXPECT_THROW(report::to_html(page), std::invalid_argument);
}

TEST(Report, SurvivesChartsWithLittleInThem) {
  report::Chart empty;
  EXPECT_THAT(report::static_svg(empty, "a"), Not(HasSubstr("nan")));
  report::Chart flat;
  flat.series.push_back({"flat", report::Series::Kind::line, {1, 1}, {0, 0}, {}});
  EXPECT_THAT(report::static_svg(flat, "b"), testing::AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf"))));
  report::Chart logarithmic;
  logarithmic.x.logarithmic = logarithmic.y.logarithmic = true;
  logarithmic.series.push_back({"decades", report::Series::Kind::line, {-1, 0, 1, 1000}, {1, 1, 1e-5, 10}, {}});
  EXPECT_THAT(report::static_svg(logarithmic, "c"),
              testing::AllOf(Not(HasSubstr("nan")), Not(HasSubstr("inf")), HasSubstr("10⁻⁵")));
}

TEST(Report, PutsTicksAtRoundNumbers) {
  const auto small = report::ticks_of({0, 2.4e-3}, false, 6);
  EXPECT_EQ(small.power, -3);
  EXPECT_THAT(small.labels, testing::ElementsAre("0.0", "0.5", "1.0", "1.5", "2.0"));
  EXPECT_THAT(report::ticks_of({-30, 30}, false, 6).labels,
              testing::ElementsAre("−30", "−20", "−10", "0", "10", "20", "30"));
  EXPECT_THAT(report::ticks_of({1e-2, 1e2}, true, 6).labels,
              testing::ElementsAre("0.01", "0.1", "1", "10", "100"));
}

TEST(Report, ShowsSourcesWorstSpecimensRemarksAndThinLines) {
  report::Page page = example();
  auto& targets = std::get<report::Targets>(page.sections[0].blocks[1]);
  EXPECT_THAT(report::to_html(page), Not(HasSubstr("Worst single")));
  targets.rows[0].source = "mean of <5> curves";
  targets.rows[0].worst = -0.0321;
  page.sections[0].blocks.emplace_back(report::List{{"zeta & Co"}});
  std::get<report::Chart>(page.sections[1].blocks[0]).series[1].thin = true;
  const std::string html = report::to_html(page);
  for (const char* expected : {"Worst single", "−3.21 %", "mean of &lt;5&gt; curves", "<li>zeta &amp; Co</li>",
                               "class=\"line thin c0\"", "\"thin\":true"})
    EXPECT_THAT(html, HasSubstr(expected));
}

TEST(Report, WritesNumbersForReaders) {
  EXPECT_EQ(report::number_text(2.8222), "2.822");
  EXPECT_EQ(report::number_text(30000), "30000");
  EXPECT_EQ(report::number_text(123456), "123456");
  EXPECT_EQ(report::number_text(3e10), "3·10¹⁰");
  EXPECT_EQ(report::number_text(1.25e-5), "1.25·10⁻⁵");
  EXPECT_EQ(report::number_text(INFINITY), "–");
}

TEST(Report, IsWrittenToAFileOrFailsWithItsName) {
  const auto file = std::filesystem::path(testing::TempDir()) / "spall-report-test.html";
  report::write_page(file, example());
  std::stringstream content;
  content << std::ifstream(file).rdbuf();
  EXPECT_EQ(content.str(), report::to_html(example()));
  std::filesystem::remove(file);
  EXPECT_THROW(report::write_page("/nonexistent/folder/report.html", example()), dem::RunError);
}
