// What people look at: one self-contained HTML page. It knows nothing of specimens or cards; whoever ran a job
// fills a Page. Values are shown as they are given: convert from SI to the unit that you name (MPa, permil, mm)
// before filling them in.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "report/scene.h"

namespace report {

/// Plain text; a blank line begins a new paragraph.
struct Text {
  std::string body;
};

/// Short remarks, one a line with a mark before it.
struct List {
  std::vector<std::string> items;
};

/// Names and values, one pair a row, e.g. {"E", "30.0 GPa"}.
struct KeyValues {
  std::vector<std::pair<std::string, std::string>> rows;
};

/// A table of words and numbers. Every row has as many cells as there are columns; cells that read as numbers
/// are set right.
struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

/// One thing that a fit aimed at.
struct Target {
  std::string name;           ///< "tensile strength"
  std::string unit;           ///< of `target` and `achieved`, "" if none
  double target = 0;          ///< what was asked
  double achieved = 0;        ///< what came out; NaN if nothing did
  double relative_error = 0;  ///< (achieved - target) / target [-]
  double tolerance = 0;       ///< allowed |relative_error| [-]; 0 means that none was set
  bool met = false;
  std::string source = "";                     ///< where `target` comes from; "" if that goes without saying
  std::optional<double> worst = std::nullopt;  ///< relative error of the worst single specimen [-]
};

/// A table of targets; each row says in words and by a mark whether it was met, and shows the error within its
/// tolerance.
struct Targets {
  std::vector<Target> rows;
};

struct Axis {
  std::string title;      ///< "axial strain"
  std::string unit = "";  ///< "permil"
  bool logarithmic = false;
  std::optional<double> from = std::nullopt;  ///< what is shown at first; without them, all the data
  std::optional<double> to = std::nullopt;
};

struct Series {
  enum class Kind { line, dashed, band, points };
  std::string name;
  Kind kind = Kind::line;
  std::vector<double> x;
  std::vector<double> y;           ///< as long as x; NaN breaks the line; for a band its lower edge
  std::vector<double> upper = {};  ///< a band's upper edge, as long as x; empty for the other kinds
  /// Index of its colour, 0 to 7, to give related series one colour; -1 takes the next free one.
  int colour = -1;
  bool thin = false;  ///< a line that stands back behind the others
};

/// Curves over two axes, drawn in the order given (put bands first). Hover shows values, drag or wheel zooms, a
/// double click resets, buttons save it as SVG and CSV. Without scripts the page shows it still.
struct Chart {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  std::string caption = "";  ///< one or two sentences below
};

/// A Scene becomes a view that turns: coloured by a field, cut, magnified, through time; see report/scene.h.
using Block = std::variant<Text, List, KeyValues, Table, Targets, Chart, Scene>;

struct Section {
  std::string title;
  std::vector<Block> blocks;
};

enum class Verdict { neutral, met, not_met };

struct Page {
  std::string title;
  std::string subtitle;
  Verdict verdict = Verdict::neutral;
  std::string verdict_words;  ///< the result in one sentence, shown first; "" for none
  std::vector<Section> sections;
  std::vector<std::pair<std::string, std::string>>
      provenance;  ///< at the foot: version, command, seeds, hashes
};

/// The whole page. All text is escaped; the page loads nothing from anywhere. Throws std::invalid_argument,
/// naming the chart and the series, if the lengths of a series do not agree, or naming the scene, if something
/// in it does not fit together.
std::string to_html(const Page& page);

/// Writes the page whole or not at all; its folder must exist. Throws dem::RunError if it cannot.
void write_page(const std::filesystem::path& file, const Page& page);

}  // namespace report
