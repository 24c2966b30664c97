// The strict TOML reader: what it returns, and each sentence with which it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "libdem/config/nearest_name.h"
#include "libdem/config/toml_reader.h"
#include "libdem/core/error.h"

using dem::Quantity;
using dem::TomlTable;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace {
/// The message with which `call` refuses; it must be one line.
template <class Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const dem::InputError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  ADD_FAILURE() << "nothing was refused";
  return "";
}
TomlTable parsed(const char* text) { return TomlTable::parse(text, "case.toml"); }
}  // namespace

TEST(TomlTable, ReadsEveryKindOfValue) {
  const TomlTable root = parsed(R"(
E = "24 GPa"
nu = 0.16
strain = "2.4 permil"
count = 3
name = "R30A7"
free = true
ends = "fixed"
curve = "a.csv"
seeds = [1, 2, 3]
ratios = [0.1, 1]
names = ["a", "b"]
sizes = ["1 mm", "2 cm"]
box = "0.5x0.25x0.25 m"
none = []
[loading]
velocity = "20 mm/s"
[[probe]]
name = "p1"
[[probe]]
name = "p2"
)");
  EXPECT_DOUBLE_EQ(root.quantity("E", Quantity::stress), 24e9);
  EXPECT_DOUBLE_EQ(root.quantity("nu", Quantity::ratio), 0.16);
  EXPECT_DOUBLE_EQ(root.quantity("strain", Quantity::ratio), 2.4e-3);
  EXPECT_DOUBLE_EQ(root.quantity("density", Quantity::density, 2400), 2400);
  EXPECT_FALSE(root.optional_quantity("T", Quantity::stress).has_value());
  EXPECT_DOUBLE_EQ(root.number("count"), 3);
  EXPECT_EQ(root.integer("count", 1, 3), 3);
  EXPECT_EQ(root.text("name"), "R30A7");
  EXPECT_EQ(root.text("title", "none"), "none");
  EXPECT_TRUE(root.boolean("free"));
  EXPECT_EQ(root.choice("ends", {"free", "fixed"}), "fixed");
  EXPECT_EQ(root.choice("axis", {"x", "y"}, "y"), "y");
  EXPECT_EQ(root.file_path("curve"), std::filesystem::path("a.csv"));
  EXPECT_THAT(root.integers("seeds"), ElementsAre(1, 2, 3));
  EXPECT_THAT(root.numbers("ratios"), ElementsAre(0.1, 1));
  EXPECT_THAT(root.texts("names"), ElementsAre("a", "b"));
  EXPECT_THAT(root.quantities("sizes", Quantity::length), ElementsAre(1e-3, 2e-2));
  EXPECT_THAT(root.quantities("box", Quantity::length), ElementsAre(0.5, 0.25, 0.25));
  EXPECT_THAT(root.numbers("none"), IsEmpty());
  EXPECT_DOUBLE_EQ(root.table("loading").quantity("velocity", Quantity::velocity), 0.02);
  EXPECT_FALSE(root.optional_table("cooling").has_value());
  const auto probes = root.tables("probe");
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_EQ(probes[0].text("name"), "p1");
  EXPECT_EQ(root.tables("probe")[1].text("name"), "p2");
  EXPECT_NO_THROW(root.finish());
}

TEST(TomlTable, ShowsHowToWriteAUnit) {
  const TomlTable root = parsed("E = 30\nv = 4.5\n");
  EXPECT_THAT(refusal([&] { root.quantity("E", Quantity::stress); }),
              AllOf(HasSubstr("case.toml:1: E: 30 is a bare number"), HasSubstr("E = \"30 GPa\"")));
  EXPECT_THAT(refusal([&] { root.quantity("v", Quantity::velocity); }), HasSubstr("v = \"4.5 m/s\""));
}

TEST(TomlTable, NamesTheFullKeyAndTheLine) {
  const TomlTable root = parsed("[loading]\nspeed = \"3 kg\"\n[[probe]]\n[[probe]]\nname = 3\n");
  const TomlTable loading = root.table("loading");
  EXPECT_THAT(refusal([&] { loading.quantity("speed", Quantity::velocity); }),
              HasSubstr("case.toml:2: loading.speed"));
  EXPECT_THAT(refusal([&] { root.tables("probe")[1].text("name"); }),
              HasSubstr("case.toml:5: probe[2].name: 3 is not text"));
  EXPECT_THAT(refusal([&] { root.number("gone"); }), HasSubstr("case.toml: gone: the key is missing"));
}

TEST(TomlTable, FinishRefusesStrangersEverywhere) {
  const TomlTable root = parsed("E = \"1 Pa\"\n[loading]\nvelocity = \"1 m/s\"\nvelocty = \"1 m/s\"\n");
  root.quantity("E", Quantity::stress);
  root.table("loading").quantity("velocity", Quantity::velocity);
  EXPECT_THAT(refusal([&] { root.finish(); }), AllOf(HasSubstr("case.toml:4: loading.velocty: unknown key"),
                                                     HasSubstr("did you mean \"velocity\"?")));
}

TEST(TomlTable, SuggestsTheMistypedKeyForAMissingOne) {
  const TomlTable root = parsed("specimin = \"a.h5\"\n");
  EXPECT_THAT(refusal([&] { root.text("specimen"); }), HasSubstr("there is a key \"specimin\""));
}

TEST(TomlTable, RefusesWrongTypesAndRanges) {
  const TomlTable root = parsed("a = \"x\"\nb = 1.5\nc = nan\nd = [1, \"x\"]\ne = 7\nf = 1979-05-27\n[t]\n");
  EXPECT_THAT(refusal([&] { root.number("a"); }), HasSubstr("\"x\" is not a finite number"));
  EXPECT_THAT(refusal([&] { root.integer("b"); }), HasSubstr("1.5 is not an integer"));
  EXPECT_THAT(refusal([&] { root.number("c"); }), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal([&] { root.quantity("c", Quantity::ratio); }), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal([&] { root.integers("d"); }), HasSubstr("\"x\" is not an integer"));
  EXPECT_THAT(refusal([&] { root.integer("e", 1, 5); }), HasSubstr("from 1 to 5"));
  EXPECT_THAT(refusal([&] { root.integer("e", 8); }), HasSubstr("at least 8"));
  EXPECT_THAT(refusal([&] { root.boolean("e"); }), HasSubstr("neither true nor false"));
  EXPECT_THAT(refusal([&] { root.quantity("f", Quantity::time); }), HasSubstr("not a quantity"));
  EXPECT_THAT(refusal([&] { root.quantity("t", Quantity::time); }), HasSubstr("a table is not a quantity"));
  EXPECT_THAT(refusal([&] { root.table("e"); }), HasSubstr("[e]"));
  EXPECT_THAT(refusal([&] { root.tables("t"); }), HasSubstr("[[t]]"));
  EXPECT_THAT(refusal([&] { root.choice("a", {"free", "fixed"}); }), HasSubstr("allowed: free, fixed"));
}

TEST(TomlTable, KeepsTheOrderOfFreeKeys) {
  EXPECT_THAT(parsed("zeta = \"1\"\nalpha = \"2\"\n\"a key\" = \"3\"\n").keys(),
              ElementsAre("zeta", "alpha", "a key"));
}

TEST(TomlTable, NamesTheLineOfASyntaxError) {
  EXPECT_THAT(refusal([] { parsed("a = 1\nb = = 2\n"); }), HasSubstr("case.toml:2: this is not TOML"));
  EXPECT_THAT(refusal([] { parsed("a = 1\na = 2\n"); }), HasSubstr("case.toml:2"));
  EXPECT_THAT(refusal([] { parsed("a = \"\xff\xfe\"\n"); }), HasSubstr("not TOML"));
  EXPECT_THAT(refusal([] { parsed(" \n\t\n"); }), HasSubstr("the file is empty"));
}

TEST(TomlTable, RefusesFilesThatAreNotThere) {
  EXPECT_THAT(refusal([] { TomlTable::read("/nowhere/case.toml"); }),
              HasSubstr("/nowhere/case.toml: there is no such file"));
  EXPECT_THAT(refusal([] { TomlTable::read(std::filesystem::temp_directory_path()); }),
              HasSubstr("cannot be read"));
}

TEST(TomlTable, MessagesStayOnOneLine) {
  EXPECT_THAT(refusal([] { parsed("\"a\\nb\" = 1\n").finish(); }), HasSubstr("a b: unknown key"));
}

TEST(NearestName, FindsWhatWasMeant) {
  EXPECT_EQ(dem::nearest_name("zetta", {"E", "nu", "zeta", "beta"}), "zeta");
  EXPECT_EQ(dem::nearest_name("e", {"T", "nu", "E"}), "E");
  EXPECT_EQ(dem::nearest_name("cohesion", {"E", "Co"}), "Co");
  EXPECT_EQ(dem::nearest_name("hpi_i", {"phi_c", "phi_i"}), "phi_i");
  EXPECT_EQ(dem::nearest_name("wibble", {"E", "nu"}), "");
}
