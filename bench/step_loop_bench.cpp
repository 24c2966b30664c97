// The step loop with everything that a test uses: law, ledger, contact detection, damping.
#include <benchmark/benchmark.h>

#include "libdem/drive/platens.h"
#include "libdem/run/step.h"
#include "specimens/packing.h"
#include "specimens/virtual_tests/setup.h"

namespace {

dem::Vec3 size_for(std::int64_t elements) {
  if (elements == 2700) return {0.5, 0.25, 0.25};
  if (elements == 18672) return {0.6, 0.6, 0.6};
  return {2.5, 2.0, 0.28};
}

/// Arguments: elements, threads. The counter is link updates a second.
void step_loop(benchmark::State& state) {
  specimens::PackingOptions packing;
  packing.elements = static_cast<std::size_t>(state.range(0));
  packing.size = size_for(state.range(0));
  const specimens::Specimen specimen = specimens::make_specimen(packing);
  dem::Assembly assembly = virtual_tests::make_assembly(specimen, dem::MaterialCard{});
  const int axis = specimen.long_axis();
  const dem::Platens platens =
      dem::find_platens(assembly.particles, axis, specimen.size[axis], specimen.element_size());
  dem::drive(assembly.particles, platens, dem::EndCondition::free, 0.02);
  dem::StepRoom room(assembly);
  const dem::StepOptions options{2e-6, {0.3, 2e-5, 2e-3}, static_cast<int>(state.range(1))};
  for (auto _ : state) benchmark::DoNotOptimize(dem::advance(assembly, room, options));
  state.counters["links/s"] = benchmark::Counter(static_cast<double>(assembly.links.count),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(step_loop)
    ->ArgsProduct({{2700, 18672, 120808}, {1, 2}})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

}  // namespace
