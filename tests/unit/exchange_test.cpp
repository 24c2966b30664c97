// Which specimens can be made anew by distance, and what the files beside a script are called.
#include "exchange/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "exchange/link_rule.h"
#include "exchange/link_values.h"
#include "libdem/core/error.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "tests/message_of.h"

namespace {

specimens::Specimen small_specimen() {
  specimens::PackingOptions options;
  options.size = {0.3, 0.2, 0.2};
  options.elements = 900;
  options.seed = 3;
  return specimens::make_specimen(options);
}

}  // namespace

TEST(Exchange, TheFactorOfALinkedSpecimenLinksTheSamePairs) {
  specimens::Specimen specimen = small_specimen();
  const double factor = exchange::interaction_factor(specimen);
  EXPECT_NEAR(factor, specimen.interaction_radius_factor, 1e-12);
  double longest = 0;
  for (const auto& link : specimen.links)
    longest = std::max(longest, link.initial_distance / (specimen.radii[static_cast<std::size_t>(link.a)] +
                                                         specimen.radii[static_cast<std::size_t>(link.b)]));
  EXPECT_LT(longest, factor);
}

TEST(Exchange, ASpecimenWhoseLinksWereCutIsRefusedByYadeAndTakenByOthers) {
  specimens::Specimen specimen = small_specimen();
  specimen.links.erase(specimen.links.begin() + 100, specimen.links.begin() + 140);
  const dem::MaterialCard card;
  const exchange::Request request{card, &specimen, "Spall", "a.py"};
  EXPECT_THAT(
      test::message_of<dem::InputError>([&] { exchange::export_card(exchange::Format::yade_cpm, request); }),
      testing::HasSubstr("--to lammps-bpm or csv"));
  EXPECT_EQ(exchange::export_card(exchange::Format::lammps_bpm, request).beside.size(), 2u);
  EXPECT_EQ(exchange::export_card(exchange::Format::csv, request).beside.size(), 2u);
}

TEST(Exchange, ScriptsLoseTheirEndingAndOtherNamesGrow) {
  EXPECT_EQ(exchange::companion_name("concrete.py", ".spheres"), "concrete.spheres");
  EXPECT_EQ(exchange::companion_name("in.concrete", ".data"), "in.concrete.data");
  EXPECT_EQ(exchange::companion_name("a.b.lmp", ".data"), "a.b.data");
}

TEST(Exchange, ALinksMomentsAreTheCardsOnlyWhereItTransfersThem) {
  dem::MaterialCard card;
  EXPECT_EQ(exchange::link_values(dem::make_link_law(card), 0.01, 0.026).rolling_stiffness, 0);
  card.link_law = dem::LinkLawKind::moment_transfer;
  const auto values = exchange::link_values(dem::make_link_law(card), 0.01, 0.026);
  EXPECT_DOUBLE_EQ(values.rolling_stiffness, 0.25 * values.normal_stiffness * 1e-4);
}
