#include "perf/records.hpp"

#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>

#include "perf/bandwidth.hpp"
#include "perf/options.hpp"

namespace barchan {

namespace {

using nlohmann::json;
using Run = benchmark::BenchmarkReporter::Run;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

void add_times(json& record, const std::vector<double>& seconds, std::int64_t steps) {
  record["repeats"] = seconds.size();
  record["steps"] = steps;
  record["seconds_per_step"] = {
      {"median", median(seconds)},
      {"min", *std::min_element(seconds.begin(), seconds.end())},
      {"max", *std::max_element(seconds.begin(), seconds.end())},
  };
}

/// Adds rates at the median time, computed work, and its share of the triad's bandwidth.
void add_rates(json& record, const CaseFacts& facts) {
  const double seconds = record["seconds_per_step"]["median"];
  for (const auto& [unit, per_step] : facts.units) {
    record["rates"][unit + "/s"] = per_step / seconds;
  }
  if (facts.units.empty()) return;
  const auto& [unit, per_step] = facts.units.front();
  record["unit"] = unit;
  record["bytes_per_unit"] = facts.per_step.bytes / per_step;
  record["flops_per_unit"] = facts.per_step.flops / per_step;
  record["flops_per_second"] = facts.per_step.flops / seconds;
  record["bytes_per_second"] = facts.per_step.bytes / seconds;
  record["bandwidth"] = measured_bandwidth();
  record["bandwidth_fraction"] = facts.per_step.bytes / seconds / measured_bandwidth();
}

void add_counts(json& record, const std::vector<const Run*>& runs) {
  std::map<std::string, std::vector<double>> counts;
  for (const Run* run : runs) {
    for (const auto& [name, counter] : run->counters) counts[name].push_back(counter.value);
  }
  record["counts"] = json::object();
  for (const auto& [name, values] : counts) record["counts"][name] = mean(values);
}

/// Peak memory of this program so far: that of a single case only where one case was run.
double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : -1;
}

void print_line(const json& record) {
  const auto& time = record["seconds_per_step"];
  std::printf("%-28s %10.4g ms (%.4g .. %.4g)", record["case"].get<std::string>().c_str(),
              1e3 * time["median"].get<double>(), 1e3 * time["min"].get<double>(),
              1e3 * time["max"].get<double>());
  if (record.contains("rates")) {
    for (const auto& [unit, rate] : record["rates"].items()) {
      std::printf("  %.3g %s", rate.get<double>(), unit.c_str());
    }
    std::printf("  %.0f %% of the bandwidth", 100 * record["bandwidth_fraction"].get<double>());
  }
  for (const auto& [name, value] : record["counts"].items()) {
    std::printf("  %s %.4g", name.c_str(), value.get<double>());
  }
  std::printf("\n");
  static_cast<void>(std::fflush(stdout));  // for whoever watches; the records are in a file
}

}  // namespace

CaseFacts& facts() {
  static CaseFacts the_facts;
  return the_facts;
}

bool RecordReporter::ReportContext(const Context&) {
  machine_ = describe_machine();
  std::printf("%s, %s, %d threads, %s build, %s; triad %.3g GB/s\n",
              machine_["backend"].get<std::string>().c_str(),
              machine_["device"].get<std::string>().c_str(), machine_["threads"].get<int>(),
              machine_["build"].get<std::string>().c_str(),
              machine_["git_hash"].get<std::string>().c_str(), measured_bandwidth() / 1e9);
  std::printf("time of a step: median (min .. max) of the repeats\n");
  static_cast<void>(std::fflush(stdout));  // for whoever watches; the records are in a file
  return true;
}

void RecordReporter::ReportRuns(const std::vector<Run>& runs) {
  if (!facts().problem.empty()) {
    fmt::print(stderr, "{}: {}\n", runs.front().run_name.function_name, facts().problem);
    facts().problem.clear();
    failed_ = true;
    return;
  }
  std::vector<const Run*> good;
  for (const Run& run : runs) {
    if (run.run_type == Run::RT_Iteration) good.push_back(&run);
  }
  if (good.empty()) return;  // aggregates of the runs before
  std::vector<double> seconds;
  std::int64_t steps = 0;
  for (const Run* run : good) {
    seconds.push_back(run->real_accumulated_time / static_cast<double>(run->iterations));
    steps += run->iterations;
  }
  json record = machine_;
  record["case"] = good.front()->run_name.function_name;
  record["sizes"] = facts().sizes;
  record["notes"] = facts().notes;
  record["load"] = load_average();
  record["peak_memory_bytes"] = peak_memory();
  add_times(record, seconds, steps);
  add_rates(record, facts());
  add_counts(record, good);
  print_line(record);
  if (options().records.empty()) return;
  std::ofstream file(options().records, std::ios::app);
  file << record.dump() << '\n' << std::flush;
  if (!file) {
    fmt::print(stderr, "cannot add to {}\n", options().records.string());
    failed_ = true;
  }
}

}  // namespace barchan
