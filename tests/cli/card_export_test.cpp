// spall card export: what each format holds, that its numbers are the card's, and each way in which it is
// refused. Whether Yade takes them is in yade_test.cpp.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/cli/command.h"

using cli::good_card;
using cli::replaced;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream in(line);
  std::vector<double> numbers;
  for (double value = 0; in >> value;) numbers.push_back(value);
  EXPECT_TRUE(in.eof()) << line;
  return numbers;
}

class CardExport : public cli::Command {
 protected:
  void SetUp() override {
    cli::Command::SetUp();
    write("card.toml", good_card);
  }
  void make_specimen() const {
    ASSERT_EQ(spall({"specimen", "make", "--size", "0.4x0.2x0.2 m", "--elements", "1200", "--seed", "1",
                     "--quiet", "-o", "s1.h5"})
                  .code,
              0);
  }
};

}  // namespace

TEST_F(CardExport, CsvOfACardIsAsItEverWas) {
  EXPECT_THAT(spall({"card", "export", "card.toml", "--to", "csv"}).out,
              AllOf(HasSubstr("key,value,unit,meaning\n"), HasSubstr("\nT,3100000,Pa,")));
  EXPECT_EQ(spall({"card", "export", "card.toml", "--to", "csv", "-o", "a/b.csv"}).code, 0);
  EXPECT_THAT(read("a/b.csv"), HasSubstr("\nT,3100000,Pa,"));
}

TEST_F(CardExport, CsvOfASpecimenHoldsEq1LinkByLink) {
  make_specimen();
  const auto said =
      spall({"card", "export", "card.toml", "--to", "csv", "--specimen", "s1.h5", "-o", "card.csv", "--json"});
  ASSERT_EQ(said.code, 0) << said.err;
  EXPECT_EQ(nlohmann::json::parse(said.out)["beside"], nlohmann::json({"card.elements.csv", "card.links.csv"}));
  const auto elements = lines_of(read("card.elements.csv")), links = lines_of(read("card.links.csv"));
  ASSERT_EQ(elements.size(), 1201u);
  ASSERT_GT(links.size(), 5000u);
  double mass = 0;
  for (std::size_t k = 1; k < elements.size(); ++k) {
    const auto e = numbers_of(elements[k]);
    mass += 4. / 3 * std::numbers::pi * std::pow(e[4], 3) * e[5];
  }
  EXPECT_NEAR(mass / (2400 * 0.4 * 0.2 * 0.2), 1, 1e-12);
  for (std::size_t k = 1; k < links.size(); ++k) {
    const auto row = numbers_of(links[k]);
    ASSERT_EQ(row.size(), 10u);
    const auto a = numbers_of(elements[1 + static_cast<std::size_t>(row[0])]),
               b = numbers_of(elements[1 + static_cast<std::size_t>(row[1])]);
    const double distance = std::hypot(a[1] - b[1], a[2] - b[2], a[3] - b[3]);
    const double area = std::numbers::pi * std::pow(std::min(a[4], b[4]), 2);
    EXPECT_NEAR(row[2] / distance, 1, 1e-12);
    EXPECT_NEAR(row[4] / (1.29727 * 30e9 * area / distance), 1, 1e-5);  // Eq. 1, docs/theory.md
    EXPECT_NEAR(row[5] / row[4], 0.216667, 1e-6);
    EXPECT_NEAR(row[6] / (3.1e6 * area), 1, 1e-12);
    EXPECT_NEAR(row[7] / (36e6 * area), 1, 1e-12);
  }
}

TEST_F(CardExport, EachFormatSaysWhatIsLostAndOnlyThat) {
  const auto text = [&](const std::string& format) {
    return spall({"card", "export", "card.toml", "--to", format}).out;
  };
  EXPECT_THAT(text("yade-jcfpm"),
              AllOf(HasSubstr("zeta = 5 is lost"), Not(HasSubstr("phi_c; only")), Not(HasSubstr("roll"))));
  EXPECT_THAT(text("yade-cpm"), AllOf(HasSubstr("stays Co until"), Not(HasSubstr("zeta = 5 is lost"))));
  EXPECT_THAT(text("lammps-bpm"),
              AllOf(HasSubstr("zeta = 5 is lost"), HasSubstr("phi_i = 0.1047 rad is lost")));
  write("card.toml", replaced(replaced(good_card, "phi_c = \"6 degree\"", "phi_c = \"30 degree\""), "zeta = 5",
                              "zeta = 5\nlink_law = \"moment_transfer\"\nslip_softening = 40\n"
                              "cohesion_during_softening = \"proportional\"\nbroken_link_contact = \"radii\""));
  EXPECT_THAT(text("yade-jcfpm"),
              AllOf(HasSubstr("phi_c"), HasSubstr("slip_softening 40"), Not(HasSubstr("below D_init"))));
  EXPECT_THAT(text("yade-cpm"), AllOf(HasSubstr("one angle"), HasSubstr("in proportion")));
  EXPECT_THAT(text("lammps-bpm"), HasSubstr("slip_softening 40"));

  const auto told = spall({"card", "export", "card.toml", "--to", "yade-cpm", "-o", "concrete.py"});
  EXPECT_THAT(told.out, AllOf(HasSubstr("wrote concrete.py"), HasSubstr("- contacts have the friction phi_i")));
  const auto json = nlohmann::json::parse(
      spall({"card", "export", "card.toml", "--to", "yade-cpm", "-o", "concrete.py", "--json"}).out);
  EXPECT_EQ(json["lost"].size(), 4u) << json["lost"];
}

// A reader as strict as LAMMPS's own: counts of the head, sections in their order, ids from 1 without a gap.
TEST_F(CardExport, LammpsFilesAgreeWithEachOtherAndWithTheLinks) {
  make_specimen();
  ASSERT_EQ(spall({"card", "export", "card.toml", "--to", "lammps-bpm", "--specimen", "s1.h5", "-o",
                   "run/in.concrete"})
                .code,
            0);
  ASSERT_EQ(spall({"card", "export", "card.toml", "--to", "csv", "--specimen", "s1.h5", "-o", "card.csv"}).code,
            0);
  const auto links = lines_of(read("card.links.csv")), elements = lines_of(read("card.elements.csv"));

  const auto data = lines_of(read("run/in.concrete.data"));
  std::map<std::string, std::vector<std::vector<double>>> sections;
  std::map<std::string, std::size_t> counts;
  std::string section;
  for (std::size_t k = 1; k < data.size(); ++k) {
    if (data[k].empty()) continue;
    if (std::isalpha(static_cast<unsigned char>(data[k][0])) != 0) {
      section = data[k].substr(0, data[k].find(' '));
      EXPECT_EQ(data[k - 1], "");
      EXPECT_EQ(data[k + 1], "");
    } else if (section.empty()) {
      std::istringstream head(data[k]);
      double first = 0;
      std::string word;
      head >> first;
      std::getline(head >> std::ws, word);
      counts[word] = static_cast<std::size_t>(first);
    } else {
      sections[section].push_back(numbers_of(data[k]));
    }
  }
  ASSERT_EQ(counts["atoms"], elements.size() - 1);
  ASSERT_EQ(counts["bonds"], links.size() - 1);
  ASSERT_EQ(counts["bond types"], links.size() - 1);
  ASSERT_EQ(sections["Atoms"].size(), counts["atoms"]);
  ASSERT_EQ(sections["Bonds"].size(), counts["bonds"]);
  for (std::size_t k = 0; k < counts["atoms"]; ++k) {
    const auto &atom = sections["Atoms"][k], element = numbers_of(elements[k + 1]);
    ASSERT_EQ(atom.size(), 8u);  // id molecule type diameter density x y z
    EXPECT_EQ(atom[0], static_cast<double>(k + 1));
    EXPECT_EQ(atom[3], 2 * element[4]);
    EXPECT_EQ(atom[4], element[5]);
    EXPECT_EQ(atom[5], element[1]);
    EXPECT_EQ(atom[7], element[3]);
  }

  const auto coefficients = lines_of(read("run/in.concrete.bonds"));
  ASSERT_EQ(coefficients.size(), counts["bonds"]);
  for (std::size_t k = 0; k < counts["bonds"]; ++k) {
    const auto &bond = sections["Bonds"][k], link = numbers_of(links[k + 1]);
    EXPECT_EQ(bond, (std::vector<double>{double(k + 1), double(k + 1), link[0] + 1, link[1] + 1}));
    ASSERT_THAT(coefficients[k], testing::StartsWith("bond_coeff "));
    const auto c = numbers_of(coefficients[k].substr(11));
    EXPECT_EQ(c, (std::vector<double>{double(k + 1), link[4], link[5], 0, 0, link[6], link[7], 1e30, 1e30, 0, 0,
                                      0, 0}));
  }

  const std::vector<std::string> known{
      "units",         "dimension", "boundary", "atom_style",   "newton",       "comm_modify",
      "special_bonds", "read_data", "neighbor", "neigh_modify", "pair_style",   "pair_coeff",
      "bond_style",    "include",   "fix",      "timestep",     "thermo_style", "run"};
  std::vector<std::string> used;
  for (const std::string& line : lines_of(read("run/in.concrete")))
    if (!line.empty() && line[0] != '#') used.push_back(line.substr(0, line.find(' ')));
  EXPECT_EQ(used, known) << "LAMMPS cares for the order";
  EXPECT_THAT(read("run/in.concrete"),
              AllOf(HasSubstr("read_data in.concrete.data\n"), HasSubstr("include in.concrete.bonds\n")));
}

TEST_F(CardExport, MistakesAreToldInOneLine) {
  EXPECT_THAT(refusal(2, {"card", "export", "card.toml", "--to", "yade-jcfp"}),
              HasSubstr("did you mean \"yade-jcfpm\"?"));
  EXPECT_THAT(refusal(2, {"card", "export", "card.toml", "--to", "abaqus"}), HasSubstr("lammps-bpm"));
  EXPECT_THAT(
      refusal(2, {"card", "export", "card.toml", "--to", "yade-cpm", "--specimen", "none.h5", "-o", "a.py"}),
      HasSubstr("none.h5: no such file"));
  EXPECT_THAT(
      refusal(2, {"card", "export", "card.toml", "--to", "yade-cpm", "--specimen", "card.toml", "-o", "a.py"}),
      HasSubstr("card.toml"));
  make_specimen();
  EXPECT_THAT(refusal(2, {"card", "export", "card.toml", "--to", "yade-cpm", "--specimen", "s1.h5"}),
              HasSubstr("-o: is missing"));
  EXPECT_THAT(refusal(1, {"card", "export", "card.toml", "--to", "yade-cpm", "--specimen", "s1.h5", "-o",
                          "card.toml/a.py"}),
              HasSubstr("card.toml"));
}
