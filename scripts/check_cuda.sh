#!/usr/bin/env bash
# Builds everything with the preset "cuda", lists what each kernel takes of a multiprocessor, and runs
# the tests if there is a GPU: Kokkos_ROOT=/path/to/kokkos scripts/check_cuda.sh
# Kokkos_ROOT: a Kokkos built with CUDA, OpenMP and the card's architecture. JOBS: compilers at once.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/cuda
if [ ! -x "${Kokkos_ROOT:?set it to a Kokkos built with CUDA}/bin/nvcc_wrapper" ]; then
  echo "check_cuda: no bin/nvcc_wrapper in $Kokkos_ROOT: was that Kokkos built with CUDA?" >&2
  exit 1
fi
cmake --preset cuda -DCMAKE_CXX_FLAGS=-Xptxas=-v
# The log grows: what is not compiled again keeps the lines of its last compilation.
set +e
cmake --build $build --parallel "${JOBS:-$(nproc)}" --target all tests -- -k 0 2>&1 | tee -a $build/ptxas.log |
  grep --line-buffered -E '^\[|error|warning:|FAILED'
status=${PIPESTATUS[0]}
set -e
[ "$status" -eq 0 ] || exit "$status"

echo
echo "registers, stack [bytes], spills [bytes], kernel"
c++filt < $build/ptxas.log | awk '
  /Compiling entry function/ {
    name = $0
    known = sub(/.*Kokkos::Impl::(ParallelFor|ParallelReduce|ParallelScan)</, "", name) && name ~ /barchan::/
    sub(/, Kokkos::(RangePolicy|MDRangePolicy|TeamPolicy|Impl::FunctorAnalysis|HostSpace).*/, "", name)
    gsub(/barchan::|launch_detail::|\(anonymous namespace\)::|Kokkos::Impl::Combined[A-Za-z]*</, "", name)
    gsub(/Kokkos::/, "", name)
  }
  /bytes stack frame/ { stack = $1; spills = $5 + $9 }
  /Used [0-9]+ registers/ && known {
    match($0, /Used [0-9]+/)
    row[name] = sprintf("%4d %6d %6d  %s", substr($0, RSTART + 5, RLENGTH - 5), stack, spills, name)
    known = 0
  }
  END { for (name in row) if (name !~ /^Impl::/) print row[name] }' | sort -k 4

echo
if command -v nvidia-smi > /dev/null && nvidia-smi -L; then
  ctest --test-dir $build --output-on-failure --label-exclude nightly
else
  echo "check_cuda: no GPU here: all is compiled and linked, nothing was run"
fi
