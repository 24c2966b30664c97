#include "bench/scenes.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <string>

#include "bench/turns.h"
#include "libdem/drive/platens.h"
#include "libdem/motion/critical_step.h"
#include "libdem/statics/link_network.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/setup.h"

namespace bench {
namespace {

/// A line of /proc/self/status in bytes; 0 where the system has no such file.
double status(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key + ":")) return 1024 * std::stod(line.substr(key.size() + 1));
  return 0;
}

}  // namespace

void reset_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }
double peak_memory() { return status("VmHWM"); }
double resident_memory() { return status("VmRSS"); }

const Made& specimen_of(const Size& size) {
  static std::map<std::size_t, Made> made;
  const auto [at, missing] = made.try_emplace(size.elements);
  if (missing) {
    specimens::PackingOptions options;
    options.elements = size.elements, options.size = size.sides, options.threads = 2;
    reset_peak_memory();
    at->second.seconds = seconds_of([&] { at->second.specimen = specimens::make_specimen(options); });
    at->second.peak_bytes = peak_memory();
  }
  return at->second;
}

dem::Assembly pressed(const specimens::Specimen& specimen) {
  dem::Assembly assembly = virtual_tests::make_assembly(specimen, dem::MaterialCard{});
  const int axis = specimen.long_axis();
  const dem::Platens platens =
      dem::find_platens(assembly.particles, axis, specimen.size[axis], specimen.element_size());
  dem::drive(assembly.particles, platens, dem::EndCondition::free, 0.02);
  return assembly;
}

dem::StepOptions pressing(int threads) { return {2e-6, {0.3, 2e-5, 2e-3}, threads}; }

Run impact_on(const specimens::Specimen& specimen) {
  dem::Assembly assembly = virtual_tests::make_assembly(specimen, dem::MaterialCard{});
  const double element = specimen.element_size();
  const int thin =
      static_cast<int>(std::min_element(specimen.size.begin(), specimen.size.end()) - specimen.size.begin());
  dem::Vec3 target = 0.5 * specimen.size;
  target[thin] = specimen.size[thin];
  dem::Vec3 inward = dem::Vec3::Zero();
  inward[thin] = -impact_speed;
  for (std::size_t i = 0; i < specimen.elements(); ++i) {
    const dem::Vec3& x = specimen.centres[i];
    bool at_side = false;
    for (int axis = 0; axis < 3; ++axis)
      at_side = at_side || (axis != thin && std::min(x[axis], specimen.size[axis] - x[axis]) < 2 * element);
    if (at_side)
      for (int dof = 0; dof < 6; ++dof) assembly.particles.prescribe(i, dof, 0);
    else if ((x - target).norm() < 4 * element)
      for (int dof = 0; dof < 6; ++dof) assembly.particles.prescribe(i, dof, dof < 3 ? inward[dof] : 0);
  }
  const dem::LinkNetwork network(specimen.centres, specimen.radii, specimen.links, assembly.law.normal_modulus,
                                 assembly.law.shear_ratio);
  const double time_step = 0.3 * dem::critical_time_step(network, assembly.particles);
  return {std::move(assembly), {time_step, {}, 1}};
}

}  // namespace bench
