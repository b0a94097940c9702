#!/usr/bin/env bash
# Two ranks write one result file and one restart file together.
set -euo pipefail
tests="$(dirname "$BARCHAN_PROGRAM")/unit_tests"
[ -x "$tests" ] || { echo "no $tests"; exit 77; }
command -v mpirun > /dev/null || { echo "no mpirun"; exit 77; }
options=(--oversubscribe)
[ "$(id -u)" -ne 0 ] || options+=(--allow-run-as-root)
export OMP_NUM_THREADS="${BARCHAN_TEST_THREADS:-1}" OMP_PROC_BIND=false
mpirun "${options[@]}" -n 2 "$tests" --gtest_filter='ParallelFiles.*' --gtest_brief=1
