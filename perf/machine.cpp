// Machine and program with which a record was made.
#include <fmt/chrono.h>

#include <Kokkos_Core.hpp>
#include <ctime>
#include <fstream>
#include <string>

#include "barchan_version.hpp"
#include "perf/options.hpp"
#include "perf/records.hpp"
#include "src/parallel/communicator.hpp"
#include "src/parallel/launch.hpp"

namespace barchan {

namespace {

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "unknown CPU";
}

std::string device_of_backend() {
#ifdef KOKKOS_ENABLE_CUDA
  return Kokkos::Cuda().cuda_device_prop().name;
#else
  return cpu_name();
#endif
}

std::string utc_now() {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

std::string compiler() {
#ifdef __clang__
  return "clang " __VERSION__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace

nlohmann::json describe_machine() {
  return {
      {"date", utc_now()},
      {"version", BARCHAN_VERSION},
      {"git_hash", BARCHAN_GIT_HASH},
      {"backend", Kokkos::DefaultExecutionSpace::name()},
      {"device", device_of_backend()},
      {"cpu", cpu_name()},
      {"threads", Kokkos::DefaultHostExecutionSpace().concurrency()},
      {"ranks", rank_count(MPI_COMM_WORLD)},
      {"compiler", compiler()},
      {"build", BARCHAN_BUILD},
      {"build_type", BARCHAN_BUILD_TYPE},
      {"kokkos", KOKKOS_VERSION},
      {"tiny", options().tiny},
  };
}

}  // namespace barchan
