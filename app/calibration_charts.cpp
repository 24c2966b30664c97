#include "app/calibration_charts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "libdem/core/vector.h"
#include "report/html.h"

namespace app {
namespace {

using report::Series;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Colours by what a curve is, not by which seed it has.
enum Colour { fitted = 0, unseen = 1, laboratory = 2, code = 3, plain = 5 };

Series named(std::string name, Series::Kind kind, int colour) {
  Series series;
  series.name = std::move(name);
  series.kind = kind;
  series.colour = colour;
  return series;
}

std::size_t peak_of(const TestCurve& curve) {
  return static_cast<std::size_t>(std::max_element(curve.stress.begin(), curve.stress.end()) -
                                  curve.stress.begin());
}

/// At most about `most` points and the peak: more, nobody can see.
Series drawn(const TestCurve& curve, std::string name, Series::Kind kind, int colour, std::size_t most = 300) {
  Series series = named(std::move(name), kind, colour);
  const std::size_t stride = std::max<std::size_t>(1, curve.strain.size() / most), peak = peak_of(curve);
  if (!curve.strain.empty() && curve.strain.front() > 0 &&
      (kind == Series::Kind::line || kind == Series::Kind::dashed))
    series.x.push_back(0), series.y.push_back(0);
  for (std::size_t k = 0; k < curve.strain.size(); ++k) {
    if (k % stride != 0 && k != peak && k + 1 != curve.strain.size()) continue;
    series.x.push_back(curve.strain[k]);
    series.y.push_back(curve.stress[k]);
  }
  return series;
}

void add_point(Series& series, double x, double y) {
  series.x.push_back(x);
  series.y.push_back(y);
}

std::vector<const TestCurve*> of_kind(const std::vector<TestCurve>& curves, const std::string& test,
                                      const std::string& kind) {
  std::vector<const TestCurve*> list;
  for (const TestCurve& curve : curves)
    if (curve.test == test && curve.kind == kind && !curve.strain.empty()) list.push_back(&curve);
  return list;
}

std::string chart_caption(const Json& result, const std::string& test) {
  const Json lab = result.contains("laboratory") && result["laboratory"].contains(test)
                       ? result["laboratory"][test]
                       : Json::object();
  std::string words;
  if (const int count = lab.value("specimens", 0); count > 0) {
    words =
        fmt::format("Laboratory: {} specimen{}; mean and range, averaged over curves scaled to their peaks.",
                    count, count == 1 ? "" : "s");
    for (const Json& curve : list_of(result, "curves"))
      if (text(curve, "name") == test)
        words += fmt::format(
            " The mean of the fitted curves is off the laboratory's mean by {} of its peak stress (root mean "
            "square, up to where the laboratory curve has fallen to 60 %).",
            with_unit(100 * number(curve, "rmse_rel"), "%", 3));
  } else if (!text(lab, "code").empty()) {
    words = fmt::format(
        "There is no {} test. The dashed curve is the code's ({}), for comparison only: the fit did not see "
        "its shape.",
        test, text(lab, "code"));
  } else {
    words = "The case names no measured curve of this test.";
  }
  return words;
}

double eq1_poisson(const dem::Vec3& abc, double ratio) { return (1 - ratio) / (abc[0] + ratio); }
double eq1_stiffness(const dem::Vec3& abc, double ratio) {
  return (abc[1] + abc[2] * ratio) / (abc[0] + ratio);
}

/// Where one stage gives way to the next, over the height of what the chart shows.
Series borders(const report::Chart& chart, const std::vector<double>& at) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const Series& series : chart.series)
    for (const double y : series.y) low = std::min(low, y), high = std::max(high, y);
  Series lines = named("a stage ends", Series::Kind::dashed, plain);
  lines.thin = true;
  for (const double x : at) {
    add_point(lines, x, low);
    add_point(lines, x, high);
    add_point(lines, x, nan);
  }
  return lines;
}

}  // namespace

report::Chart test_chart(const Json& result, const std::vector<TestCurve>& curves, const std::string& test) {
  report::Chart chart;
  chart.title = test == "tension" ? "Uniaxial tension" : "Uniaxial compression";
  chart.x = {"axial strain", "‰", false, {}, {}};
  chart.y = {"stress", "MPa", false, {}, {}};
  const auto low = of_kind(curves, test, "band low"), high = of_kind(curves, test, "band high");
  if (!low.empty() && !high.empty() && low[0]->strain.size() == high[0]->strain.size()) {
    Series band = named("laboratory, lowest to highest", Series::Kind::band, laboratory);
    band.x = low[0]->strain;
    band.y = low[0]->stress;
    band.upper = high[0]->stress;
    chart.series.push_back(std::move(band));
  }
  double reach = 0;  // how far the virtual curves go
  const auto add_virtual = [&](const char* kind, Series::Kind line, int colour) {
    Series peaks = named(fmt::format("peaks, {}", kind), Series::Kind::points, colour);
    for (const TestCurve* curve : of_kind(curves, test, kind)) {
      chart.series.push_back(drawn(*curve, fmt::format("{}, {}", curve->name, kind), line, colour));
      chart.series.back().thin = colour == unseen;
      add_point(peaks, curve->strain[peak_of(*curve)], curve->stress[peak_of(*curve)]);
      reach = std::max(reach, curve->strain.back());
    }
    return peaks;
  };
  const Series unseen_peaks = add_virtual("unseen", Series::Kind::dashed, unseen);
  const Series fitted_peaks = add_virtual("fitted", Series::Kind::line, fitted);
  for (const TestCurve* curve : of_kind(curves, test, "laboratory")) {
    chart.series.push_back(drawn(*curve, "laboratory, mean", Series::Kind::line, laboratory));
    Series peak = named("peak, laboratory mean", Series::Kind::points, laboratory);
    add_point(peak, curve->strain[peak_of(*curve)], curve->stress[peak_of(*curve)]);
    chart.series.push_back(std::move(peak));
  }
  for (const TestCurve* curve : of_kind(curves, test, "code")) {
    chart.series.push_back(drawn(*curve, "code's curve, not measured", Series::Kind::dashed, code));
    // A code's curve may run on where no test goes.
    if (reach > 0 && curve->strain.back() > 2 * reach) chart.x.from = 0, chart.x.to = 1.5 * reach;
  }
  for (const Series& peaks : {unseen_peaks, fitted_peaks})
    if (!peaks.x.empty()) chart.series.push_back(peaks);
  chart.caption = chart_caption(result, test);
  return chart;
}

std::vector<report::Chart> elastic_charts(const Json& result) {
  const Json fit = result.value("elastic_fit", Json::object());
  if (list_of(fit, "points").empty()) return {};
  const dem::Vec3 own(number(fit, "alpha"), number(fit, "beta"), number(fit, "gamma"));
  const dem::Vec3 paper(3.7, 2.198, 3.79), hentz(2.5, 2.0, 2.65);  // Eq. 3, and Hentz et al. (2004)

  Series poisson = named("specimens", Series::Kind::points, fitted), stiffness = poisson;
  std::vector<std::pair<double, double>> group;  // one specimen's points; its point at Ks/Kn = 1 gives E0
  double before = 2, unit = nan;
  const auto close = [&] {
    for (const auto& [ratio, value] : group) add_point(stiffness, ratio, value / unit);
    group.clear();
    unit = nan;
  };
  // A specimen's points rise in Ks/Kn up to 1; then comes the one at the operating ratio.
  bool complete = false;
  for (const Json& point : fit["points"]) {
    const double ratio = number(point, "shear_ratio"), value = number(point, "stiffness");
    if (complete && ratio < before && group.size() > 1 && group.back().first < 1) close(), complete = false;
    group.emplace_back(ratio, value);
    if (ratio == 1) unit = value, complete = true;
    add_point(poisson, ratio, number(point, "nu"));
    before = ratio;
  }
  close();

  report::Chart nu, modulus;
  nu.title = "Poisson's ratio over Ks/Kn";
  nu.y = {"Poisson's ratio ν", "", false, {}, {}};
  modulus.title = "Young's modulus over Ks/Kn";
  modulus.y = {"E/E₀", "", false, {}, {}};
  nu.x = modulus.x = {"Ks/Kn", "", false, 0.0, 1.02};
  const auto add_curve = [&](const std::string& name, const dem::Vec3& abc, Series::Kind kind, int colour) {
    Series a = named(name, kind, colour), b = a;
    for (int k = 0; k <= 50; ++k) {
      const double ratio = k / 50.0;
      add_point(a, ratio, eq1_poisson(abc, ratio));
      add_point(b, ratio, eq1_stiffness(abc, ratio) / eq1_stiffness(abc, 1));
    }
    nu.series.push_back(std::move(a));
    modulus.series.push_back(std::move(b));
  };
  const auto constants = [](const char* whose, const dem::Vec3& abc) {
    return fmt::format("{}: α {:.4g}, β {:.4g}, γ {:.4g}", whose, abc[0], abc[1], abc[2]);
  };
  add_curve(constants("Hentz et al.", hentz), hentz, Series::Kind::dashed, plain);
  add_curve(constants("the paper", paper), paper, Series::Kind::dashed, code);
  add_curve(constants("this fit", own), own, Series::Kind::line, fitted);
  nu.series.push_back(std::move(poisson));
  modulus.series.push_back(std::move(stiffness));
  const double at = number(fit, "operating_ratio");
  Series mark = named("where the card works", Series::Kind::points, unseen);
  add_point(mark, at, eq1_poisson(own, at));
  nu.series.push_back(mark);
  mark.y = {eq1_stiffness(own, at) / eq1_stiffness(own, 1)};
  modulus.series.push_back(std::move(mark));
  nu.caption = fmt::format(
      "Static solves on each fitted specimen. Eq. 1 misses ν by {:.4f} (root mean square over all ratios); it "
      "is "
      "fitted to be right where the card works, at Ks/Kn = {}.",
      number(fit, "poisson_rms"), report::number_text(at, 4));
  modulus.caption = fmt::format("E₀ is the modulus at Ks/Kn = 1. Eq. 1 misses E by {} (root mean square).",
                                with_unit(100 * number(fit, "stiffness_rms"), "%", 2));
  return {std::move(nu), std::move(modulus)};
}

std::vector<report::Chart> progress_charts(const Json& result) {
  const Json& history = list_of(result, "history");
  if (history.empty()) return {};
  const auto steps = static_cast<double>(history.size());
  report::Chart misfit, path;
  misfit.title = "Worst misfit of a target, over its tolerance";
  misfit.x = path.x = {"evaluation", "", false, 0.0, steps + 1};
  misfit.y = {"misfit / tolerance", "", true, {}, {}};
  path.title = "Path of the parameters";
  path.y = {"value / final value", "", true, {}, {}};
  misfit.series.push_back(named("tolerance", Series::Kind::dashed, plain));
  add_point(misfit.series.back(), 0, 1);
  add_point(misfit.series.back(), steps + 1, 1);

  std::vector<Series> best;
  std::string stages;
  std::vector<double> ends;
  double lowest = 0;
  for (std::size_t k = 0; k < history.size(); ++k) {
    const std::string stage = text(history[k], "stage");
    const double at = static_cast<double>(k) + 1, worst = std::max(number(history[k], "worst"), 0.01);
    const bool begins = k == 0 || stage != text(history[k - 1], "stage");
    if (begins) {
      const int colour = static_cast<int>(best.size()) % 5;
      misfit.series.push_back(named(stage, Series::Kind::points, colour));
      best.push_back(named(stage + ", best so far", Series::Kind::line, colour));
      lowest = worst;
      if (k > 0) ends.push_back(at - 0.5);
      stages += fmt::format("{}{} from evaluation {}", stages.empty() ? "" : ", ", stage, k + 1);
    }
    lowest = std::min(lowest, worst);
    add_point(misfit.series.back(), at, worst);
    add_point(best.back(), at, lowest);
  }
  misfit.series.insert(misfit.series.end(), best.begin(), best.end());
  misfit.caption = fmt::format(
      "Each stage counts its own targets: {}. At or below 1, all of them are within their tolerance.", stages);

  int colour = 0;
  for (const auto& [key, name] : {std::pair("T", "T"), std::pair("zeta", "ζ"), std::pair("Co", "Co"),
                                  std::pair("slip_softening", "ζs")}) {
    Series line = named(name, Series::Kind::line, colour++);
    const double last = number(result["card"], key);
    if (!(last > 0)) continue;
    bool moves = false;
    for (std::size_t k = 0; k < history.size(); ++k) {
      add_point(line, static_cast<double>(k) + 1, number(history[k], key) / last);
      moves = moves || std::abs(line.y.back() - 1) > 1e-9;
    }
    if (moves) path.series.push_back(std::move(line));
  }
  path.caption = fmt::format("Every point that the fit tried: {}.", stages);
  std::vector<report::Chart> charts{std::move(misfit)};
  if (!path.series.empty()) charts.push_back(std::move(path));
  if (!ends.empty())
    for (report::Chart& chart : charts) chart.series.push_back(borders(chart, ends));
  return charts;
}

}  // namespace app
