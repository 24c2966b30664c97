// study.toml: what it says, and what it is refused for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "specimens/packing.h"
#include "specimens/specimen_file.h"
#include "study/number_list.h"
#include "study/study_file.h"
#include "tests/message_of.h"

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

namespace {

const std::string good = R"(card = "card.toml"
tests = ["elastic", "tension"]
[[specimen]]
size = "0.3x0.2x0.2 m"
elements = 1100
seeds = [1, 2]
)";

class StudyFile : public testing::Test {
 protected:
  std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("spall-study-" + std::to_string(::getpid()));

  void SetUp() override {
    std::filesystem::create_directories(folder);
    write("card.toml", dem::to_toml(dem::MaterialCard{}));
    write("other.toml", dem::to_toml(dem::MaterialCard{}));
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void write(const std::string& name, const std::string& content) const {
    std::ofstream(folder / name, std::ios::binary) << content;
  }
  study::Study read(const std::string& content) const {
    write("study.toml", content);
    return study::read_study(folder / "study.toml");
  }
  std::string refused(const std::string& what, const std::string& by) const {
    std::string text = good;
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return test::message_of([&] { read(text.replace(at, what.size(), by)); });
  }
  /// Keys that belong before the tables.
  std::string refused_with(const std::string& first) const {
    return test::message_of([&] { read(first + "\n" + good); });
  }
  std::string refused_after(const std::string& last) const {
    return test::message_of([&] { read(good + last + "\n"); });
  }
};

}  // namespace

TEST(NumberList, HasNumbersAndRanges) {
  EXPECT_THAT(study::parse_number_list("1-3, 7,10 - 11", 1, 20, "x"), ElementsAre(1, 2, 3, 7, 10, 11));
  EXPECT_THAT(study::parse_number_list("5", 0, 5, "x"), ElementsAre(5));
}

TEST(NumberList, RefusesWhatIsNone) {
  const auto refused = [](const std::string& text) {
    return test::message_of([&] { study::parse_number_list(text, 1, 20, "--tasks"); });
  };
  for (const char* text : {"", "a", "1-", "-3", "1,,2", "1..3", "1.5", "2 3"})
    EXPECT_THAT(refused(text), AllOf(HasSubstr("--tasks"), HasSubstr("is not a whole number"))) << text;
  EXPECT_THAT(refused("21"), HasSubstr("allowed: 1 to 20"));
  EXPECT_THAT(refused("99999999999999999999"), HasSubstr("out of range"));
  EXPECT_THAT(refused("5-2"), HasSubstr("write it as \"2-5\""));
  EXPECT_THAT(refused("1-3, 2"), HasSubstr("2 stands twice"));
  EXPECT_THAT(test::message_of([] { study::parse_number_list("1-9999999", 1, 1u << 30, "x"); }),
              HasSubstr("more than a million"));
}

TEST_F(StudyFile, SaysSpecimensCardsAndTests) {
  const study::Study found = read(R"(name = "all"
cards = ["card.toml", "other.toml"]
tests = "compression"
[[specimen]]
size = ["0.5x0.25x0.25 m", "500x400x250 mm"]
elements = [2700, 4320]
seeds = "3-4"
[[specimen]]
name = "round"
shape = "cylinder"
size = "0.2x0.4 m"
element_size = "20 mm"
grading = "lognormal"
solid_fraction = 0.4
seeds = 7
)");
  EXPECT_EQ(found.name, "all");
  ASSERT_EQ(found.cards.size(), 2u);
  EXPECT_EQ(found.cards[1].name, "other");
  ASSERT_EQ(found.specimens.size(), 9u);
  EXPECT_EQ(study::label_of(found.specimens[1]), "specimen 1, seed 4");
  EXPECT_EQ(found.specimens[2].packing.elements, 4320u);
  EXPECT_NEAR(found.specimens[4].packing.size.y(), 0.4, 1e-12);
  const study::SpecimenRecipe& round = found.specimens[8];
  EXPECT_EQ(study::label_of(round), "round, seed 7");
  EXPECT_EQ(round.packing.shape, specimens::Shape::cylinder);
  EXPECT_EQ(round.packing.elements, 1571u);  // pi/4 0.2^2 0.4 / 0.02^3 = 1570.8
  EXPECT_EQ(round.packing.solid_fraction, 0.4);
  ASSERT_EQ(found.tests.size(), 1u);
  EXPECT_EQ(virtual_tests::kind_of(found.tests[0].options), study::TestKind::compression);
  EXPECT_EQ(found.inputs.size(), 3u);
}

TEST_F(StudyFile, SaysTestsWithOptions) {
  const study::Study found = read(R"(card = "card.toml"
[[specimen]]
size = "0.3x0.2x0.2 m"
elements = 1100
seeds = 1
[[test]]
kind = "compression"
[[test]]
name = "gripped"
kind = "compression"
ends = "fixed"
axis = "y"
velocity = "20 mm/s"
damping = 0.1
stop_at = 0.9
max_strain = "5 permil"
expected_strength = "20 MPa"
)");
  ASSERT_EQ(found.tests.size(), 2u);
  const auto& usual = std::get<virtual_tests::UniaxialOptions>(found.tests[0].options);
  EXPECT_EQ(usual.ends, dem::EndCondition::free);
  const study::VirtualTest& gripped = found.tests[1];
  EXPECT_EQ(gripped.name, "gripped");
  const auto& options = std::get<virtual_tests::UniaxialOptions>(gripped.options);
  EXPECT_EQ(options.ends, dem::EndCondition::fixed);
  EXPECT_EQ(options.axis, 1);
  EXPECT_NEAR(options.velocity, 0.02, 1e-15);
  EXPECT_NEAR(options.max_strain, 0.005, 1e-15);
  EXPECT_EQ(options.expected_strength, 20e6);
  EXPECT_EQ(options.damping, 0.1);
}

TEST_F(StudyFile, SaysWhatVaries) {
  const study::Study found = read(good + R"([vary]
T = ["2 MPa", "3 MPa"]
zeta = { from = 1, to = 100, count = 3, spacing = "logarithmic" }
Ks_over_Kn = { from = 0.2, to = 1, count = 5 }
)");
  ASSERT_EQ(found.parameters.size(), 3u);
  EXPECT_THAT(found.parameters[0].values, ElementsAre(2e6, 3e6));
  EXPECT_THAT(found.parameters[1].values, ElementsAre(1, testing::DoubleNear(10, 1e-12), 100));
  EXPECT_EQ(found.parameters[2].values.size(), 5u);
  EXPECT_EQ(found.parameters[2].values.back(), 1);
}

TEST_F(StudyFile, SaysSobolRanges) {
  const study::Study found = read("design = \"sobol\"\npoints = 8\nsensitivity = true\n" + good +
                                  "[vary]\nT = { from = \"2 MPa\", to = \"4 MPa\" }\n"
                                  "phi_i = { from = \"0 degree\", to = \"30 degree\" }\n");
  EXPECT_EQ(found.design, study::DesignKind::sobol);
  EXPECT_TRUE(found.sensitivity);
  ASSERT_EQ(found.parameters.size(), 2u);
  EXPECT_EQ(found.parameters[0].to, 4e6);
}

TEST_F(StudyFile, TakesSpecimensFromFiles) {
  specimens::PackingOptions packing;
  packing.size = {0.3, 0.2, 0.2};
  packing.elements = 1100;
  packing.seed = 5;
  const specimens::Specimen specimen = specimens::make_specimen(packing);
  specimens::write_specimen(folder / "s5.h5", specimen);
  const std::string text = "card = \"card.toml\"\ntests = [\"elastic\"]\n[[specimen]]\n";
  const study::Study found = read(text + "files = [\"s5.h5\"]\n");
  ASSERT_EQ(found.specimens.size(), 1u);
  EXPECT_EQ(found.specimens[0].sha256, specimen.sha256());
  EXPECT_EQ(found.specimens[0].packing.elements, 1100u);
  EXPECT_EQ(study::label_of(found.specimens[0]), "specimen 1, s5.h5");
  const auto refusal = [&](const std::string& lines) { return test::message_of([&] { read(text + lines); }); };
  EXPECT_THAT(refusal("files = [\"s5.h5\", \"s5.h5\"]\n"), HasSubstr("stands twice"));
  EXPECT_THAT(refusal("files = \"s6.h5\"\n"), AllOf(HasSubstr("specimen[1].files"), HasSubstr("s6.h5")));
  EXPECT_THAT(refusal("files = \"s5.h5\"\nseeds = 1\n"), HasSubstr("has no meaning beside files"));
}

TEST_F(StudyFile, RefusesWrongKeysAndCards) {
  EXPECT_THAT(refused("tests", "test_s"),
              AllOf(HasSubstr("study.toml:2"), HasSubstr("did you mean \"tests\"?")));
  EXPECT_THAT(refused("card = \"card.toml\"", "name = \"\""), HasSubstr("name: is empty"));
  EXPECT_THAT(refused("card = \"card.toml\"", ""), HasSubstr("name the material card"));
  EXPECT_THAT(refused("\"card.toml\"", "\"none.toml\""), HasSubstr("there is no file \"none.toml\""));
  EXPECT_THAT(refused("\"card.toml\"", "3"), HasSubstr("card"));
  EXPECT_THAT(refused_with("cards = [\"other.toml\"]"), HasSubstr("stands beside card"));
  EXPECT_THAT(refused("card = \"card.toml\"", "cards = []"), HasSubstr("the list is empty"));
  EXPECT_THAT(refused("card = \"card.toml\"", "cards = [\"card.toml\", \"card.toml\"]"),
              HasSubstr("two cards are called \"card\""));
  write("bad.toml", "E = 3\n");
  EXPECT_THAT(refused("\"card.toml\"", "\"bad.toml\""), HasSubstr("bad.toml"));
  EXPECT_THAT(test::message_of([&] { read("card = \"card.toml\"\ntests = [\"elastic\"]\n"); }),
              HasSubstr("[[specimen]]"));
}

TEST_F(StudyFile, RefusesWrongTests) {
  EXPECT_THAT(refused("[\"elastic\", \"tension\"]", "[\"spliting\"]"), HasSubstr("\"spliting\" is no test"));
  EXPECT_THAT(refused("[\"elastic\", \"tension\"]", "[]"), HasSubstr("the list is empty"));
  EXPECT_THAT(refused("[\"elastic\", \"tension\"]", "[\"elastic\", \"elastic\"]"), HasSubstr("stands twice"));
  EXPECT_THAT(refused("tests = [\"elastic\", \"tension\"]\n", ""), HasSubstr("tests: the key is missing"));
  EXPECT_THAT(refused_after("[[test]]\nkind = \"elastic\""), HasSubstr("stands beside [[test]]"));
  const auto tests = [&](const std::string& tables) {
    return test::message_of([&] {
      std::string text = good;
      read(text.erase(text.find("tests"), 31) + tables);
    });
  };
  EXPECT_THAT(tests("[[test]]\nname = \"x\"\n"), HasSubstr("kind"));
  EXPECT_THAT(tests("[[test]]\nkind = \"compresion\"\n"), HasSubstr("did you mean \"compression\"?"));
  EXPECT_THAT(tests("[[test]]\nkind = \"elastic\"\nends = \"free\"\n"), HasSubstr("no meaning for an elastic"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\nends = \"glued\"\n"), HasSubstr("ends"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\nrate = 0.1\nvelocity = \"1 mm/s\"\n"),
              HasSubstr("stands beside velocity"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\nvelocity = 0.1\n"), HasSubstr("bare number"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\nvelocity = \"-1 mm/s\"\n"), HasSubstr("greater than 0"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\ndamping = 1.5\n"), HasSubstr("allowed: 0 to 0.99"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\nstop_at = 0\n"), HasSubstr("stop_at"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\nmax_strain = 0.9\n"), HasSubstr("max_strain"));
  EXPECT_THAT(tests("[[test]]\nkind = \"tension\"\n[[test]]\nkind = \"tension\"\n"),
              AllOf(HasSubstr("test[2]"), HasSubstr("stands twice")));
}

TEST_F(StudyFile, RefusesWrongSpecimens) {
  EXPECT_THAT(refused("0.3x0.2x0.2 m", "0.3x0.2 m"), HasSubstr("has 2 lengths"));
  EXPECT_THAT(refused("0.3x0.2x0.2 m", "0.3x0.2x0.2"), HasSubstr("unit"));
  EXPECT_THAT(refused("0.3x0.2x0.2 m", "0.3x0.2x-0.2 m"), HasSubstr("allowed: 1 mm to 100 m"));
  EXPECT_THAT(refused("size = \"0.3x0.2x0.2 m\"", "shape = \"box\""), HasSubstr("size"));
  EXPECT_THAT(refused("size", "shape = \"sphere\"\nsize"), HasSubstr("shape"));
  EXPECT_THAT(refused("size", "shape = \"cylinder\"\nsize"), HasSubstr("diameter x length"));
  EXPECT_THAT(refused("elements = 1100", "elements = 11"),
              AllOf(HasSubstr("study.toml:5"), HasSubstr("too small to be representative")));
  EXPECT_THAT(refused("elements = 1100", "elements = 0"), HasSubstr("asks for 0 elements"));
  EXPECT_THAT(refused("elements = 1100", "elements = []"), HasSubstr("is empty"));
  EXPECT_THAT(refused("elements = 1100", "elements = [1100, 1100]"), HasSubstr("asks twice for 1100"));
  EXPECT_THAT(refused("elements = 1100", "element_size = \"0 m\""), HasSubstr("greater than 0"));
  EXPECT_THAT(refused("elements = 1100", "elements = 1100\nelement_size = \"20 mm\""),
              HasSubstr("stands beside elements"));
  EXPECT_THAT(refused("elements = 1100\n", ""), HasSubstr("elements: the key is missing"));
  EXPECT_THAT(refused("seeds = [1, 2]", "seeds = [1, 1]"), HasSubstr("the seed 1 stands twice"));
  EXPECT_THAT(refused("seeds = [1, 2]", "seeds = [-1]"), HasSubstr("-1 is negative"));
  EXPECT_THAT(refused("seeds = [1, 2]", "seeds = []"), HasSubstr("is empty"));
  EXPECT_THAT(refused("seeds = [1, 2]", "seeds = \"1-x\""),
              AllOf(HasSubstr("specimen[1].seeds"), HasSubstr("x")));
  EXPECT_THAT(refused("seeds = [1, 2]", ""), HasSubstr("seeds: the key is missing"));
  EXPECT_THAT(refused("seeds = [1, 2]", "seeds = [1]\nsize_ratio = 20"), HasSubstr("size_ratio"));
  EXPECT_THAT(refused("seeds = [1, 2]", "seeds = [1]\ngrading = \"equal\"\nsize_ratio = 2"),
              HasSubstr("no meaning for equal elements"));
  EXPECT_THAT(refused("seeds = [1, 2]", "seeds = [1]\nsolid_fraction = 0.9"), HasSubstr("solid_fraction"));
  EXPECT_THAT(refused_after("[[specimen]]\nsize = \"0.3x0.2x0.2 m\"\nelements = 1100\nseeds = [2]"),
              AllOf(HasSubstr("specimen[2].seeds"), HasSubstr("stands twice in this study")));
  EXPECT_THAT(refused("size", "name = \"\"\nsize"), HasSubstr("name"));
}

TEST_F(StudyFile, RefusesWrongDesigns) {
  EXPECT_THAT(refused_with("design = \"latin\""), HasSubstr("design"));
  EXPECT_THAT(refused_with("points = 8"), HasSubstr("no meaning in a factorial design"));
  EXPECT_THAT(refused_with("design = \"sobol\"\npoints = 8"), HasSubstr("nothing varies"));
  EXPECT_THAT(refused_after("[vary]\nt = [\"2 MPa\"]"), HasSubstr("did you mean \"T\"?"));
  EXPECT_THAT(refused_after("[vary]\nT = \"2 MPa\""), HasSubstr("neither a list nor a range"));
  EXPECT_THAT(refused_after("[vary]\nT = [2]"), HasSubstr("bare number"));
  EXPECT_THAT(refused_after("[vary]\nT = []"), HasSubstr("the list is empty"));
  EXPECT_THAT(refused_after("[vary]\nT = [\"2 MPa\", \"2000 kPa\"]"), HasSubstr("stands twice"));
  EXPECT_THAT(refused_after("[vary]\nzeta = { from = 1, to = 5 }"), HasSubstr("vary.zeta.count"));
  EXPECT_THAT(refused_after("[vary]\nzeta = { from = 5, to = 1, count = 3 }"), HasSubstr("is not above from"));
  EXPECT_THAT(refused_after("[vary]\nzeta = { from = 1, to = 5, count = 1 }"), HasSubstr("2 to 10000"));
  EXPECT_THAT(refused_after("[vary]\nphi_i = { from = \"0 rad\", to = \"1 rad\", count = 3, spacing = "
                            "\"logarithmic\" }"),
              HasSubstr("begin above 0"));
  EXPECT_THAT(refused_after("[vary]\nKs_over_Kn = [1.5]"), HasSubstr("at most 1"));
  EXPECT_THAT(refused_after("[vary]\nKs_over_Kn = [0.5]\nnu = [0.1]"), HasSubstr("stands beside Ks_over_Kn"));
  const auto sobol = [&](const std::string& keys, const std::string& vary) {
    return test::message_of([&] { read("design = \"sobol\"\n" + keys + good + "[vary]\n" + vary + "\n"); });
  };
  EXPECT_THAT(sobol("", "zeta = { from = 1, to = 5 }"), HasSubstr("points"));
  EXPECT_THAT(sobol("points = 0\n", "zeta = { from = 1, to = 5 }"), HasSubstr("points"));
  EXPECT_THAT(sobol("points = 8\n", "zeta = [1, 2]"), HasSubstr("fills ranges"));
  EXPECT_THAT(sobol("points = 8\n", "zeta = { from = 1, to = 5, count = 3 }"),
              HasSubstr("no meaning in a Sobol"));
  EXPECT_THAT(test::message_of([&] {
                std::string text = good;
                text.replace(0, 18, "cards = [\"card.toml\", \"other.toml\"]");
                read("design = \"sobol\"\npoints = 8\nsensitivity = true\n" + text +
                     "[vary]\nzeta = { from = 1, to = 5 }\n");
              }),
              HasSubstr("with several cards"));
}

TEST_F(StudyFile, TheDocumentsExamplesAreStudies) {
  const std::filesystem::path source = SPALL_SOURCE_DIR;
  std::ifstream in(source / "docs/studies.md");
  std::string page{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::string begin = "```toml\n";
  int blocks = 0;
  for (std::size_t at = 0; (at = page.find(begin, at)) != std::string::npos; ++blocks) {
    at += begin.size();
    const std::string block = page.substr(at, page.find("\n```", at) - at);
    EXPECT_EQ(test::message_of([&] { read(block + "\n"); }), "no error") << block;
  }
  EXPECT_EQ(blocks, 3);
  std::ifstream tests(source / "docs/virtual-tests.md");
  page.append(std::istreambuf_iterator<char>(tests), std::istreambuf_iterator<char>());
  // Every key that a table allows is documented: the refusal of an unknown one lists them.
  for (const std::string& told :
       {refused_with("qqqqqqqqqqqqqqqqqq = 1"), refused_after("qqqqqqqqqqqqqqqqqq = 1"),
        refused_after("[vary]\nqqqqqqqqqqqqqqqqqq = 1"),
        refused("tests = [\"elastic\", \"tension\"]\n", "[[test]]\nqqqqqqqqqqqqqqqqqq = 1\n")}) {
    const auto at = told.find("allowed: ");
    ASSERT_NE(at, std::string::npos) << told;
    std::istringstream keys(told.substr(at + 9));
    for (std::string key; std::getline(keys >> std::ws, key, ',');)
      EXPECT_TRUE(page.find("`" + key + "`") != std::string::npos ||
                  page.find("[" + key + "]") != std::string::npos)
          << key << " is not documented";
  }
}

TEST_F(StudyFile, TheProjectsStudiesCanBeRead) {
  int studies = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(SPALL_SOURCE_DIR) / "data/cases")) {
    const std::string file = entry.path().filename().string();
    if (file.rfind("study-", 0) != 0 && file.rfind("test-", 0) != 0) continue;
    EXPECT_EQ(test::message_of([&] { study::read_study(entry.path()); }), "no error") << entry.path();
    ++studies;
  }
  EXPECT_GE(studies, 1);
}
