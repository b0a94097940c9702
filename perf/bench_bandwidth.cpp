// The triad as a benchmark: its record says what the fractions of the others refer to.
#include "perf/bandwidth.hpp"
#include "perf/bench.hpp"

namespace barchan {

void register_bandwidth() {
  add_benchmark("kernel/triad", [](benchmark::State& run) {
    const Triad triad;
    for (auto _ : run) {
      triad.run();
      Kokkos::fence("end of a triad");
    }
    facts() = {};
    facts().units = {{"elements", triad.elements()}};
    facts().per_step = {triad.bytes(), 2 * triad.elements()};
    facts().sizes["elements"] = triad.elements();
  })->UseRealTime();
}

}  // namespace barchan
