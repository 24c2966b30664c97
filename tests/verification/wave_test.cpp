// Waves: a regular chain against its dispersion relation, a slender bar of disordered elements against
// sqrt(E/rho).
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "libdem/motion/critical_step.h"
#include "specimens/interaction_range.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/setup.h"
#include "tests/verification/scene.h"

using dem::Vec3;

TEST(Chain, VibratesAtTheFrequencyOfItsDispersionRelation) {
  constexpr int count = 40;
  const dem::LinkLaw law = scene::elastic_law();
  for (const int mode : {1, 4, 13, 27, 39}) {  // up to wavelengths of two elements
    dem::Assembly made = scene::chain(count, law);
    const double stiffness = law.normal_modulus * made.links.area[0] * made.links.inverse_initial_distance[0];
    const double mass = made.particles.element_mass(0), kd = mode * std::numbers::pi / count;
    const double omega = 2 * std::sqrt(stiffness / mass) * std::sin(kd / 2);
    const double dt = 0.3 * 2 / (2 * std::sqrt(stiffness / mass));
    // Central differences see the time as the chain sees the space: sin(w dt/2) = omega dt/2.
    const double turn = 2 * std::asin(omega * dt / 2), speed = 1e-2;
    std::vector<double> shape(count);
    for (int j = 0; j < count; ++j) {
      shape[static_cast<std::size_t>(j)] = std::cos(kd * (j + 0.5));
      made.particles.set_velocity(static_cast<std::size_t>(j),
                                  Vec3(speed * shape[static_cast<std::size_t>(j)], 0, 0));
    }
    scene::Scene scene(std::move(made), dt);
    const double amplitude = speed * dt / std::sin(turn);
    for (int n = 1; n <= 2000; ++n) {
      scene.step();
      for (const std::size_t j : {0u, 7u, 26u})
        ASSERT_NEAR(scene.particles().displacement(j).x(), amplitude * std::sin(n * turn) * shape[j],
                    1e-6 * amplitude)
            << "mode " << mode << ", step " << n;
    }
  }
}

TEST(Chain, CarriesALongPulseAtTheSpeedOfTheContinuum) {
  constexpr int count = 600;
  const dem::LinkLaw law = scene::elastic_law();
  dem::Assembly made = scene::chain(count, law);
  const double stiffness = law.normal_modulus * made.links.area[0] * made.links.inverse_initial_distance[0];
  const double mass = made.particles.element_mass(0), spacing = 0.02;
  const double speed = spacing * std::sqrt(stiffness / mass), dt = 0.5 * std::sqrt(mass / stiffness);
  const auto pulse = [](double j) { return 1e-3 * std::exp(-j * j / (2 * 15.0 * 15.0)); };  // velocity [m/s]
  // Velocity without displacement: two bells run apart, each half as high.
  for (int j = 0; j < count; ++j)
    made.particles.set_velocity(static_cast<std::size_t>(j), Vec3(pulse(j - count / 2), 0, 0));
  scene::Scene scene(std::move(made), dt);
  const int travelled = 200;  // elements
  const double time = travelled * spacing / speed;
  const int count_of_steps = static_cast<int>(std::lround(time / dt));
  scene.steps(count_of_steps);
  double weight = 0, place = 0, highest = 0;
  for (int j = count / 2; j < count; ++j) {
    const double v = scene.particles().kinematics[static_cast<std::size_t>(j)].vx;
    weight += v, place += v * (j - count / 2), highest = std::max(highest, v);
  }
  EXPECT_NEAR(place / weight, travelled, 0.005 * travelled);
  EXPECT_NEAR(highest, 0.5e-3, 0.02e-3);
}

TEST(Bar, CarriesAPulseAtTheSpeedOfItsOwnStaticModulus) {
  specimens::PackingOptions packing;  // 9 elements across, 90 along
  packing.size = Vec3(2.0, 0.2, 0.2);
  packing.elements = 7290;
  packing.threads = 1;
  specimens::Specimen bar = specimens::pack(packing);
  specimens::link(bar, 1);
  dem::MaterialCard card;
  card.tensile_strength = card.cohesion = 1e15;
  const double modulus = virtual_tests::run_elastic(bar, card).young_modulus;
  const double speed = std::sqrt(modulus / card.density);

  dem::Assembly made = virtual_tests::make_assembly(bar, card);
  const double length = bar.size.x(), width = 0.15;  // [m]: seven times an element, so that it hardly disperses
  for (std::size_t i = 0; i < made.particles.count; ++i) {
    const double x = made.particles.initial_position[i].x();
    made.particles.set_velocity(i, Vec3(1e-3 * std::exp(-x * x / (2 * width * width)), 0, 0));
  }
  const double dt = 0.7 * scene::critical_step_of(made);
  scene::Scene scene(std::move(made), dt);
  // Half a bell of velocity at the free end is its own mirror image: a whole bell, half as high, runs to the
  // other end. Slices of two elements' thickness see it pass.
  const double size = bar.element_size();
  struct Station {
    double at = 0;
    std::vector<std::size_t> members;
  };
  std::vector<Station> stations(2);
  stations[0].at = 0.25 * length, stations[1].at = 0.7 * length;
  for (Station& station : stations)
    for (std::size_t i = 0; i < scene.particles().count; ++i)
      if (std::abs(scene.particles().initial_position[i].x() - station.at) < size) station.members.push_back(i);
  const int steps = static_cast<int>(1.15 * length / speed / dt);
  std::vector<std::vector<double>> history(2);
  for (int n = 0; n < steps; ++n) {
    scene.step();
    for (std::size_t s = 0; s < 2; ++s) {
      double momentum = 0, mass = 0;
      for (const std::size_t i : stations[s].members) {
        momentum += scene.particles().element_mass(i) * scene.particles().kinematics[i].vx;
        mass += scene.particles().element_mass(i);
      }
      history[s].push_back(momentum / mass);
    }
  }
  double passed[2];
  for (std::size_t s = 0; s < 2; ++s) {  // the mean time of the crest, its upper half
    const std::vector<double>& v = history[s];
    const auto top = static_cast<std::size_t>(std::max_element(v.begin(), v.end()) - v.begin());
    ASSERT_GT(top, 5u);
    ASSERT_LT(top + 5, v.size());
    double weight = 0, moment = 0;
    for (std::size_t k = 0; k < v.size(); ++k)
      if (v[k] > 0.5 * v[top])
        weight += v[k] - 0.5 * v[top], moment += (v[k] - 0.5 * v[top]) * static_cast<double>(k);
    passed[s] = moment / weight * dt;
    EXPECT_GT(v[top], 0.45e-3) << "it arrives whole";
  }
  const double measured = (stations[1].at - stations[0].at) / (passed[1] - passed[0]);
  RecordProperty("speed_over_static", std::to_string(measured / speed));
  EXPECT_NEAR(measured, speed, 0.03 * speed);
}
