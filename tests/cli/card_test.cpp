// spall card: what it prints, and each way in which a card is refused.
#include <nlohmann/json.hpp>

#include "tests/cli/command.h"

using cli::good_card;
using cli::replaced;
using testing::AllOf;
using testing::HasSubstr;

struct BadCard {
  const char *name, *before, *after;  // what to replace in the good card
  std::vector<std::string> told;      // what the line must contain
};

class BadCards : public cli::Command, public testing::WithParamInterface<BadCard> {};

TEST_P(BadCards, AreRefusedWithOneLine) {
  write("card.toml", replaced(good_card, GetParam().before, GetParam().after));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"card", "check", "card.toml"},
        {"card", "show", "card.toml", "--json"},
        {"card", "export", "card.toml", "--to", "csv", "-o", "out/card.csv"}}) {
    const std::string line = refusal(2, command);
    EXPECT_THAT(line, HasSubstr("card.toml"));
    for (const std::string& part : GetParam().told) EXPECT_THAT(line, HasSubstr(part));
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cards, BadCards,
    testing::Values(
        BadCard{"MissingKey", "T = \"3.1 MPa\"\n", "", {": T: the key is missing", "T = \"24 GPa\""}},
        BadCard{"UnknownKey", "zeta", "zetta", {":5: zetta: unknown key", "did you mean \"zeta\"?"}},
        BadCard{"BareNumber", "\"30 GPa\"", "30", {":1: E", "unit is missing", "E = \"30 GPa\""}},
        BadCard{"WrongUnit", "\"30 GPa\"", "\"30 kg\"", {":1: E", "not a unit of stress"}},
        BadCard{"NegativeModulus", "\"30 GPa\"", "\"-30 GPa\"", {":1: E", "greater than 0"}},
        BadCard{"PoissonTooLarge", "nu = 0.2", "nu = 0.3", {":2: nu", "below 1/alpha = 0.2703"}},
        BadCard{"NotANumber", "nu = 0.2", "nu = nan", {":2: nu", "not a finite number"}},
        BadCard{"NotANumberWithUnit", "\"36 MPa\"", "\"nan MPa\"", {":4: Co", "finite number"}},
        BadCard{"Infinite", "zeta = 5", "zeta = inf", {":5: zeta", "not a finite number"}},
        BadCard{"AngleTooLarge", "\"6 degree\"", "\"91 degree\"", {":6: phi_i", "0 to 89 degrees"}},
        BadCard{"UnknownChoice",
                "zeta = 5",
                "zeta = 5\nunloading = \"elastik\"",
                {":6: unloading", "did you mean \"elastic\"?"}},
        BadCard{"Syntax", "nu = 0.2", "nu = = 0.2", {"card.toml:2", "not TOML"}},
        BadCard{"Twice", "nu = 0.2", "nu = 0.2\nnu = 0.2", {"card.toml:3", "not TOML"}}),
    [](const auto& parameter) { return parameter.param.name; });

class Card : public cli::Command {};

TEST_F(Card, EmptyMissingOrFolderIsRefused) {
  write("card.toml", "");
  EXPECT_THAT(refusal(2, {"card", "check", "card.toml"}), HasSubstr("card.toml: the file is empty"));
  EXPECT_THAT(refusal(2, {"card", "check", "other.toml"}), HasSubstr("other.toml: there is no such file"));
  EXPECT_THAT(refusal(2, {"card", "check", "."}), HasSubstr("cannot be read"));
}

TEST_F(Card, ShowPrintsEquation1) {
  write("card.toml", good_card);
  const auto outcome = spall({"card", "show", "card.toml", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto json = nlohmann::json::parse(outcome.out);
  EXPECT_DOUBLE_EQ(json["E"].get<double>(), 30e9);
  EXPECT_NEAR(json["link"]["shear_ratio"].get<double>(), 0.21667, 5e-6);
  EXPECT_NEAR(json["link"]["normal_modulus"].get<double>() / 30e9, 1.29727, 5e-6);
  const auto words = spall({"card", "show", "card.toml"});
  EXPECT_THAT(words.out, AllOf(HasSubstr("E = \"30 GPa\""), HasSubstr("Ks/Kn = 0.21667")));
}

TEST_F(Card, CheckIsQuietOnRequest) {
  write("card.toml", good_card);
  EXPECT_THAT(spall({"card", "check", "card.toml"}).out, HasSubstr("valid"));
  const auto quiet = spall({"card", "check", "--quiet", "card.toml"});
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.out + quiet.err, "");
}

TEST_F(Card, WhatShowPrintsIsACardAgain) {
  write("card.toml", good_card);
  write("again.toml", spall({"card", "show", "card.toml"}).out);
  EXPECT_EQ(spall({"card", "show", "again.toml", "--json"}).out,
            spall({"card", "show", "card.toml", "--json"}).out);
}

TEST_F(Card, AFolderThatCannotBeWrittenIsExitCode1) {
  write("card.toml", good_card);
  EXPECT_THAT(refusal(1, {"card", "export", "card.toml", "--to", "csv", "-o", "card.toml/x/card.csv"}),
              HasSubstr("card.toml/x"));
  EXPECT_THAT(refusal(1, {"card", "example", "-o", "."}), HasSubstr("folder"));
}
