// Wrong inputs as people really give them. Each is refused by the real command: its exit code, one line on
// standard error that says where, what and how to put it right, and nothing written. None of them computes
// anything.
#include <algorithm>
#include <sstream>

#include "tests/cli/command.h"

using cli::good_card;
using cli::replaced;
using testing::HasSubstr;

namespace {

using Files = std::vector<std::pair<std::string, std::string>>;  // name, content

struct BadInput {
  std::string name;
  Files files;
  std::vector<std::string> told;  // what the line must contain
  std::vector<std::string> command{"calibrate", "case.toml", "-o", "out"};
  int code = 2;
};

void PrintTo(const BadInput& input, std::ostream* out) { *out << input.name; }

const std::string good_case = R"([targets]
E = "30 GPa"
nu = 0.2
ft = "3 MPa"
fc = "30 MPa"
[specimen]
size = "0.4x0.2x0.2 m"
elements = 1400
fit_seeds = [1]
check_seeds = [2]
)";

/// A parabola to 30 MPa at 2 permil and down again, as a laboratory would export it.
std::string curve(const std::string& header = "strain[-],stress[MPa]", double strain_factor = 1,
                  double stress_factor = 1, int rows = 60) {
  std::ostringstream text;
  text << header << "\n";
  for (int k = 1; k <= rows; ++k) {
    const double eta = 1.3 * k / 60;
    text << strain_factor * 2e-3 * eta << "," << stress_factor * 30 * eta * (2 - eta) << "\n";
  }
  return text.str();
}

const std::string header = "strain[-],stress[MPa]\n";
const std::string curve_case = "[compression]\ncurves = [\"curve.csv\"]\n";

/// The good case with one thing changed.
BadInput changed(const std::string& name, const std::string& what, const std::string& by,
                 std::vector<std::string> told) {
  const auto at = good_case.find(what);
  std::string text = good_case;
  if (at == std::string::npos)
    text = "no such text: " + what;
  else
    text.replace(at, what.size(), by);
  return {name, {{"case.toml", text}}, std::move(told)};
}

/// The good case with lines before it (no table) or after it (a table of their own).
BadInput with(const std::string& name, const std::string& lines, std::vector<std::string> told) {
  return {name, {{"case.toml", lines.front() == '[' ? good_case + lines : lines + good_case}}, std::move(told)};
}

/// A case of one compression curve.
BadInput of_curve(const std::string& name, const std::string& csv, std::vector<std::string> told,
                  const std::string& keys = "") {
  if (std::none_of(told.begin(), told.end(),
                   [](const std::string& part) { return part.starts_with("case.toml"); }))
    told.emplace_back("curve.csv");
  return {name, {{"case.toml", curve_case + keys}, {"curve.csv", csv}}, std::move(told)};
}

BadInput whole_case(const std::string& name, const std::string& text, std::vector<std::string> told) {
  return {name, {{"case.toml", text}}, std::move(told)};
}

BadInput command(const std::string& name, std::vector<std::string> words, std::vector<std::string> told,
                 int code = 2) {
  return {name, {{"case.toml", good_case}, {"card.toml", good_card}}, std::move(told), std::move(words), code};
}

/// Row `row` of the good curve (its line in the file) becomes `cells`.
std::string with_row(int row, const std::string& cells) {
  std::istringstream in(curve());
  std::string text, line;
  for (int k = 1; std::getline(in, line); ++k) text += (k == row ? cells : line) + "\n";
  return text;
}

std::vector<BadInput> curves() {
  std::string loop = curve();
  loop += "0.001,20\n0.003,10\n";
  return {
      of_curve("MissingColumn", curve("eps[-],stress[MPa]"),
               {"no column \"strain\"", "There are: eps, stress"}),
      of_curve("ColumnInOtherCase", curve("Strain[-],stress[MPa]"), {"did you mean \"Strain\""}),
      of_curve("MappedColumnMissing", curve(), {"no column \"gauge\""}, "strain = \"gauge\"\n"),
      of_curve("UnitThatIsNoStress", curve("strain[-],stress[kg]"),
               {"\"kg\" is no unit of stress", "stress[MPa]"}),
      of_curve("ForceInsteadOfStress", curve("strain[-],stress[kN]"),
               {"kN", "divide the force by the loaded area"}),
      of_curve("MisspeltUnit", curve("strain[-],stress[Mpa]"), {"did you mean \"MPa\"?"}),
      of_curve("NoUnit", curve("strain,stress"), {"the stress has no unit", "stress_unit = \"MPa\""}),
      of_curve("UnitTwice", curve(), {"its header says [MPa]", "\"kPa\""}, "stress_unit = \"kPa\"\n"),
      of_curve("LengthWithoutGauge", curve("strain[mm],stress[MPa]"), {"gauge_length = \"100 mm\""}),
      of_curve("Backwards", with_row(30, "0.0001,20"),
               {"row 30", "the strain goes backwards", "correct the row"}),
      of_curve("BackwardsAfterThePeak", with_row(55, "0.0021,25"),
               {"row 55", "the strain goes backwards", "only_rows"}),
      of_curve("ReverseOrder", header + "0.002,30\n0.0019,29\n" + curve().substr(header.size()), {"row"}),
      of_curve("NanInACell", with_row(12, "nan,20"), {"row 12", "column \"strain\"", "\"nan\"", "#"}),
      of_curve("InfinityInACell", with_row(12, "0.0005,inf"), {"row 12", "\"inf\""}),
      of_curve("EmptyCell", with_row(12, "0.0005,"), {"row 12", "the cell is empty"}),
      of_curve("WordInACell", with_row(12, "0.0005,off"), {"row 12", "\"off\""}),
      of_curve("RaggedRow", with_row(12, "0.0005"), {"row 12", "has 1 cell", "header has 2"}),
      of_curve("OpenQuote", with_row(12, "0.0005,\"20"), {"row 12", "a quote is opened"}),
      of_curve("EmptyFile", "", {"is empty", "needs a header"}),
      of_curve("BlankFile", "\n \n# nothing\n", {"is empty"}),
      of_curve("HeaderOnly", header, {"a header and no rows"}),
      of_curve("NoHeader", curve().substr(header.size()), {"row 1", "numbers where the header is due"}),
      of_curve("FewRows", curve("strain[-],stress[MPa]", 1, 1, 12), {"12 rows", "at least 20"}),
      of_curve("NoPeak", curve("strain[-],stress[MPa]", 1, 1, 25), {"no peak", "may_end_at_peak = true"}),
      of_curve("Spike", with_row(30, "0.0012566,80"), {"row 30", "sticks out", "#"}),
      of_curve("NegativeIsCompression", curve("strain[-],stress[MPa]", -1, -1), {"sign = ", "compression"}),
      of_curve("StrainOfOtherSign", curve("strain[-],stress[MPa]", -1, 1), {"strain_sign"}),
      of_curve("PermilTakenAsStrain", curve("strain[-],stress[MPa]", 1e3), {"permil instead of -"}),
      of_curve("PascalTakenAsMegapascal", curve("strain[-],stress[MPa]", 1, 1e6), {"Pa instead of MPa"}),
      of_curve("KilopascalTakenAsMegapascal", curve("strain[-],stress[MPa]", 1, 1e3), {"kPa instead of MPa"}),
      of_curve("DecimalCommas", with_row(12, "0,0005,20,1"), {"row 12", "semicolons"}),
      of_curve("CommaAndPoint", "strain[-];stress[MPa]\n0,001;10.5\n0.002;11\n", {"row 3", "decimal comma"}),
      of_curve("Utf16", std::string("\xFF\xFEs\0t\0", 6), {"UTF-16", "UTF-8"}),
      of_curve("BinaryCurve", std::string("\x89HDF\r\n\x1a\n\0\0", 10), {"no text at all"}),
      of_curve("FilterKeepsNothing", curve(), {"no row has strain = 7"},
               "only_rows = { column = \"strain\", equals = 7 }\n"),
      of_curve("FilterOfNoColumn", curve(), {"no column \"phase\""},
               "only_rows = { column = \"phase\", equals = 1 }\n"),
      {"SameFileTwice",
       {{"case.toml", "[compression]\ncurves = [\"curve.csv\", \"*.csv\"]\n"}, {"curve.csv", curve()}},
       {"curve.csv", "named twice", "once"}},
      whole_case("MissingCurve", curve_case, {"case.toml:2: compression.curves", "no file \"curve.csv\""}),
      whole_case(
          "GlobMatchesNothing", replaced(curve_case, "curve.csv", "lab/*.csv"),
          {"case.toml:2: compression.curves", "no file matches \"lab/*.csv\"", "relative to the case file"}),
      whole_case("NoCurves", "[compression]\ncurves = []\n", {"compression.curves", "names no file"}),
      whole_case("CurvesAsText", "[compression]\ncurves = \"a.csv\"\n",
                 {"compression.curves", "is not a list"}),
      whole_case("AFolderAsCurve", "[compression]\ncurves = [\".\"]\n",
                 {"compression.curves", "no file \".\""}),
      of_curve("UnknownSign", curve(), {"case.toml:3: compression.sign", "did you mean \"tension_positive\"?"},
               "sign = \"tension\"\n"),
      of_curve("NegativeGauge", curve(), {"case.toml:3: compression.gauge_length", "greater than 0"},
               "gauge_length = \"-1 mm\"\n"),
      of_curve("GaugeOfNoColumn", curve(),
               {"case.toml:3: compression.post_peak_gauge_length", "post_peak_strain"},
               "post_peak_gauge_length = \"10 mm\"\n"),
      with("KeysOfCurvesWithoutCurves", "[tension]\nstrain = \"eps\"\n", {"tension.strain", "there are none"}),
      with("FitOfNoCurve", "[tension]\nfit_curve = true\n", {"tension.fit_curve", "curves = ["}),
  };
}

std::vector<BadInput> targets() {
  return {
      changed("NegativeModulus", "\"30 GPa\"", "\"-30 GPa\"", {"case.toml:2: targets.E", "0.1 GPa to 200 GPa"}),
      changed("ModulusInPascal", "\"30 GPa\"", "\"30 Pa\"", {"case.toml:2: targets.E", "0.1 GPa to 200 GPa"}),
      changed("PoissonAboveItsBound", "nu = 0.2", "nu = 0.3", {"case.toml:3: targets.nu", "1/alpha"}),
      changed("NegativePoisson", "nu = 0.2", "nu = -0.2", {"case.toml:3: targets.nu", "0.02 to 0.26"}),
      changed("NotANumber", "nu = 0.2", "nu = nan", {"case.toml:3: targets.nu", "finite"}),
      changed("BareStress", "\"3 MPa\"", "3", {"case.toml:4: targets.ft", "unit is missing", "ft = \"3 GPa\""}),
      changed("StressOfNoUnit", "\"3 MPa\"", "\"3\"", {"targets.ft", "unit is missing"}),
      changed("StressInNewton", "\"3 MPa\"", "\"3 N\"", {"targets.ft", "not a unit of stress"}),
      changed("StressOfUnknownUnit", "\"3 MPa\"", "\"3 Mpa\"", {"targets.ft", "no unit that is known"}),
      changed("StressInWords", "\"3 MPa\"", "\"three\"", {"targets.ft", "finite number"}),
      changed("DecimalComma", "\"3 MPa\"", "\"3,1 MPa\"", {"targets.ft", "\"24 GPa\""}),
      changed("StressAsList", "\"3 MPa\"", "[3, 4]", {"targets.ft", "is not a quantity"}),
      changed("UnknownKey", "ft =", "ftt =", {"case.toml:4: targets.ftt", "did you mean \"ft\"?"}),
      changed("UnknownTable", "[specimen]", "[specimens]", {"specimens", "did you mean \"specimen\"?"}),
      changed("TwiceTheSameKey", "nu = 0.2", "E = \"20 GPa\"", {"case.toml:3", "not TOML"}),
      changed("SyntaxError", "nu = 0.2", "nu == 0.2", {"case.toml:3", "not TOML", "key = value"}),
      changed("OpenText", "\"30 GPa\"", "\"30 GPa", {"case.toml:2", "not TOML"}),
      changed("TensionAboveCompression", "\"3 MPa\"", "\"31 MPa\"",
              {"ft and fc", "contradict", "check the units"}),
      changed("TensionStrainBelowElastic", "nu = 0.2", "ft_strain = \"0.05 permil\"",
              {"ft_strain", "contradict", "elastic"}),
      changed("CompressionStrainBelowElastic", "nu = 0.2", "fc_strain = \"0.5 permil\"",
              {"fc_strain", "contradict", "elastic"}),
      changed("EnergyAsStress", "nu = 0.2", "Gf = \"100 Pa\"", {"targets.Gf", "146.5 N/m"}),
      changed("NegativeEnergy", "nu = 0.2", "Gf = \"-100 N/m\"", {"targets.Gf", "0.1 N/m to 100 kN/m"}),
      changed("NoModulus", "E = \"30 GPa\"\n", "", {"targets.E", "is missing", "[code]"}),
      whole_case("NoStrength", "[targets]\nE = \"30 GPa\"\n", {"name neither ft nor fc", "give at least one"}),
      whole_case("NothingAtAll", "name = \"x\"\n", {"targets.E", "is missing"}),
      {"GivenFarFromCurves",
       {{"case.toml", curve_case + "[targets]\nfc = \"50 MPa\"\n"}, {"curve.csv", curve()}},
       {"targets.fc", "50 MPa contradicts the curves, which give 30", "drop one"}},
      {"ToleranceOfNoTarget",
       {{"case.toml", good_case + "[targets.tolerance]\nGf = 0.1\n"}},
       {"targets.tolerance.Gf", "does not have"}},
      with("ToleranceNegative", "[targets.tolerance]\nft = -0.1\n",
           {"targets.tolerance.ft", "above 0, below 1"}),
      with("ToleranceInPercent", "[targets.tolerance]\nft = 2\n", {"targets.tolerance.ft", "0.02 is 2%"}),
      with("ToleranceOfNothing", "[targets.tolerance]\nfx = 0.1\n",
           {"targets.tolerance.fx", "did you mean \"f"}),
      with("UnseenZero", "[targets.tolerance]\nunseen = 0\n", {"targets.tolerance.unseen", "above 0"}),
      with("UnknownEnds", "[tension]\nends = \"clamped\"\n",
           {"case.toml:12: tension.ends", "\"clamped\"", "free, fixed"}),
      with("RateWithUnit", "[tension]\nrate = \"0.1 m/s\"\n", {"tension.rate", "not a finite number"}),
      with("RateTooHigh", "[tension]\nrate = 3\n", {"tension.rate", "0 (chosen) to 1"}),
      with("DampingTooHigh", "damping = 1.5\n", {"case.toml:1: damping", "0 to below 1"}),
      with("NotesAsText", "notes = \"a note\"\n", {"case.toml:1: notes", "is not a list"}),
      with("UnknownCode", "[code]\ncode = \"model_code_2020\"\nstrength_class = \"C40/50\"\n",
           {"code.code", "did you mean \"model_code_2010\"?"}),
      with("NoStrengthClass", "[code]\ncode = \"model_code_2010\"\n", {"code.strength_class", "\"C40/50\""}),
      with("UnknownStrengthClass", "[code]\nstrength_class = \"B35\"\n", {"code.strength_class", "B35"}),
      with("CubeBelowCylinder", "[code]\nstrength_class = \"C50/40\"\n", {"code.strength_class", "\"C50/40\""}),
      with("ClassOutsideTheCode", "[code]\nstrength_class = \"C200\"\n",
           {"case.toml:12: code.strength_class", "120"}),
      with("UnknownAggregate", "[code]\nstrength_class = \"C40/50\"\naggregate = \"granit\"\n",
           {"code.aggregate", "quartzite"}),
      with("WhatACodeDoesNotGive",
           "[code]\ncode = \"eurocode2_2004\"\nstrength_class = \"C40/50\"\nuse = [\"Gf\"]\n",
           {"code.use", "does not give Gf", "another code"}),
      with("WhatNoCodeGives", "[code]\nstrength_class = \"C40/50\"\nuse = [\"tension_curve\"]\n",
           {"code.use", "no target that a code gives", "allowed: E, nu, ft, ft_strain, fc"}),
      with("FixedAndStarted", "[fixed]\nzeta = 5\n[start]\nzeta = 4\n", {"start.zeta", "is fixed as well"}),
      with("NegativeT", "[fixed]\nT = \"-3 MPa\"\n", {"case.toml:12: fixed.T", "allowed: 0.01 to 1000 MPa"}),
      with("ZetaTooLarge", "[fixed]\nzeta = 500\n", {"fixed.zeta", "allowed: 0.5 to 100"}),
      with("StartOutsideItsBounds", "[start]\nzeta = 0.1\n", {"start.zeta", "allowed: 0.5 to 100"}),
      with("FixedByLongName", "[fixed]\ncohesion = \"5 MPa\"\n", {"fixed.cohesion", "did you mean \"Co\"?"}),
      with("FrictionInRadians", "[fixed]\nphi_i = \"6 rad\"\n", {"fixed.phi_i", "0 to 89 degrees"}),
      with("FrictionBare", "[fixed]\nphi_i = 6\n", {"fixed.phi_i", "unit is missing", "6 degree"}),
      with("LightAsAir", "[fixed]\ndensity = \"2.4 kg/m3\"\n", {"fixed.density", "kg/m3"}),
      with("UnknownUnloading", "[fixed]\nunloading = \"plastic\"\n", {"fixed.unloading", "secant, elastic"}),
  };
}

std::vector<BadInput> specimens() {
  const std::string cut = good_case.substr(0, good_case.find("[specimen]")) +
                          "[specimen]\nsize = \"0.2x0.2x0.2 m\"\ncut_from = \"slab.h5\"\n";
  const std::string at = "fit_centres = [\"0.2,0.2,0.2 m\"]\n";
  return {
      changed("SeedTwice", "fit_seeds = [1]", "fit_seeds = [3, 3]",
              {"specimen.fit_seeds", "the seed 3 stands twice"}),
      changed("SeedSeenAndUnseen", "check_seeds = [2]", "check_seeds = [1]",
              {"case.toml:10: specimen.check_seeds", "the seed 1 stands twice"}),
      changed("SeedOfTheDefault", "fit_seeds = [1]\ncheck_seeds = [2]", "fit_seeds = [101]",
              {"specimen.check_seeds", "the seed 101 stands twice", "unless it is given"}),
      changed("NegativeSeed", "[1]", "[-1]", {"specimen.fit_seeds", "-1 is negative"}),
      changed("SeedWithFraction", "[1]", "[1.5]", {"specimen.fit_seeds", "not an integer"}),
      changed("NoSeed", "fit_seeds = [1]", "fit_seeds = []", {"specimen.fit_seeds", "is empty"}),
      changed("TooFewElements", "1400", "14",
              {"case.toml:8: specimen.elements", "elements across", "take more"}),
      changed("FewInside", "0.4x0.2x0.2 m\"\nelements = 1400", "0.25x0.25x0.25 m\"\nelements = 550",
              {"specimen.elements", "at least 100 are needed", "take more"}),
      changed("NoElements", "1400", "0", {"case.toml:8: specimen.elements", "it must be from 1 to"}),
      changed("ElementsAsText", "1400", "\"1400\"", {"specimen.elements", "not an integer"}),
      changed("TwoLengthsForABox", "0.4x0.2x0.2 m", "0.4x0.2 m",
              {"specimen.size", "has 2 lengths", "three sides"}),
      changed("BareSize", "0.4x0.2x0.2 m", "0.4x0.2x0.2", {"specimen.size", "unit is missing"}),
      changed("SizeAsNumber", "\"0.4x0.2x0.2 m\"", "0.4", {"specimen.size", "is not a list"}),
      changed("ZeroSide", "0.4x0.2x0.2 m", "0.4x0x0.2 m", {"specimen.size", "1 mm to 100 m"}),
      changed("CylinderOfThreeLengths", "[specimen]", "[specimen]\nshape = \"cylinder\"",
              {"specimen.size", "diameter x length"}),
      changed("CylinderWithoutSize", "size = \"0.4x0.2x0.2 m\"", "shape = \"cylinder\"",
              {"specimen.size", "is missing", "diameter x length"}),
      changed("UnknownShape", "[specimen]", "[specimen]\nshape = \"cube\"",
              {"specimen.shape", "box, cylinder"}),
      changed("SizeRatioTooLarge", "[specimen]", "[specimen]\nsize_ratio = 50",
              {"case.toml:7: specimen.size_ratio", "allowed: 1 to"}),
      with("CentresWithoutStructure", "[x]\n", {"x: unknown key", "allowed: name"}),
      changed("CentresOfNothing", "fit_seeds = [1]", "fit_centres = [\"0.1,0.1,0.1 m\"]",
              {"specimen.fit_centres", "cut_from = "}),
      whole_case("StructureMissing", cut + at, {"specimen.cut_from", "slab.h5"}),
      {"StructureIsText", {{"case.toml", cut + at}, {"slab.h5", "not HDF5"}}, {"specimen.cut_from", "slab.h5"}},
      whole_case("CutWithSeeds", cut + at + "fit_seeds = [1]\n",
                 {"specimen.fit_seeds", "no meaning beside cut_from"}),
      whole_case("CutNowhere", cut, {"specimen.fit_centres", "missing"}),
      whole_case("CutAtNoPoint", cut + "fit_centres = [\"0.2,0.2 m\"]\n",
                 {"specimen.fit_centres", "instead of 3", "1.25,1.0,0.14 m"}),
      whole_case("CutTwice", cut + at + "check_centres = [\"0.2,0.2,0.2 m\"]\n",
                 {"specimen.check_centres", "stands twice"}),
  };
}

std::vector<BadInput> commands() {
  const std::vector<std::string> tension{"test",   "tension",   "--specimen", "s.h5",
                                         "--card", "card.toml", "-o",         "out"};
  const auto more = [](std::vector<std::string> words, const std::vector<std::string>& rest) {
    words.insert(words.end(), rest.begin(), rest.end());
    return words;
  };
  BadInput binary = whole_case("BinaryCase", std::string("\x89HDF\r\n\x1a\n\0\xff\xfe", 11), {"case.toml:1"});
  BadInput latin = whole_case("CaseInLatin1",
                              "name = \"Gr\xfc\xdf"
                              "e\"\n",
                              {"case.toml:1", "not TOML"});
  BadInput card{"CardWithoutT",
                {{"card.toml", replaced(good_card, "T = \"3.1 MPa\"\n", "")}},
                {"card.toml: T: the key is missing"},
                {"card", "check", "card.toml"}};
  BadInput soft{"CardOfTooLargePoisson",
                {{"card.toml", replaced(good_card, "nu = 0.2", "nu = 0.3")}},
                {"card.toml:2: nu", "1/alpha"},
                {"card", "show", "card.toml"}};
  return {
      binary,
      latin,
      card,
      soft,
      whole_case("EmptyCase", "", {"case.toml", "the file is empty"}),
      command("MissingCase", {"calibrate", "none.toml", "-o", "out"}, {"none.toml", "no such file"}),
      command("AFolderAsCase", {"calibrate", ".", "-o", "out"}, {"cannot be read"}),
      command("NoOutput", {"calibrate", "case.toml"}, {"spall calibrate", "--output", "--help"}),
      command("OutputIsAFile", {"calibrate", "case.toml", "-o", "card.toml"}, {"card.toml"}, 1),
      command("OutputBelowAFile", {"calibrate", "case.toml", "-o", "card.toml/out"}, {"card.toml/out"}, 1),
      command("OutputNotWritable", {"calibrate", "case.toml", "-o", "/proc/out"}, {"/proc/out"}, 1),
      command("UnknownVerb", {"calibrat", "case.toml"}, {"did you mean \"calibrate\"?"}),
      command("UnknownVerbOfSpecimen", {"specimen", "mak"}, {"did you mean \"make\"?"}),
      command("NoVerb", {}, {"a verb is missing"}),
      command("UnknownOption", {"calibrate", "case.toml", "-o", "out", "--thread", "2"},
              {"did you mean \"--threads\"?"}),
      command("ThreadsInWords", {"calibrate", "case.toml", "-o", "out", "--threads", "two"}, {"--threads"}),
      command("NoThreads", {"calibrate", "case.toml", "-o", "out", "--threads", "0"}, {"--threads", "1"}),
      command("VelocityOfWrongUnit", more(tension, {"--velocity", "0.02 mm"}), {"--velocity", "40 m/s"}),
      command("VelocityBare", more(tension, {"--velocity", "0.02"}), {"--velocity", "unit is missing"}),
      command("VelocityNegative", more(tension, {"--velocity=-1 m/s"}), {"--velocity", "not positive"}),
      command("StrainOfWrongUnit", more(tension, {"--max-strain", "3 mm"}), {"--max-strain"}),
      command("SpecimenMissing", tension, {"s.h5"}),
      command("EndsOfTest", more(tension, {"--ends", "clamped"}), {"--ends", "free"}),
      command("TextAsSpecimen", {"specimen", "inspect", "card.toml"}, {"card.toml"}),
      command("SizeOfTwo", {"specimen", "make", "--size", "0.4x0.2 m", "--elements", "1400", "-o", "s.h5"},
              {"--size", "instead of 3"}),
      command("SizeBare", {"specimen", "make", "--size", "0.4x0.2x0.2", "--elements", "1400", "-o", "s.h5"},
              {"--size", "unit is missing"}),
      command(
          "NegativeSeedOfMake",
          {"specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements", "1400", "--seed", "-1", "-o", "s.h5"},
          {"--seed"}),
      command("ZeroElementsOfMake",
              {"specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements", "0", "-o", "s.h5"}, {"--elements"}),
      command("TooFewElementsOfMake",
              {"specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements", "20", "-o", "s.h5"},
              {"elements across", "take more"}),
  };
}

class BadInputs : public cli::Command, public testing::WithParamInterface<BadInput> {};

}  // namespace

TEST_P(BadInputs, AreRefusedWithOneLine) {
  const BadInput& input = GetParam();
  for (const auto& [name, content] : input.files) write(name, content);
  const std::string line = refusal(input.code, input.command);
  for (const std::string& part : input.told) EXPECT_THAT(line, HasSubstr(part));
  EXPECT_LT(line.size(), 500U) << line;
}

const auto name_of = [](const auto& parameter) { return parameter.param.name; };
INSTANTIATE_TEST_SUITE_P(Curves, BadInputs, testing::ValuesIn(curves()), name_of);
INSTANTIATE_TEST_SUITE_P(Targets, BadInputs, testing::ValuesIn(targets()), name_of);
INSTANTIATE_TEST_SUITE_P(Specimens, BadInputs, testing::ValuesIn(specimens()), name_of);
INSTANTIATE_TEST_SUITE_P(Commands, BadInputs, testing::ValuesIn(commands()), name_of);

class DamagedSpecimen : public cli::Command {};

TEST_F(DamagedSpecimen, IsRefusedByEveryVerbThatReadsIt) {
  ASSERT_EQ(spall({"specimen", "make", "--size", "0.3x0.2x0.2 m", "--elements", "1000", "--seed", "1", "-o",
                   "s.h5", "--quiet"})
                .code,
            0);
  write("card.toml", good_card);
  const std::string whole = read("s.h5");
  write("cut.h5", whole.substr(0, whole.size() / 2));
  std::string flipped = whole;
  for (std::size_t k = flipped.size() / 2; k < flipped.size() / 2 + 16; ++k)
    flipped[k] = static_cast<char>(~flipped[k]);
  write("flipped.h5", flipped);
  write("empty.h5", "");
  const std::string targets = good_case.substr(0, good_case.find("[specimen]"));
  for (const std::string file : {"cut.h5", "flipped.h5", "empty.h5"}) {
    EXPECT_THAT(refusal(2, {"specimen", "inspect", file}), HasSubstr(file));
    EXPECT_THAT(refusal(2, {"test", "elastic", "--specimen", file, "--card", "card.toml", "-o", "out"}),
                HasSubstr(file));
    write("case.toml",
          targets + "[specimen]\nsize = \"0.2x0.2x0.2 m\"\nfit_centres = [\"0.15,0.1,0.1 m\"]\ncut_from = \"" +
              file + "\"\n");
    EXPECT_THAT(refusal(2, {"calibrate", "case.toml", "-o", "out"}), HasSubstr(file));
  }
  // A region that sticks out is found before anything is written, and so is one that is too small.
  write("case.toml",
        targets +
            "[specimen]\nsize = \"0.2x0.2x0.2 m\"\nfit_centres = [\"0.25,0.1,0.1 m\"]\ncut_from = \"s.h5\"\n");
  EXPECT_THAT(refusal(2, {"calibrate", "case.toml", "-o", "out"}),
              testing::AllOf(HasSubstr("specimen.fit_centres"), HasSubstr("sticks out")));
  write("case.toml",
        targets +
            "[specimen]\nsize = \"0.1x0.1x0.1 m\"\nfit_centres = [\"0.1,0.1,0.1 m\"]\ncut_from = \"s.h5\"\n");
  EXPECT_THAT(refusal(2, {"calibrate", "case.toml", "-o", "out"}),
              testing::AllOf(HasSubstr("specimen.fit_centres"), HasSubstr("too small")));
}
