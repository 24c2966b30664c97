// The step loop with everything that a test uses: law, ledger, contact detection, damping.
#include <benchmark/benchmark.h>

#include "bench/scenes.h"

namespace {

const bench::Size& size_of(std::int64_t elements) {
  return elements == 2700 ? bench::small : elements == 18672 ? bench::medium : bench::large;
}

/// Arguments: elements, threads. The counter is link updates a second.
void step_loop(benchmark::State& state) {
  bench::Run run(bench::pressed(bench::specimen_of(size_of(state.range(0))).specimen),
                 bench::pressing(static_cast<int>(state.range(1))));
  run.steps(3);  // the first one lists contacts and touches memory for the first time
  for (auto _ : state) benchmark::DoNotOptimize(dem::advance(run.assembly, run.room, run.options));
  state.counters["links/s"] = benchmark::Counter(static_cast<double>(run.assembly.links.count),
                                                 benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(step_loop)
    ->ArgsProduct({{2700, 18672, 120808}, {1, 2}})
    ->Unit(benchmark::kMicrosecond)
    ->UseRealTime();

/// The detector in an impact's middle: what it costs a step.
void contacts_of_an_impact(benchmark::State& state) {
  const specimens::Specimen& specimen = bench::specimen_of(bench::medium).specimen;
  bench::Run run = bench::impact_on(specimen);
  run.steps(300);
  dem::ContactDetector detector(run.assembly.particles, run.assembly.links);
  dem::Links contacts;
  for (auto _ : state) {
    state.PauseTiming();
    run.steps(1);
    state.ResumeTiming();
    benchmark::DoNotOptimize(
        detector.update(run.assembly.particles, contacts, run.room.max_speed, run.options.time_step));
  }
}
BENCHMARK(contacts_of_an_impact)->Iterations(200)->Unit(benchmark::kMicrosecond);

}  // namespace
