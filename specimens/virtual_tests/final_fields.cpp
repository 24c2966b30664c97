#include "specimens/virtual_tests/final_fields.h"

#include "libdem/probe/damage.h"

namespace virtual_tests {
namespace {

LinkState state_of(const dem::LinkLaw& law, double max_strain) {
  if (law.is_broken(max_strain)) return LinkState::broken;
  return max_strain > law.yield_strain() ? LinkState::softening : LinkState::intact;
}

}  // namespace

FinalFields final_fields(const dem::Assembly& assembly) {
  const dem::Particles& particles = assembly.particles;
  const dem::Links& links = assembly.links;
  FinalFields fields;
  fields.damage = dem::element_damage(assembly.law, links, particles.count);
  for (std::size_t i = 0; i < particles.count; ++i) fields.displacement.push_back(particles.displacement(i));
  for (std::size_t k = 0; k < links.count; ++k) {
    const dem::Vec3 a = particles.kinematics[static_cast<std::size_t>(links.a[k])].position();
    const dem::Vec3 b = particles.kinematics[static_cast<std::size_t>(links.b[k])].position();
    fields.link_strain.push_back((b - a).norm() * links.inverse_initial_distance[k] - 1);
    fields.link_state.push_back(state_of(assembly.law, links.max_strain[k]));
  }
  return fields;
}

void read_pair_energies(dem::EnergyLedger& ledger, const dem::Assembly& assembly) {
  const dem::PairEnergy links = dem::pair_energy(assembly.law, assembly.particles, assembly.links);
  const dem::PairEnergy contacts = dem::pair_energy(assembly.law, assembly.particles, assembly.contacts);
  ledger.elastic = links.elastic + contacts.elastic;
  ledger.softening = links.softening;
}

}  // namespace virtual_tests
