// Benchmarks of the suite. A case is set up once for all that run on it.
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <utility>

#include "perf/records.hpp"

namespace barchan {

class RunningCase;

void register_bandwidth();
void register_cases();    // whole steps
void register_kernels();  // single kernels, inside the steps they belong to

/// Registers a benchmark; times are wall times, in milliseconds.
template <class Body>
benchmark::internal::Benchmark* add_benchmark(const std::string& name, Body&& body) {
  return benchmark::RegisterBenchmark(name.c_str(), std::forward<Body>(body))
      ->Unit(benchmark::kMillisecond);
}

/// Sizes and heap of a case, for its record.
CaseFacts describe(const RunningCase& c);
/// Contacts, pairs and columns of the solvers as they are now.
void count_contacts(benchmark::State& run, RunningCase& c);

}  // namespace barchan
