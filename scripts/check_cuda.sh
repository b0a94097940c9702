#!/usr/bin/env bash
# Builds everything with the preset "cuda", lists what each kernel takes of a multiprocessor, and runs
# the tests if there is a GPU: Kokkos_ROOT=/path/to/kokkos scripts/check_cuda.sh
# Kokkos_ROOT: a Kokkos built with CUDA, OpenMP and the card's architecture. JOBS: compilers at once.
# ARCHITECTURES: what the table has a column for, one program for all of them; what Kokkos was built for comes with it.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

build=build/cuda
if [ ! -x "${Kokkos_ROOT:?set it to a Kokkos built with CUDA}/bin/nvcc_wrapper" ]; then
  echo "check_cuda: no bin/nvcc_wrapper in $Kokkos_ROOT: was that Kokkos built with CUDA?" >&2
  exit 1
fi
read -r -a architectures <<< "${ARCHITECTURES:-80 90 100}"
flags=-Xptxas=-v
for one in "${architectures[@]}"; do flags+=" -gencode=arch=compute_$one,code=sm_$one"; done
cmake --preset cuda -DCMAKE_CXX_FLAGS="$flags"
# The log grows: what is not compiled again keeps the lines of its last compilation.
set +e
cmake --build $build --parallel "${JOBS:-$(nproc)}" --target all tests -- -k 0 2>&1 | tee -a $build/ptxas.log |
  grep --line-buffered -E '^\[|error|warning:|FAILED'
status=${PIPESTATUS[0]}
set -e
[ "$status" -eq 0 ] || exit "$status"

echo
/usr/bin/env python3 scripts/ptxas_table.py $build/ptxas.log --expect "${architectures[@]/#/sm_}"

echo
if command -v nvidia-smi > /dev/null && nvidia-smi -L; then
  ctest --test-dir $build --output-on-failure --label-exclude nightly
else
  echo "check_cuda: no GPU here: all is compiled and linked, nothing was run"
fi
