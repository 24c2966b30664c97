// Packing and linking, the static solve, the critical time step, and one search for contacts.
#include <benchmark/benchmark.h>

#include "libdem/motion/critical_step.h"
#include "libdem/search/contact_detector.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/elastic.h"
#include "specimens/virtual_tests/setup.h"

namespace {

specimens::PackingOptions packing_of(std::int64_t elements) {
  specimens::PackingOptions options;
  options.elements = static_cast<std::size_t>(elements);
  options.size = elements == 2700 ? dem::Vec3(0.5, 0.25, 0.25) : dem::Vec3(0.6, 0.6, 0.6);
  return options;
}

void pack_and_link(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(specimens::make_specimen(packing_of(state.range(0))));
}
BENCHMARK(pack_and_link)->Arg(2700)->Arg(18672)->Unit(benchmark::kMillisecond)->UseRealTime();

void static_elastic_test(benchmark::State& state) {
  const specimens::Specimen specimen = specimens::make_specimen(packing_of(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(virtual_tests::run_elastic(specimen, dem::MaterialCard{}));
}
BENCHMARK(static_elastic_test)->Arg(2700)->Arg(18672)->Unit(benchmark::kMillisecond)->UseRealTime();

void critical_step(benchmark::State& state) {
  const specimens::Specimen specimen = specimens::make_specimen(packing_of(state.range(0)));
  const dem::Assembly assembly = virtual_tests::make_assembly(specimen, dem::MaterialCard{});
  const dem::LinkNetwork network(specimen.centres, specimen.radii, specimen.links, assembly.law.normal_modulus,
                                 assembly.law.shear_ratio);
  for (auto _ : state) benchmark::DoNotOptimize(dem::critical_time_step(network, assembly.particles));
}
BENCHMARK(critical_step)->Arg(2700)->Arg(18672)->Unit(benchmark::kMillisecond);

void contact_search(benchmark::State& state) {
  const specimens::Specimen specimen = specimens::make_specimen(packing_of(state.range(0)));
  const dem::Assembly assembly = virtual_tests::make_assembly(specimen, dem::MaterialCard{});
  for (auto _ : state) {
    dem::ContactDetector detector(assembly.particles, assembly.links);
    dem::Links contacts;
    benchmark::DoNotOptimize(detector.update(assembly.particles, contacts, 0, 0));
  }
}
BENCHMARK(contact_search)->Arg(2700)->Arg(18672)->Unit(benchmark::kMillisecond);

}  // namespace
