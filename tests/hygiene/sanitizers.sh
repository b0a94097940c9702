#!/usr/bin/env bash
# The test suite under the sanitizers: tests/hygiene/sanitizers.sh address|thread|rehearsal [CTEST ARGUMENT...]
#
#   address   preset debug: addresses, leaks, undefined behaviour, subscripts of Kokkos views and std containers
#   thread    preset thread: data races, with two threads a process
#   rehearsal preset rehearsal: arrays of the device that the host touches, as if there were one
#
# First programs with deliberate mistakes, which must be found, and one without, which must not be; then all that
# ./barchan test runs but the scripts below. Exit status 0: all tests passed and nothing was reported. The
# reports are in build/PRESET/reports, whatever the tests themselves make of them. KEEP_GOING=1 goes on after
# the first report of a process (thread only).
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
here="$root/tests/hygiene"
# Left out: scripts that run Python alone, or look at sources.
without='script\.(browser|horn_figures|layers|no_shell|paper_figures|plot|release|report|report_controls|site)$'

usage() { sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2; }

kind="${1:-}"
[ $# -eq 0 ] || shift
case $kind in
  address) preset=debug ;;
  thread) preset=thread ;;
  rehearsal) preset=rehearsal ;;
  *) usage ;;
esac
export BARCHAN_PRESET="$preset"  # for tests that call the launcher
"$root/barchan" build tests
build="$root/build/$preset"
reports="$build/reports"
rm -rf "$reports"
mkdir -p "$reports"

# Reports go to files of their own: a test may expect a process to fail, or swallow what it says.
halt=1
[ -z "${KEEP_GOING:-}" ] || halt=0
common="log_path=$reports/report:exitcode=86"
options() {  # options HALT: the address and undefined-behaviour sanitizers always halt, they are compiled so
  export ASAN_OPTIONS="$common:halt_on_error=1:detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1:detect_leaks=1:handle_abort=1"
  export LSAN_OPTIONS="suppressions=$here/leaks.supp:print_suppressions=0"
  export UBSAN_OPTIONS="$common:halt_on_error=1:print_stacktrace=1"
  export TSAN_OPTIONS="$common:halt_on_error=$1:second_deadlock_stack=1:history_size=4:suppressions=$here/races.supp"
}
options "$halt"
# Waiting threads and ranks leave the cores to others, which a sanitizer makes slow enough.
export OMP_NUM_THREADS=2 OMP_PROC_BIND=false GOMP_SPINCOUNT=0 OMPI_MCA_mpi_yield_when_idle=1
if [ "$kind" = thread ]; then export BARCHAN_TEST_THREADS=2; fi

launch=()
if [ "$kind" = thread ]; then
  # Its shadow memory has fixed places, which a kernel that scatters addresses further takes from it.
  if [ "$(cat /proc/sys/vm/mmap_rnd_bits 2> /dev/null || echo 32)" -gt 28 ]; then launch=(setarch --addr-no-randomize); fi
  # Only this entry of OpenMP is made known to it (tests/support/tsan_openmp.cpp).
  others="$(nm -D --undefined-only "$build"/*_tests "$build/barchan" | { grep -o 'GOMP_[a-z_]*' || true; } | sort -u | paste -sd ' ')"
  [ -z "$others" ] || { echo "tests/support/tsan_openmp.cpp does not know $others"; exit 1; }
fi

# --- does it find what is there? ---------------------------------------------------------------------

probe() {  # probe WORDS MODE: reported with these words; none for "must not be reported"
  local status=0
  rm -f "$reports"/*
  "${launch[@]}" "$build/sanitizer_probe" "$2" > "$build/probe.out" 2>&1 || status=$?
  cat "$reports"/report* >> "$build/probe.out" 2> /dev/null || true
  if [ -n "$1" ]; then
    [ "$status" -ne 0 ] && grep -q "$1" "$build/probe.out" && return
    echo "sanitizer_probe $2: '$1' is not reported (exit status $status)"
  else
    [ "$status" -eq 0 ] && ! ls "$reports"/report* > /dev/null 2>&1 && return
    echo "sanitizer_probe $2 is reported (exit status $status)"
  fi
  head -n 30 "$build/probe.out"
  exit 1
}
case $kind in
  address)
    probe "" ordered_loops
    probe heap-buffer-overflow past_the_end
    probe "out of bounds access" past_the_row
    probe "Assertion '__n < this->size()' failed" past_the_vector
    probe stack-use-after-return after_return
    probe "signed integer overflow" overflow
    probe "outside the range of representable values" not_an_int
    probe "LeakSanitizer: detected memory leaks" leak
    ;;
  thread)
    probe "" ordered_loops
    for mode in for reduce scan; do probe "data race .*in operator()" "race_in_$mode"; done
    probe "data race .*in operator()" race_of_neighbours
    probe "data race .*in race_with_a_thread" race_with_a_thread
    ;;
  rehearsal)
    for mode in with_copies memory_again; do probe "" $mode; done
    for mode in read write read_a_part read_before_any_kernel view_of_a_mirror copy_by_hand sort_by_hand send; do
      probe "use-after-poison" $mode
    done
    ;;
esac
rm -f "$reports"/*
echo "sanitizers.sh: the $kind sanitizer finds what it should"

# --- the suite ---------------------------------------------------------------------------------------

selection=(-LE nightly -E "$without")
for argument in "$@"; do
  case $argument in -L* | --label* | -R* | -E* | --tests-regex* | --exclude-regex*) selection=(-LE nightly) ;; esac
done
export OMPI_MCA_rmaps_base_oversubscribe=1
if [ "$(id -u)" -eq 0 ]; then export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; fi
status=0
"${launch[@]}" ctest --test-dir "$build" --output-on-failure --timeout 7200 "${selection[@]}" "$@" || status=$?

count() { find "$reports" -type f -exec cat {} + | grep -cE 'ERROR: |WARNING: ThreadSanitizer|runtime error:' || true; }
n_reports="$(count)"
echo "sanitizers.sh: $n_reports reports of the $kind sanitizer in $reports; ctest ended with $status"
if [ "$n_reports" -gt 0 ]; then
  find "$reports" -type f -exec grep -hE 'SUMMARY|runtime error:' {} + | sort | uniq -c | sort -rn | cut -c 1-200
  exit 1
fi
exit "$status"
