// Starts the build of a program that is made for this processor. A package holds `barchan` (this
// one) and beside it one `barchan.LEVEL` for each level of instruction sets (CMakeLists.txt,
// BARCHAN_LEVELS).
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace {

struct Level {
  const char* name;
  bool supported;
};

/// Best first: AVX-512, AVX2 with fused multiply-add, any.
std::array<Level, 3> levels() {
  __builtin_cpu_init();
  return {Level{"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0},
          Level{"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0}, Level{"x86-64", true}};
}

constexpr const char* kAskedFor = "BARCHAN_CPU";

}  // namespace

int main(int, char** argv) {
  const char* const wanted = std::getenv(kAskedFor);
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  for (const Level& level : levels()) {
    const std::string program = self.string() + "." + level.name;
    const bool chosen = wanted != nullptr ? std::strcmp(wanted, level.name) == 0
                                          : std::filesystem::exists(program, error);
    if (!chosen || !level.supported) continue;
    execv(program.c_str(), argv);
    std::fprintf(stderr, "error: cannot start %s: %s\n", program.c_str(), std::strerror(errno));
    return 1;
  }
  if (wanted == nullptr) {
    std::fprintf(stderr, "error: there is no build for this processor beside %s\n", self.c_str());
    return 1;
  }
  std::fprintf(
      stderr,
      "error: the environment variable %s = \"%s\" must be a level that this processor has:",
      kAskedFor, wanted);
  for (const Level& level : levels())
    if (level.supported) std::fprintf(stderr, " %s", level.name);
  std::fprintf(stderr, "; or unset it\n");
  return 2;
}
