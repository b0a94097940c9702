// Records of benchmarks: one JSON line each about program, machine, speed and counts.
#pragma once

#include <benchmark/benchmark.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "perf/computed_work.hpp"

namespace barchan {

/// Facts about a benchmark, over all repetitions; a step is one iteration.
struct CaseFacts {
  nlohmann::json sizes = nlohmann::json::object();    // grains, cells, ...
  nlohmann::json notes = nlohmann::json::object();    // heap, labels of allocations, ...
  std::vector<std::pair<std::string, double>> units;  // "grain-steps": per step; the first counts
  std::string problem;                                // reason why it gave up; empty: it did not
  Work per_step;                                      // computed work of a step
};

/// Facts of the benchmark that runs, taken by the reporter when its repetitions are done.
CaseFacts& facts();

/// Prints a line for each benchmark and adds its record to options().records.
class RecordReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  bool failed() const { return failed_; }

 private:
  nlohmann::json machine_;
  bool failed_ = false;
};

/// Version, backend, device, threads, compiler, date ... of a record.
nlohmann::json describe_machine();

}  // namespace barchan
