// Uniaxial tests of a small specimen: energy, rate, scaling, end conditions, damage.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "specimens/packing.h"
#include "specimens/virtual_tests/setup.h"
#include "specimens/virtual_tests/uniaxial.h"

using dem::EndCondition;
using virtual_tests::Loading;
using virtual_tests::UniaxialOptions;
using virtual_tests::UniaxialResult;

namespace {

const specimens::Specimen& prism() {
  static const specimens::Specimen made = [] {
    specimens::PackingOptions packing;
    packing.size = dem::Vec3(0.5, 0.25, 0.25);
    packing.elements = 2700;
    packing.threads = 1;
    return specimens::make_specimen(packing);
  }();
  return made;
}

UniaxialResult run(Loading loading, const dem::MaterialCard& card = {}, UniaxialOptions options = {}) {
  options.loading = loading;
  if (options.expected_strength == 0) options.expected_strength = loading == Loading::tension ? 2.5e6 : 15e6;
  return run_uniaxial(prism(), card, options);
}

const UniaxialResult& tension() {
  static const UniaxialResult result = run(Loading::tension);
  return result;
}

const UniaxialResult& compression() {
  static const UniaxialResult result = run(Loading::compression);
  return result;
}

void expect_sound(const UniaxialResult& result) {
  EXPECT_TRUE(result.passed_peak);
  EXPECT_TRUE(result.quasi_static()) << result.unbalanced_force_ratio;
  EXPECT_LT(result.energy_balance_error, 0.005);
  // At the end too, all parts of the ledger belong to one and the same step.
  EXPECT_LT(std::abs(result.energy.imbalance()), 5e-4 * result.energy.external);
  EXPECT_GT(result.energy.softening, 0);
}

}  // namespace

TEST(Tension, ClosesItsLedgerAndIsQuasiStatic) { expect_sound(tension()); }

TEST(Compression, ClosesItsLedgerAndIsQuasiStatic) { expect_sound(compression()); }

TEST(Compression, EndsHigherThanTensionAndSlides) {
  EXPECT_GT(compression().peak_stress, 4 * tension().peak_stress);
  EXPECT_GT(compression().energy.sliding, compression().energy.softening);
}

TEST(Rate, HalvingItMovesThePeakByLessThanThreePercent) {
  for (const Loading loading : {Loading::tension, Loading::compression}) {
    const UniaxialResult& usual = loading == Loading::tension ? tension() : compression();
    UniaxialOptions options;
    options.velocity = usual.velocity / 2;
    options.stop_at = 0.9;
    const UniaxialResult slow = run(loading, {}, options);
    RecordProperty(std::string(name_of(loading)), std::to_string(slow.peak_stress / usual.peak_stress));
    EXPECT_NEAR(slow.peak_stress, usual.peak_stress, 0.03 * usual.peak_stress) << name_of(loading);
    EXPECT_GT(slow.steps, usual.steps) << name_of(loading);
  }
}

TEST(Scaling, AllStressesTimesKGiveTheCurveTimesK) {
  // With E, T and Co times k, and the density too, every force is k times as large at the same motion.
  const double k = 3;
  dem::MaterialCard card;
  card.young_modulus *= k, card.tensile_strength *= k, card.cohesion *= k, card.density *= k;
  UniaxialOptions options;
  options.expected_strength = 2.5e6 * k;
  const UniaxialResult scaled = run(Loading::tension, card, options);
  EXPECT_NEAR(scaled.peak_stress, k * tension().peak_stress, 1e-3 * k * tension().peak_stress);
  EXPECT_NEAR(scaled.peak_strain, tension().peak_strain, 1e-3 * tension().peak_strain);
}

TEST(Scaling, StrengthsTimesKGiveStressesTimesK) {
  // At the same E, strains are k times as large too: small strains make the motion the same, k times as far, if
  // the platens are k times as fast.
  const double k = 2;
  dem::MaterialCard card;
  card.tensile_strength *= k, card.cohesion *= k;
  UniaxialOptions options;
  options.expected_strength = 2.5e6 * k;
  const UniaxialResult scaled = run(Loading::tension, card, options);
  EXPECT_NEAR(scaled.velocity, k * tension().velocity, 1e-9 * scaled.velocity);
  RecordProperty("ratio", std::to_string(scaled.peak_stress / tension().peak_stress));
  EXPECT_NEAR(scaled.peak_stress, k * tension().peak_stress, 1e-3 * k * tension().peak_stress);
  EXPECT_NEAR(scaled.peak_strain, k * tension().peak_strain, 1e-2 * k * tension().peak_strain);
}

TEST(Scaling, AllLengthsTimesTwoGiveTheSameStresses) {
  // The model knows no length but the elements' own, and the platens' speed does not depend on the length: a
  // specimen twice as large, of elements twice as large, is the same specimen with time twice as slow.
  specimens::Specimen larger = prism();
  larger.size *= 2;
  for (dem::Vec3& x : larger.centres) x *= 2;
  for (double& r : larger.radii) r *= 2;
  for (dem::LinkGeometry& link : larger.links) link.initial_distance *= 2;
  UniaxialOptions options;
  options.stop_at = 0.9;
  options.expected_strength = 2.5e6;
  const UniaxialResult scaled = run_uniaxial(larger, dem::MaterialCard{}, options);
  EXPECT_EQ(scaled.velocity, tension().velocity);
  EXPECT_NEAR(scaled.time_step, 2 * tension().time_step, 1e-3 * scaled.time_step);
  EXPECT_NEAR(scaled.peak_stress, tension().peak_stress, 1e-4 * scaled.peak_stress);
  EXPECT_NEAR(scaled.peak_strain, tension().peak_strain, 1e-3 * scaled.peak_strain);
  EXPECT_NEAR(scaled.young_modulus, tension().young_modulus, 1e-4 * scaled.young_modulus);
}

TEST(Ends, FixedOnesGiveAHigherCompressiveStrengthThanFreeOnes) {
  UniaxialOptions options;
  options.ends = EndCondition::fixed;
  options.stop_at = 0.9;
  const UniaxialResult fixed = run(Loading::compression, {}, options);
  EXPECT_GT(fixed.peak_stress, 1.02 * compression().peak_stress);
  RecordProperty("fixed_over_free", std::to_string(fixed.peak_stress / compression().peak_stress));
}

namespace {

/// Compression of a small cube between rough platens, with the law that has a peak for every friction.
UniaxialResult rubbed(EndCondition ends, double friction, int threads = 1) {
  static const specimens::Specimen cube = [] {
    specimens::PackingOptions packing;
    packing.size = dem::Vec3(0.2, 0.2, 0.2);
    packing.elements = 700;
    packing.threads = 1;
    return specimens::make_specimen(packing);
  }();
  dem::MaterialCard card;
  card.link_law = dem::LinkLawKind::moment_transfer;
  card.tensile_strength = 4.5e6, card.cohesion = 25e6, card.softening = 3, card.slip_softening = 3;
  UniaxialOptions options;
  options.loading = Loading::compression;
  options.ends = ends;
  options.platen_friction = friction;
  options.expected_strength = 50e6;
  options.rate = 0.03;
  options.stop_at = 0.9;
  options.threads = threads;
  return run_uniaxial(cube, card, options);
}

}  // namespace

TEST(RoughEnds, WithoutFrictionAreFreeOnesBitForBit) {
  const UniaxialResult free = rubbed(EndCondition::free, 0.2), rough = rubbed(EndCondition::rough, 0);
  EXPECT_EQ(rough.state_sha256, free.state_sha256);
  EXPECT_EQ(rough.peak_stress, free.peak_stress);
}

TEST(RoughEnds, RaiseTheStrengthWithFrictionFromThatOfFreeToAboutThatOfFixedEnds) {
  const double free = rubbed(EndCondition::free, 0).peak_stress,
               fixed = rubbed(EndCondition::fixed, 0).peak_stress;
  double last = free;
  for (const double friction : {0.05, 0.1, 0.2}) {
    const UniaxialResult found = rubbed(EndCondition::rough, friction);
    EXPECT_GT(found.peak_stress, last) << friction;
    EXPECT_LT(found.energy_balance_error, 0.005) << friction;
    last = found.peak_stress;
  }
  EXPECT_GT(fixed, 1.3 * free);
  EXPECT_NEAR(rubbed(EndCondition::rough, 2).peak_stress, fixed, 0.2 * fixed);
}

TEST(RoughEnds, GiveTheSameBitsOnAnyNumberOfThreads) {
  EXPECT_EQ(rubbed(EndCondition::rough, 0.1, 3).state_sha256, rubbed(EndCondition::rough, 0.1).state_sha256);
}

TEST(Damage, IsBrokenOverInitialLinksOfEachElement) {
  const UniaxialResult& result = tension();
  const specimens::Specimen& specimen = prism();
  ASSERT_EQ(result.links, specimen.links.size());
  ASSERT_EQ(result.damage.size(), specimen.elements());
  std::vector<int> initial(specimen.elements(), 0);
  for (const dem::LinkGeometry& link : specimen.links)
    ++initial[static_cast<std::size_t>(link.a)], ++initial[static_cast<std::size_t>(link.b)];
  double ends = 0;  // broken links, each counted at both of its ends
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const double broken = result.damage[i] * initial[i];
    EXPECT_NEAR(broken, std::round(broken), 1e-9) << i;
    EXPECT_GE(result.damage[i], 0);
    EXPECT_LE(result.damage[i], 1);
    ends += broken;
  }
  EXPECT_NEAR(ends, 2.0 * static_cast<double>(result.broken_links), 1e-6);
  EXPECT_GT(result.broken_links, 100u);
  EXPECT_DOUBLE_EQ(result.damage_ratio(),
                   static_cast<double>(result.broken_links) / static_cast<double>(result.links));
}

TEST(Damage, GrowsOnlyAndIsOneCrackInTension) {
  const auto& curve = tension().curve;
  for (std::size_t k = 1; k < curve.size(); ++k) EXPECT_GE(curve[k].broken, curve[k - 1].broken);
  // Links break in a band across the specimen, not everywhere.
  const specimens::Specimen& specimen = prism();
  double weight = 0, mean = 0, square = 0;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const double x = specimen.centres[i].x(), d = tension().damage[i];
    weight += d, mean += d * x, square += d * x * x;
  }
  mean /= weight;
  EXPECT_LT(std::sqrt(square / weight - mean * mean), 0.2 * specimen.size.x());
}
