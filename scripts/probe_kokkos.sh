#!/usr/bin/env bash
# Succeeds when the Kokkos that CMake finds builds and runs a small parallel program (CUDA: builds).
# The rule for where to look is the project's own (cmake/kokkos.cmake). Prints "Kokkos VERSION (BACKEND)".
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
scratch="$(mktemp -d)"
trap 'rm -rf "$scratch"' EXIT
cat > "$scratch/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.25)
project(probe CXX)
set(CMAKE_CXX_STANDARD 20)
include("${BARCHAN_ROOT}/cmake/kokkos.cmake")
add_executable(probe probe.cpp)
target_link_libraries(probe Kokkos::kokkos)
CMAKE
cat > "$scratch/probe.cpp" <<'CPP'
#include <Kokkos_Core.hpp>
#include <cstdio>
int main(int argc, char** argv) {
  Kokkos::ScopeGuard guard(argc, argv);
  Kokkos::View<double*> view;  // there are pairs of a Kokkos and a compiler where this ends the program
  view = Kokkos::View<double*>("view", 1);
  long sum = 0;
  Kokkos::parallel_reduce(
      1000, KOKKOS_LAMBDA(int i, long& partial) { partial += i; }, sum);
  std::printf("Kokkos %d.%d.%d (%s)\n", KOKKOS_VERSION / 10000, KOKKOS_VERSION / 100 % 100,
              KOKKOS_VERSION % 100, Kokkos::DefaultExecutionSpace::name());
  return sum == 499500 ? 0 : 1;
}
CPP
options=(-G Ninja "-DBARCHAN_ROOT=$root")
cuda=no
if [ -n "${Kokkos_ROOT:-}" ] && grep -qsE 'set\(Kokkos_DEVICES .*CUDA' "$Kokkos_ROOT"/lib*/cmake/Kokkos/KokkosConfigCommon.cmake; then
  cuda=yes
  options+=("-DCMAKE_CXX_COMPILER=$Kokkos_ROOT/bin/nvcc_wrapper")
fi
if ! { cmake -S "$scratch" -B "$scratch/build" "${options[@]}" &&
  cmake --build "$scratch/build"; } > "$scratch/log" 2>&1; then
  cat "$scratch/log" >&2
  exit 1
fi
if [ "$cuda" = yes ]; then  # where a program is built there need not be a GPU
  echo "Kokkos with CUDA in $Kokkos_ROOT"
  exit 0
fi
OMP_PROC_BIND=false "$scratch/build/probe"
