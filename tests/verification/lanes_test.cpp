// Lanes against plain doubles: each instruction set, each choice of the law, links and whole steps.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "libdem/core/instructions.h"
#include "libdem/force/contact_loop.h"
#include "libdem/probe/damage.h"
#include "tests/reference_loop.h"
#include "tests/verification/scene.h"

using dem::Vec3;
using scene::plain_law;

namespace {

struct Deviation {
  double largest = 0, scale = 0;
  void see(double value, double reference) {
    // Written so that a NaN counts as the worst deviation there is.
    const double off = std::abs(value - reference);
    largest = off <= largest ? largest : std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
    scale = std::max(scale, std::abs(reference));
  }
  double relative() const { return largest / scale; }
};

/// What the lanes of one instruction set give for a random history, against the law on plain doubles.
template <std::size_t number>
void compare(const dem::ContactLoops& loops, const std::string& set) {
  constexpr dem::LinkChoices choices = dem::choices_of(number);
  const std::string what = set + (choices.elastic_unloading ? " elastic" : " secant") +
                           (choices.proportional_cohesion ? " proportional" : " constant") +
                           (choices.contact_at_radii ? " radii" : " D_init") +
                           (choices.moment_transfer ? " moments" : "");
  dem::LinkLaw law = plain_law();
  law.tensile_strength = 0.01 * law.normal_modulus;  // large strains, so that 1 + strain loses no digits
  law.cohesion = 0.01 * law.normal_modulus;
  law.softening = 3;
  if (choices.moment_transfer) law = scene::with_moments(law);
  dem::Assembly assembly = scene::cluster(60, law, 11);
  dem::Particles& particles = assembly.particles;
  dem::Links& links = assembly.links;
  if (choices.moment_transfer) links.remember_moments();
  dem::Links plain = links;
  std::vector<dem::ContactRow> rows(links.padded());
  std::vector<dem::SixRow> moment_rows(links.padded());
  std::array<Deviation, 8> row;
  Deviation moment_row, strain, shear, moments, slip, sliding;
  dem::Random random(12);
  const double dt = 1e-5;
  double slid = 0, slid_plain = 0;
  std::size_t softened = 0, pushed = 0;
  for (int n = 0; n < 400; ++n) {
    for (std::size_t i = 0; i < particles.count; ++i) {  // wanders about its place, faster and faster
      const auto any = [&] {
        const double x = random.normal(), y = random.normal(), z = random.normal();
        return Vec3(x, y, z);
      };
      const Vec3 velocity = any() * 4 * (1 + n / 100.0) - 0.02 / dt * particles.displacement(i);
      const Vec3 spin = any() * 100;
      particles.set_velocity(i, velocity, spin);
    }
    double now = 0;
    dem::ContactLoopArguments arguments{&law,
                                        dt,
                                        particles.kinematics.data(),
                                        links.a.data(),
                                        links.b.data(),
                                        links.inverse_initial_distance.data(),
                                        links.max_strain.data(),
                                        links.shear_x.data(),
                                        links.shear_y.data(),
                                        links.shear_z.data(),
                                        {links.slip.data(), links.moment_x.data(), links.moment_y.data(),
                                         links.moment_z.data(), links.twist.data()},
                                        rows.data(),
                                        moment_rows.data(),
                                        0,
                                        links.padded(),
                                        0};
    loops.loop[number](arguments);
    slid += arguments.sliding;
    reference::move(particles, dt);
    reference::each_pair<choices>(
        law, particles, plain, dt, now,
        [&](std::size_t k, std::size_t, std::size_t, const dem::PairForce<double>& force,
            const dem::PairMoment<double>& moment, const dem::PairKinematics<double>& pair) {
          const double expected[8] = {force.fx, force.fy, force.fz,   force.mx,
                                      force.my, force.mz, pair.arm_a, pair.arm_b};
          for (std::size_t c = 0; c < 8; ++c) row[c].see(rows[k].value[c], expected[c]);
          strain.see(links.max_strain[k], plain.max_strain[k]);
          shear.see(links.shear_x[k], plain.shear_x[k]);
          shear.see(links.shear_y[k], plain.shear_y[k]);
          shear.see(links.shear_z[k], plain.shear_z[k]);
          if constexpr (choices.moment_transfer) {
            moment_row.see(moment_rows[k].value[3], moment.x);
            moment_row.see(moment_rows[k].value[4], moment.y);
            moment_row.see(moment_rows[k].value[5], moment.z);
            moments.see(links.moment_x[k], plain.moment_x[k]);
            moments.see(links.moment_z[k], plain.moment_z[k]);
            moments.see(links.twist[k], plain.twist[k]);
            slip.see(links.slip[k], plain.slip[k]);
          }
        });
    slid_plain += now;
    sliding.see(slid, slid_plain);
    softened += dem::softening_links(law, links);
  }
  const std::size_t broken = dem::broken_links(law, links);
  for (std::size_t k = 0; k < links.count; ++k)
    if (law.is_broken(links.max_strain[k]) && (links.shear_x[k] != 0 || links.shear_y[k] != 0)) ++pushed;
  // The history has met every branch of the law.
  EXPECT_GT(softened, 1000u) << what;
  EXPECT_GT(broken, 30u) << what;
  EXPECT_LT(broken, links.count) << what;
  EXPECT_GT(pushed, 0u) << what;
  EXPECT_GT(slid_plain, 0) << what;
  for (std::size_t c = 0; c < 8; ++c) EXPECT_LT(row[c].relative(), 1e-12) << what << ", column " << c;
  EXPECT_LT(strain.relative(), 1e-12) << what;
  EXPECT_LT(shear.relative(), 1e-12) << what;
  EXPECT_LT(sliding.relative(), 1e-12) << what;
  if (!choices.moment_transfer) return;
  EXPECT_GT(moments.scale, 0) << what;
  EXPECT_GT(slip.scale, 0) << what;
  EXPECT_LT(moment_row.relative(), 1e-11) << what;
  EXPECT_LT(moments.relative(), 1e-11) << what;
  EXPECT_LT(slip.relative(), 1e-11) << what;
}

void compare_all(const dem::ContactLoops& loops, const std::string& set) {
  [&]<std::size_t... number>(std::index_sequence<number...>) { (compare<number>(loops, set), ...); }
  (std::make_index_sequence<dem::link_choices>());
}

}  // namespace

TEST(Lanes, AgreeWithPlainDoublesInEveryChoiceBaseline) {
  compare_all(dem::baseline_contact_loops(), "baseline");
}

#ifdef SPALL_X86
TEST(Lanes, AgreeWithPlainDoublesInEveryChoiceAvx2) {
  if (dem::instructions() < dem::Instructions::avx2) GTEST_SKIP() << "this machine has no AVX2";
  compare_all(dem::avx2_contact_loops(), "avx2");
}

TEST(Lanes, AgreeWithPlainDoublesInEveryChoiceAvx512) {
  if (dem::instructions() < dem::Instructions::avx512) GTEST_SKIP() << "this machine has no AVX-512";
  compare_all(dem::avx512_contact_loops(), "avx512");
}
#endif

/// Whole steps of small assemblies of one block; determinism_test and specimens have assemblies of several.
template <bool moments>
void compare_steps(const dem::BlockLoops& loops) {
  dem::LinkLaw law = moments ? scene::with_moments(plain_law()) : plain_law();
  law.tensile_strength = law.cohesion = 0.002 * law.normal_modulus;
  const dem::Assembly start = [&] {
    dem::Assembly made = scene::cluster(60, law, 13);
    scene::shake(made.particles, 40, 14);
    return made;
  }();
  const double dt = 0.3 * scene::critical_step_of(start);
  scene::Scene lanes(start, dt);
  lanes.room.loops = loops;
  dem::Assembly plain = lanes.assembly;
  double sliding = 0;
  for (int n = 0; n < 60;
       ++n) {  // before anything touches that was never linked: the reference finds no contacts
    lanes.step();
    sliding +=
        reference::step<dem::LinkChoices{.moment_transfer = moments}>(law, plain.particles, plain.links, dt);
  }
  EXPECT_GT(dem::broken_links(law, plain.links), 0u);
  EXPECT_GT(sliding, 0);
  EXPECT_NEAR(lanes.sliding, sliding, 1e-10 * sliding);
  for (std::size_t i = 0; i < plain.particles.count; ++i)
    EXPECT_LT((lanes.position(i) - plain.particles.kinematics[i].position()).norm(), 1e-12);
}

void compare_steps_of_both_laws(const dem::BlockLoops& loops) {
  compare_steps<false>(loops);
  compare_steps<true>(loops);
}

TEST(Lanes, StepsAgreeWithTheReferenceLoopBaseline) { compare_steps_of_both_laws(dem::baseline_block_loops()); }

#ifdef SPALL_X86
TEST(Lanes, StepsAgreeWithTheReferenceLoopAvx2) {
  if (dem::instructions() < dem::Instructions::avx2) GTEST_SKIP() << "this machine has no AVX2";
  compare_steps_of_both_laws(dem::avx2_block_loops());
}

TEST(Lanes, StepsAgreeWithTheReferenceLoopAvx512) {
  if (dem::instructions() < dem::Instructions::avx512) GTEST_SKIP() << "this machine has no AVX-512";
  compare_steps_of_both_laws(dem::avx512_block_loops());
}
#endif
