#!/usr/bin/env bash
# Builds and runs one fuzzer from the inputs kept in the repository:
#   tests/fuzz/run.sh [TARGET] [SECONDS] [LIBFUZZER OPTIONS]   e.g. tests/fuzz/run.sh config 1800
# What it finds goes to build/fuzz/found/TARGET: crash-*, oom-*, timeout-* are bugs, corpus/ is what reached
# new places. Needs clang with its run-time library (Debian: clang libclang-rt-dev; Kokkos asks for libomp-dev).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

here=tests/fuzz
target="${1:-config}"
seconds="${2:-60}"
shift $(($# < 2 ? $# : 2))
if [ ! -e "$here/${target}_fuzzer.cpp" ]; then
  echo "no target '$target'; there are: $(cd "$here" && printf '%s\n' *_fuzzer.cpp | sed 's/_fuzzer.cpp//' | paste -sd ' ')" >&2
  exit 2
fi

if [ ! -e build/fuzz/build.ninja ]; then
  cmake --preset fuzz -DCMAKE_C_COMPILER="${CC:-clang}" -DCMAKE_CXX_COMPILER="${CXX:-clang++}"
fi
cmake --build build/fuzz --target "${target}_fuzzer"

found="build/fuzz/found/$target"
mkdir -p "$found/corpus"
options=(-fork=1 -ignore_crashes=1 -ignore_ooms=1 -ignore_timeouts=1 -max_total_time="$seconds" -timeout=5
  -rss_limit_mb=1024 -malloc_limit_mb=64 -len_control=10 -artifact_prefix="$found/")
if [ -e "$here/$target.dict" ]; then options+=(-dict="$here/$target.dict"); fi
case $target in
  hdf5) options+=(-max_len=16384) ;;
  hdf5_structure) options+=(-max_len=256) ;;
  *) options+=(-max_len=8192) ;;
esac
# The HDF5 library is not ours, and leaks when it gives up on a damaged file.
leaks=1
[[ $target != hdf5* ]] || leaks=0
export ASAN_OPTIONS="detect_leaks=$leaks:allocator_may_return_null=1:${ASAN_OPTIONS:-}"
exec "build/fuzz/$here/${target}_fuzzer" "${options[@]}" "$@" "$found/corpus" "$here/corpus/$target"
