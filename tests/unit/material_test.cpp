// Eq. 1 and the material card.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

#include "libdem/core/error.h"
#include "libdem/core/random.h"
#include "libdem/material/card_numbers.h"
#include "libdem/material/element_size_rule.h"
#include "libdem/material/material_card.h"
#include "libdem/material/micro_macro.h"

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

namespace {

std::filesystem::path write_card(const std::string& text) {
  const auto file =
      std::filesystem::temp_directory_path() /
      (std::string("spall-card-") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".toml");
  std::ofstream(file) << text;
  return file;
}

const std::string good = R"(E = "30 GPa"
nu = 0.2
T = "3.1 MPa"
Co = "36 MPa"
zeta = 5
phi_i = "6 degree"
phi_c = "6 degree"
alpha = 3.7
beta = 2.198
gamma = 3.79
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

std::string error_of(const std::string& card) {
  const auto file = write_card(card);
  std::string message;
  try {
    dem::read_card(file);
    ADD_FAILURE() << "accepted:\n" << card;
  } catch (const dem::InputError& error) {
    message = error.what();
  }
  std::filesystem::remove(file);
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  EXPECT_THAT(message, HasSubstr(file.filename().string()));
  return message;
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

void expect_same_bits(const dem::MaterialCard& a, const dem::MaterialCard& b) {
  for (const auto member :
       {&dem::MaterialCard::young_modulus, &dem::MaterialCard::poisson_ratio, &dem::MaterialCard::density,
        &dem::MaterialCard::tensile_strength, &dem::MaterialCard::cohesion, &dem::MaterialCard::softening,
        &dem::MaterialCard::internal_friction, &dem::MaterialCard::contact_friction, &dem::MaterialCard::alpha,
        &dem::MaterialCard::beta, &dem::MaterialCard::gamma})
    EXPECT_TRUE(same_bits(a.*member, b.*member)) << a.*member << " against " << b.*member;
}

}  // namespace

TEST(MicroMacro, HasTheKnownValuesAtOneFifth) {
  const dem::LinkStiffness paper = dem::link_stiffness(1, 0.2, 3.7, 2.198, 3.79);
  EXPECT_NEAR(paper.shear_ratio, 0.21667, 5e-6);
  EXPECT_NEAR(paper.normal_modulus, 1.29727, 5e-6);
  const dem::LinkStiffness hentz = dem::link_stiffness(1, 0.2, 2.5, 2.0, 2.65);
  EXPECT_NEAR(hentz.shear_ratio, 0.41667, 5e-6);
  EXPECT_NEAR(hentz.normal_modulus, 0.93960, 5e-6);
}

TEST(MicroMacro, BothFormsOfEquation1AreInverse) {
  for (const double nu : {0.0, 0.05, 0.16, 0.2, 0.26}) {
    const dem::LinkStiffness link = dem::link_stiffness(30e9, nu, 3.7, 2.198, 3.79);
    const dem::MacroElasticity macro = dem::macro_elasticity(link, 3.7, 2.198, 3.79);
    EXPECT_NEAR(macro.young_modulus, 30e9, 30e9 * 1e-14);
    EXPECT_NEAR(macro.poisson_ratio, nu, 1e-14);
  }
}

TEST(MicroMacro, RefusesPoissonRatiosWithoutShearStiffness) {
  for (const double nu : {1 / 3.7, 0.3, 0.5, std::nan(""), -1.0})
    EXPECT_THROW(dem::link_stiffness(30e9, nu, 3.7, 2.198, 3.79), dem::InputError) << nu;
  EXPECT_THROW(dem::link_stiffness(-30e9, 0.2, 3.7, 2.198, 3.79), dem::InputError);
  EXPECT_THROW(dem::link_stiffness(30e9, 0.2, 0, 2.198, 3.79), dem::InputError);
  EXPECT_THROW(dem::macro_elasticity({0, 0.5}, 3.7, 2.198, 3.79), dem::InputError);
}

TEST(MaterialCard, ReadsInSi) {
  const auto file = write_card(good);
  const dem::MaterialCard card = dem::read_card(file);
  std::filesystem::remove(file);
  EXPECT_DOUBLE_EQ(card.young_modulus, 30e9);
  EXPECT_DOUBLE_EQ(card.tensile_strength, 3.1e6);
  EXPECT_DOUBLE_EQ(card.cohesion, 36e6);
  EXPECT_DOUBLE_EQ(card.internal_friction, 6 * M_PI / 180);
  EXPECT_EQ(card.unloading, dem::SofteningUnloading::secant);
}

TEST(MaterialCard, NamesEachMissingKey) {
  for (const char* key : {"E", "nu", "T", "Co", "zeta", "phi_i", "phi_c", "alpha", "beta", "gamma"}) {
    const std::string start = std::string(key) + " =";
    const auto begin =
        good.rfind('\n', good.find("\n" + start)) == std::string::npos ? 0 : good.find("\n" + start) + 1;
    const auto end = good.find('\n', begin) + 1;
    EXPECT_THAT(
        error_of(good.substr(0, begin) + good.substr(end)),
        AllOf(HasSubstr(std::string(": ") + key + ": the key is missing"), HasSubstr("write it as in")));
  }
}

TEST(MaterialCard, RefusesWithTheLineAndTheRemedy) {
  EXPECT_THAT(error_of(replaced(good, "zeta", "zetta")),
              AllOf(HasSubstr(":5: zetta"), HasSubstr("did you mean \"zeta\"")));
  EXPECT_THAT(error_of(good + "cohesion = \"3 MPa\"\n"), HasSubstr("did you mean \"Co\""));
  EXPECT_THAT(error_of(replaced(good, "\"30 GPa\"", "30")), AllOf(HasSubstr(":1: E"), HasSubstr("\"30 GPa\"")));
  EXPECT_THAT(error_of(replaced(good, "\"30 GPa\"", "\"30 kg\"")),
              AllOf(HasSubstr(":1: E"), HasSubstr("24 GPa")));
  EXPECT_THAT(error_of(replaced(good, "\"30 GPa\"", "\"-30 GPa\"")),
              AllOf(HasSubstr(":1: E"), HasSubstr("greater than 0")));
  EXPECT_THAT(error_of(replaced(good, "nu = 0.2", "nu = 0.28")),
              AllOf(HasSubstr(":2: nu"), HasSubstr("below 1/alpha = 0.2703")));
  EXPECT_THAT(error_of(replaced(good, "nu = 0.2", "nu = -0.1")), HasSubstr("0 or more"));
  EXPECT_THAT(error_of(replaced(good, "nu = 0.2", "nu = nan")), HasSubstr("not a finite number"));
  EXPECT_THAT(error_of(replaced(good, "nu = 0.2", "nu = inf")), HasSubstr("not a finite number"));
  EXPECT_THAT(error_of(replaced(good, "\"3.1 MPa\"", "\"nan MPa\"")), HasSubstr("finite number"));
  EXPECT_THAT(error_of(replaced(good, "\"6 degree\"", "\"90 degree\"")),
              AllOf(HasSubstr(":6: phi_i"), HasSubstr("0 to 89 degrees")));
  EXPECT_THAT(error_of(replaced(good, "zeta = 5", "zeta = 0")), HasSubstr("greater than 0"));
  EXPECT_THAT(error_of(good + "unloading = \"secent\"\n"),
              HasSubstr("did you mean \"secant\"? allowed: secant, elastic"));
  EXPECT_THAT(error_of(good + "rolling_limit = 0.5\n"),
              AllOf(HasSubstr("rolling_limit"), HasSubstr("no meaning in the paper's law"),
                    HasSubstr("link_law = \"moment_transfer\"")));
  EXPECT_THAT(error_of(good + "link_law = \"moment_transfer\"\nrolling_limit = -0.5\n"),
              AllOf(HasSubstr("rolling_limit"), HasSubstr("0 or more")));
  EXPECT_THAT(error_of(good + "link_law = \"moments\"\n"), HasSubstr("allowed: paper, moment_transfer"));
  EXPECT_THAT(error_of(good + "zeta = 6\n"), HasSubstr("this is not TOML"));
  EXPECT_THAT(error_of("E = \n"), HasSubstr(":1"));
  EXPECT_THAT(error_of(""), HasSubstr("the file is empty"));
}

TEST(MaterialCard, ComesBackWithTheSameBits) {
  dem::Random random(5);
  for (int k = 0; k < 200; ++k) {
    dem::MaterialCard card;
    card.young_modulus = random.uniform(1e9, 60e9);
    card.poisson_ratio = random.uniform(0, 0.25);
    card.tensile_strength = random.uniform(0.5e6, 5e6);
    card.cohesion = std::exp(random.uniform(0, 20));
    card.softening = random.uniform(0.1, 40);
    card.internal_friction = random.uniform(0, 1.5);
    card.contact_friction = random.uniform(0, 1.5);
    card.alpha = random.uniform(3, 4);
    card.beta = random.uniform(2, 3);
    card.unloading = dem::SofteningUnloading::elastic;
    card.broken_link_contact = dem::BrokenLinkContact::radii;
    if (k % 2 == 1) {
      card.link_law = dem::LinkLawKind::moment_transfer;
      card.slip_softening = random.uniform(0, 40);
      card.rolling_stiffness = random.uniform(0, 1);
      card.rolling_limit = random.uniform(0, 1);
      card.twisting_stiffness = random.uniform(0, 1);
      card.twisting_limit = random.uniform(0, 1);
    }
    card.name = "quotes \" and \\ and\nlines";
    card.provenance = {{"zeta first", "a \"b\""}, {"alpha_second", "tab\there"}};
    const auto file = write_card(dem::to_toml(card));
    const dem::MaterialCard back = dem::read_card(file);
    std::filesystem::remove(file);
    expect_same_bits(card, back);
    EXPECT_EQ(dem::identity_text(back), dem::identity_text(card));
    EXPECT_EQ(back.unloading, card.unloading);
    EXPECT_EQ(back.cohesion_during_softening, card.cohesion_during_softening);
    EXPECT_EQ(back.broken_link_contact, card.broken_link_contact);
    EXPECT_EQ(back.name, card.name);
    EXPECT_EQ(back.provenance, card.provenance);
  }
}

TEST(MaterialCard, NamesTheMomentsNumbersOnlyWhereItsLawUsesThem) {
  dem::MaterialCard card;
  EXPECT_THAT(dem::to_toml(card), Not(HasSubstr("rolling")));
  EXPECT_THAT(dem::identity_text(card), Not(HasSubstr("rolling")));
  EXPECT_THROW(dem::set_number(card, "slip_softening", 3), dem::InputError);
  card.link_law = dem::LinkLawKind::moment_transfer;
  EXPECT_THAT(dem::to_toml(card),
              AllOf(HasSubstr("link_law = \"moment_transfer\""), HasSubstr("rolling_limit = 0.5")));
  EXPECT_NO_THROW(dem::set_number(card, "slip_softening", 3));
  EXPECT_EQ(card.slip_softening, 3);
}

TEST(MaterialCard, IsWrittenInUnitsThatPeopleUse) {
  EXPECT_THAT(
      dem::to_toml(dem::MaterialCard{}),
      AllOf(HasSubstr("E = \"30 GPa\""), HasSubstr("T = \"3.1 MPa\""), HasSubstr("phi_i = \"6 degree\"")));
}

TEST(ElementSizeRule, KeepsAllButTensileStrengthAndSofteningAndUndoesItself) {
  const dem::MaterialCard card;
  const dem::MaterialCard finer = dem::for_element_size(card, 0.018, 0.006);
  EXPECT_NEAR(finer.softening, card.softening * std::pow(3, 0.25), 1e-12);
  EXPECT_NEAR(finer.tensile_strength, card.tensile_strength * std::pow(3, -0.14), 1e-6);
  EXPECT_EQ(finer.cohesion, card.cohesion);
  EXPECT_EQ(finer.young_modulus, card.young_modulus);
  EXPECT_NEAR(dem::for_element_size(finer, 0.006, 0.018).softening, card.softening, 1e-12);
  EXPECT_THROW(dem::for_element_size(card, 0, 0.01), dem::InputError);
  EXPECT_THROW(dem::for_element_size(card, 0.1, 0.001), dem::InputError);
}

TEST(MaterialCard, ShippedCardsAreValid) {
  const std::filesystem::path folder = std::filesystem::path(SPALL_SOURCE_DIR) / "data/cards";
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    EXPECT_NO_THROW(dem::read_card(entry.path())) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 2);
  const dem::MaterialCard slab = dem::read_card(folder / "paper-slab-table2.toml");
  EXPECT_DOUBLE_EQ(slab.cohesion, 36e6);
  EXPECT_DOUBLE_EQ(slab.softening, 5);
}
