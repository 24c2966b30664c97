// The law of a pair (Fig. 1 of the paper), driven through the real step with two spheres in prescribed motion.
#include <gtest/gtest.h>

#include <cmath>

#include "libdem/probe/damage.h"
#include "tests/verification/scene.h"

using dem::Vec3;
using scene::Pair;
using scene::plain_law;

namespace {

/// Tension that Fig. 1 gives on first loading [N].
double envelope(const dem::LinkLaw& law, double strain) {
  const double yield = law.yield_strain();
  if (strain <= yield) return law.normal_modulus * strain * Pair::area;
  const double left = law.tensile_strength - law.normal_modulus / law.softening * (strain - yield);
  return left > 0 ? left * Pair::area : 0;
}

double strength_of(const Pair& pair) { return pair.assembly.law.tensile_strength * Pair::area; }  // T S_int [N]

}  // namespace

TEST(LinkInTension, RisesWithKnToTheStrengthThenFallsWithKnOverZetaToZero) {
  Pair pair(plain_law());
  const dem::LinkLaw& law = pair.assembly.law;
  const double elongation = 1.2 * law.breaking_strain() * Pair::distance;
  double peak = 0;
  pair.move(Vec3(elongation, 0, 0), 7200, [&] {
    const double tension = -pair.normal();
    ASSERT_NEAR(tension, envelope(law, pair.strain()), 1e-9 * strength_of(pair)) << pair.strain();
    ASSERT_EQ(dem::broken_links(law, pair.assembly.links), pair.strain() >= law.breaking_strain() ? 1u : 0u);
    peak = std::max(peak, tension);
  });
  EXPECT_NEAR(peak, law.tensile_strength * Pair::area, 1e-3 * peak);
  EXPECT_EQ(pair.normal(), 0);
  EXPECT_NEAR(law.breaking_strain(), law.tensile_strength / law.normal_modulus * (1 + law.softening), 1e-18);
}

TEST(LinkInTension, PullsWithEqualAndOppositeForcesAndNoMoment) {
  Pair pair(plain_law());
  pair.stretch_to(5e-5);
  EXPECT_EQ(pair.force(0), -pair.force(1));
  EXPECT_GT(pair.force(0).x(), 0);  // a is pulled towards b
  EXPECT_EQ(pair.moment(0).norm() + pair.moment(1).norm(), 0);
}

TEST(LinkInCompression, IsElasticWithoutLimitAndDoesNoDamage) {
  Pair pair(plain_law());
  pair.move(Vec3(-0.03, 0, 0), 500, [&] {
    ASSERT_NEAR(pair.normal(), pair.kn() * (Pair::distance - pair.gap()), 1e-9 * pair.kn() * 0.03);
  });
  EXPECT_EQ(pair.energy().softening, 0);
  pair.stretch_to(5e-5, 500);
  EXPECT_NEAR(-pair.normal(), envelope(pair.assembly.law, 5e-5), 1e-8 * strength_of(pair));
}

TEST(UnloadingInSoftening, ReturnsToTheOriginWithSecant) {
  Pair pair(plain_law());
  const double reached = 3 * pair.assembly.law.yield_strain();
  pair.stretch_to(reached, 300);
  const double top = envelope(pair.assembly.law, reached);
  EXPECT_NEAR(-pair.normal(), top, 1e-8 * top);
  for (const double part : {0.75, 0.5, 0.25, 0.0, 0.6}) {  // down to the origin and up again, on the same line
    pair.stretch_to(part * reached);
    EXPECT_NEAR(-pair.normal(), part * top, 1e-8 * top) << part;
  }
  pair.stretch_to(-reached);  // compression keeps the full stiffness
  EXPECT_NEAR(pair.normal(), pair.kn() * reached * Pair::distance, 1e-8 * strength_of(pair));
  pair.stretch_to(4 * pair.assembly.law.yield_strain(), 300);  // and the envelope goes on where it was left
  EXPECT_NEAR(-pair.normal(), envelope(pair.assembly.law, 4 * pair.assembly.law.yield_strain()), 1e-8 * top);
}

TEST(UnloadingInSoftening, RunsParallelToTheElasticLineWithElastic) {
  dem::LinkLaw law = plain_law();
  law.unloading = dem::SofteningUnloading::elastic;
  Pair pair(law);
  const double reached = 3 * law.yield_strain();
  pair.stretch_to(reached, 300);
  const double top = envelope(law, reached);
  EXPECT_NEAR(-pair.normal(), top, 1e-8 * top);
  for (const double back : {0.3, 1.0, 2.5, 4.0, 0.5}) {  // in yield strains; past the plastic strain it pushes
    pair.stretch_to(reached - back * law.yield_strain());
    EXPECT_NEAR(-pair.normal(), top - back * strength_of(pair), 1e-8 * strength_of(pair)) << back;
  }
  pair.stretch_to(4 * law.yield_strain(), 300);
  EXPECT_NEAR(-pair.normal(), envelope(law, 4 * law.yield_strain()), 1e-8 * top);
}

TEST(CohesionDuringSoftening, StaysWholeOrShrinksWithTheTensileStrength) {
  for (const bool proportional : {false, true}) {
    dem::LinkLaw law = plain_law();
    law.cohesion_during_softening =
        proportional ? dem::CohesionDuringSoftening::proportional : dem::CohesionDuringSoftening::constant;
    Pair pair(law);
    const double reached = 3 * law.yield_strain();  // two of five parts of the strength are gone
    pair.stretch_to(reached, 300);
    pair.stretch_to(0);  // so that friction plays no part
    const double limit = law.cohesion * Pair::area * (proportional ? 0.6 : 1.0);
    pair.move(Vec3(0, 3 * limit / pair.ks(), 0), 3000);
    pair.stretch_to(0);
    EXPECT_LT(std::abs(pair.normal()), 1e-3 * limit);
    EXPECT_NEAR(pair.shear().norm(), limit, 1e-3 * limit) << proportional;
  }
}

TEST(BrokenLink, PushesFromTheInitialDistanceOrFromTheSumOfTheRadii) {
  for (const bool at_radii : {false, true}) {
    dem::LinkLaw law = plain_law();
    law.broken_link_contact =
        at_radii ? dem::BrokenLinkContact::radii : dem::BrokenLinkContact::initial_distance;
    Pair pair(law);
    pair.stretch_to(1.5 * law.breaking_strain(), 300);
    EXPECT_EQ(pair.normal(), 0);
    const double start = at_radii ? Pair::ra + Pair::rb : Pair::distance;
    const double stiffness = law.normal_modulus * Pair::area / start;
    pair.move(Vec3(start + 1e-6 - pair.gap(), 0, 0), 300);
    EXPECT_EQ(pair.normal(), 0) << "not yet touching";
    for (const double depth : {1e-6, 1e-4, 5e-3}) {
      pair.move(Vec3(start - depth - pair.gap(), 0, 0), 100);
      EXPECT_NEAR(pair.normal(), stiffness * depth, 1e-8 * stiffness * 1e-3) << depth;
      EXPECT_NEAR(pair.energy().elastic, 0.5 * stiffness * depth * depth, 1e-8 * stiffness * 1e-6) << depth;
    }
    pair.move(Vec3(start + 1e-3 - pair.gap(), 0, 0), 300);
    EXPECT_EQ(pair.normal(), 0) << "broken links do not pull";
  }
}

TEST(LinkInShear, RisesWithKsWhicheverWayTheSurfacesMove) {
  Pair pair(scene::elastic_law());
  const double way = 1e-7;  // so small that the axis hardly turns
  pair.move(Vec3(0, 0.6 * way, 0.8 * way), 50);
  EXPECT_NEAR(pair.shear().y(), 0.6 * pair.ks() * way, 1e-5 * pair.ks() * way);
  EXPECT_NEAR(pair.shear().z(), 0.8 * pair.ks() * way, 1e-5 * pair.ks() * way);

  // By rotation of either sphere: the arms of Eq. 2 are 55 and 45 mm.
  for (const std::size_t which : {0u, 1u}) {
    Pair turned(scene::elastic_law());
    const double angle = 1e-6, arm = which == 0 ? 0.055 : 0.045;
    turned.hold(which, Vec3::Zero(), Vec3(0, 0, angle / (50 * turned.options.time_step)));
    turned.steps(50);
    EXPECT_NEAR(turned.shear().y(), -turned.ks() * arm * angle, 1e-9 * turned.ks() * angle);
    const Vec3 f = turned.force(0);  // moments are the contact point's arms times that force
    EXPECT_NEAR(turned.moment(0).z(), 0.055 * f.y(), 1e-12 * std::abs(f.y()));
    EXPECT_NEAR(turned.moment(1).z(), 0.045 * f.y(), 1e-12 * std::abs(f.y()));
  }
}

TEST(LinkInShear, StopsAtCohesionPlusFrictionAndStaysThere) {
  for (const double strain : {-3e-4, -1e-4, 0.0, 5e-5}) {
    const dem::LinkLaw law = plain_law();
    Pair pair(law);
    pair.stretch_to(strain);
    const double fn = -strain * pair.kn() * Pair::distance;
    const double limit = law.cohesion * Pair::area + fn * law.internal_slope;
    const double slip = limit / pair.ks();
    // Elastic below the limit, the limit's own value beyond it: taken at its maximum, not broken.
    pair.move(Vec3(0, 0.9 * slip, 0), 200);
    EXPECT_NEAR(pair.shear().norm(), 0.9 * limit, 2e-3 * limit) << strain;
    const double elastic = pair.energy().elastic;
    EXPECT_EQ(pair.sliding, 0);
    pair.move(Vec3(0, 2.1 * slip, 0), 600, [&] {
      const double now = law.cohesion * Pair::area + pair.normal() * law.internal_slope;
      ASSERT_LE(pair.shear().norm(), now * (1 + 1e-12));
    });
    const double now = law.cohesion * Pair::area + pair.normal() * law.internal_slope;
    EXPECT_NEAR(pair.shear().norm(), now, 1e-9 * now) << strain;
    EXPECT_GT(pair.sliding, elastic);
    EXPECT_EQ(dem::broken_links(law, pair.assembly.links), 0u);
    // Back: elastic from the limit, with Ks.
    const double before = pair.shear().y();
    pair.move(Vec3(0, -0.5 * slip, 0), 200);
    EXPECT_NEAR(before - pair.shear().y(), 0.5 * pair.ks() * slip, 2e-3 * limit) << strain;
  }
}

TEST(LinkInShear, HasNoShearWhereTensionUsesUpTheCohesion) {
  dem::LinkLaw law = plain_law();
  law.cohesion = 0.5e6;
  law.internal_slope = 1;
  Pair pair(law);
  pair.stretch_to(0.9 * law.yield_strain());  // F_n = -2.7 MPa S_int: the limit would be negative
  pair.move(Vec3(0, 1e-6, 0), 100);
  EXPECT_EQ(pair.assembly.links.shear_y[0], 0);
}

TEST(BrokenLink, RubsWithTheContactAngleOnly) {
  const dem::LinkLaw law = plain_law();
  Pair pair(law);
  pair.stretch_to(1.1 * law.breaking_strain(), 300);
  pair.stretch_to(-3e-4, 300);
  pair.move(Vec3(0, 6e-5, 0), 2000);
  EXPECT_GT(pair.normal(), 0);
  EXPECT_NEAR(pair.shear().norm(), pair.normal() * law.contact_slope, 1e-9 * pair.normal());
  pair.stretch_to(1e-6, 300);
  EXPECT_EQ(pair.shear().norm(), 0) << "apart again";
}

TEST(NeverLinkedPair, PushesFromTheSumOfTheRadiiRubsAndNeverPulls) {
  const dem::LinkLaw law = plain_law();
  Pair pair(law, false, 0.12);
  const double touching = Pair::ra + Pair::rb, stiffness = law.normal_modulus * Pair::area / touching;
  pair.move(Vec3(touching + 1e-6 - 0.12, 0, 0), 300);
  EXPECT_EQ(pair.force(1).norm(), 0);
  EXPECT_EQ(pair.assembly.contacts.count, 1u) << "in the list before it touches";
  pair.move(Vec3(-2e-5 - 1e-6, 0, 0), 100);
  EXPECT_NEAR(pair.normal(), stiffness * 2e-5, 1e-8 * stiffness * 2e-5);
  pair.move(Vec3(0, 2e-5, 0), 2000);
  EXPECT_NEAR(pair.shear().norm(), pair.normal() * law.contact_slope, 1e-9 * pair.normal());
  EXPECT_GT(pair.shear().norm(), 0);
  pair.move(Vec3(3e-5, 0, 0), 300);
  EXPECT_EQ(pair.force(1).norm(), 0);
  EXPECT_EQ(pair.energy().elastic + pair.energy().softening, 0);
}

TEST(SofteningEnergy, EqualsTheAreaUnderTheForceWhenTheLinkIsBroken) {
  for (const double zeta : {1.0, 5.0, 20.0})
    for (const auto unloading : {dem::SofteningUnloading::secant, dem::SofteningUnloading::elastic}) {
      dem::LinkLaw law = plain_law();
      law.softening = zeta;
      law.unloading = unloading;
      Pair pair(law);
      const double strength = strength_of(pair);
      const double expected = strength * strength * (1 + zeta) / (2 * pair.kn());
      const double work = pair.move(Vec3(1.1 * law.breaking_strain() * Pair::distance, 0, 0), 20000);
      EXPECT_NEAR(work, expected, 1e-6 * expected) << zeta;
      EXPECT_NEAR(pair.energy().softening, expected, 1e-9 * expected) << zeta;
      EXPECT_EQ(pair.energy().elastic, 0) << zeta;
      EXPECT_NEAR(dem::softening_energy(law, law.breaking_strain(), Pair::area * Pair::distance), expected,
                  1e-12 * expected);
    }
}

TEST(SofteningEnergy, AndStoredEnergyMakeUpTheWorkAtEveryStrain) {
  for (const auto unloading : {dem::SofteningUnloading::secant, dem::SofteningUnloading::elastic}) {
    dem::LinkLaw law = plain_law();
    law.unloading = unloading;
    Pair pair(law);
    double work = 0;
    const double whole = strength_of(pair) * strength_of(pair) * (1 + law.softening) / (2 * pair.kn());
    for (const double yields : {0.8, 2.0, 0.5, -1.0, 3.0, 1.2, 5.0, 2.0, 5.5, 7.0, -2.0}) {
      work += pair.stretch_to(yields * law.yield_strain(), 4000);
      const dem::PairEnergy energy = pair.energy();
      EXPECT_NEAR(energy.elastic + energy.softening, work, 1e-5 * whole) << yields;
    }
  }
}

TEST(Ledger, ClosesWhenShearSlidesToAndFro) {
  for (const bool broken : {false, true}) {
    const dem::LinkLaw law = plain_law();
    Pair pair(law);
    double work = 0;
    if (broken) work += pair.stretch_to(1.1 * law.breaking_strain(), 4000);
    work += pair.stretch_to(-2e-4, 4000);
    const double slip = law.cohesion * Pair::area / pair.ks();
    dem::Random random(4);
    for (int k = 0; k < 12; ++k) {
      const double y = random.uniform(-4, 4) * slip, z = random.uniform(-4, 4) * slip;
      work += pair.move(Vec3(0, y, z) - Vec3(0, pair.position(1).y(), pair.position(1).z()), 400);
      const dem::PairEnergy energy = pair.energy();
      EXPECT_NEAR(energy.elastic + energy.softening + pair.sliding, work, 2e-4 * work) << broken << " " << k;
    }
    EXPECT_GT(pair.sliding, 0.4 * work);
  }
}

TEST(Ledger, ClosesWhenALinkBreaksUnderShear) {
  const dem::LinkLaw law = plain_law();
  Pair pair(law);
  double work = pair.move(Vec3(0, 0.8 * law.cohesion * Pair::area / pair.ks(), 0), 1000);
  work += pair.move(Vec3(1.2 * law.breaking_strain() * Pair::distance, 0, 0), 8000);
  EXPECT_EQ(dem::broken_links(law, pair.assembly.links), 1u);
  EXPECT_EQ(pair.energy().elastic, 0);
  EXPECT_GT(pair.sliding, 0) << "the shear force that the broken link lets go";
  EXPECT_NEAR(pair.energy().softening + pair.sliding, work, 1e-3 * work);
}
