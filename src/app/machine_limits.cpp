#include "src/app/machine_limits.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/statvfs.h>

#include <cstdint>
#include <cstdlib>

#include "src/base/errors.hpp"

namespace barchan {

namespace {

// Needs of Open MPI 4.1, found by trial: it shares memory through a file of 4 MiB in the folder for
// temporary files.
constexpr std::uint64_t kOpenFiles = 64, kFile = 4 << 20, kMemory = 300'000'000, kRoom = 10'000'000;

struct Limit {
  decltype(RLIMIT_NOFILE) kind;
  const char *words, *option, *unit;
  std::uint64_t least;
};
constexpr Limit kLimits[] = {{RLIMIT_NOFILE, "the number of open files", "-n", "", kOpenFiles},
                             {RLIMIT_FSIZE, "the size of a file", "-f", " bytes", kFile},
                             {RLIMIT_AS, "the memory of a process", "-v", " bytes", kMemory}};

const char* temporary_folder() {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): there are no other threads yet
  const char* const set = std::getenv("TMPDIR");
  return set != nullptr && *set != '\0' ? set : "/tmp";
}

}  // namespace

void check_machine_limits() {
  for (const auto& [kind, words, option, unit, least] : kLimits) {
    rlimit limit{};
    if (::getrlimit(kind, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) continue;
    if (limit.rlim_cur >= least) continue;
    throw InputError(fmt::format("{} is limited to {}{} here (ulimit {}); MPI needs {}{}", words,
                                 limit.rlim_cur, unit, option, least, unit));
  }
  struct statvfs room {};
  const char* const folder = temporary_folder();
  if (::statvfs(folder, &room) != 0) {
    throw InputError(fmt::format(
        "MPI needs a folder for temporary files, and there is no {}; set TMPDIR", folder));
  }
  const std::uint64_t free = room.f_bavail * room.f_frsize;
  if (free < kRoom) {
    throw InputError(fmt::format(
        "{} has {} bytes left, and MPI needs {} for temporary files; make room, or set TMPDIR",
        folder, free, kRoom));
  }
}

}  // namespace barchan
