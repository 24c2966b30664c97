#include "calibrate/specimen_set.h"

#include <fmt/format.h>

#include "libdem/core/parallel.h"
#include "specimens/extract.h"
#include "specimens/specimen_file.h"

namespace calibrate {

using specimens::Specimen;

namespace {

std::vector<Specimen> pack_all(const specimens::PackingOptions& how, const std::vector<std::uint64_t>& seeds,
                               int threads) {
  std::vector<Specimen> made(seeds.size());
  dem::for_each_in_parallel(seeds.size(), threads, [&](std::size_t k) {
    specimens::PackingOptions packing = how;
    packing.seed = seeds[k];
    packing.threads = 1;
    made[k] = specimens::make_specimen(packing);
  });
  return made;
}

}  // namespace

SpecimenSet make_set(const CalibrationCase& wanted, const std::vector<std::uint64_t>& seeds,
                     const std::vector<dem::Vec3>& centres, int threads) {
  SpecimenSet set;
  if (wanted.structure.empty()) {
    for (const std::uint64_t seed : seeds) set.labels.push_back(fmt::format("seed {}", seed));
    set.specimens = pack_all(wanted.packing, seeds, threads);
  } else {
    const Specimen structure = specimens::read_specimen(wanted.structure);
    for (const dem::Vec3& c : centres)
      set.labels.push_back(fmt::format("cut at ({:.4g}, {:.4g}, {:.4g}) m", c.x(), c.y(), c.z()));
    set.specimens.resize(centres.size());
    dem::for_each_in_parallel(centres.size(), threads, [&](std::size_t k) {
      set.specimens[k] = specimens::extract(structure, wanted.packing.shape, centres[k], wanted.packing.size);
    });
  }
  for (const LaboratoryTest& test : wanted.laboratory)
    set.laboratory.push_back(test.packing ? pack_all(*test.packing, seeds, threads) : std::vector<Specimen>{});
  return set;
}

TestProtocol protocol_for(const CalibrationCase& wanted) {
  TestProtocol protocol;
  const auto value = [&](Quantity q) { return wanted.target(q) != nullptr ? wanted.target(q)->value : 0.0; };
  protocol.tension.loading = virtual_tests::Loading::tension;
  protocol.tension.ends = wanted.tension.ends;
  protocol.tension.rate = wanted.tension.rate;
  protocol.tension.damping = wanted.damping;
  protocol.tension.expected_strength = value(Quantity::tensile_strength);
  // Peaks need the test to pass the peak, energies and curves to follow it down.
  const bool follow =
      wanted.target(Quantity::fracture_energy) != nullptr || wanted.target(Quantity::tension_curve) != nullptr;
  protocol.tension.stop_at = follow ? 0.08 : 0.7;
  protocol.compression.loading = virtual_tests::Loading::compression;
  protocol.compression.ends = wanted.compression.ends;
  protocol.compression.platen_friction = wanted.compression.platen_friction;
  protocol.compression.rate = wanted.compression.rate;
  protocol.compression.damping = wanted.damping;
  protocol.compression.expected_strength = value(Quantity::compressive_strength);
  protocol.compression.stop_at = wanted.target(Quantity::compression_curve) != nullptr ? 0.6 : 0.85;
  return protocol;
}

}  // namespace calibrate
