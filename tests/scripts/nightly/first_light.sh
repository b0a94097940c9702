#!/usr/bin/env bash
# scripts/first_light.sh end to end on a tiny case: the CPU stands in for a card, cut by its limit and continued; then a
# made-up card with a failing test, a result that differs in one bit and a missing tool, mended one by one.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../../support/script.sh"
real="$(dirname "$BARCHAN_PROGRAM")"
for program in unit_tests barchan_bench; do
  [ -x "$real/$program" ] || { echo "no $real/$program"; exit 77; }
done
export OMP_NUM_THREADS=2 OMP_PROC_BIND=false OMP_WAIT_POLICY=passive REAL="$real" STATE="$dir"

# Programs that pass on what they are asked; of the benchmarks only two are there, and one made-up suite of tests can be
# slow, one can fail.
build="$dir/build" tools="$dir/bin"
mkdir "$build" "$tools"
cat > "$build/barchan" << 'PROGRAM'
#!/usr/bin/env bash
# Says that it ran on a card if there is a made-up one; a run "again" differs in one bit if it is to.
status=0
"$REAL/barchan" "$@" || status=$?
out="" words=("$@")
for n in "${!words[@]}"; do [ "${words[n]}" != --out ] || out="${words[n + 1]}"; done
if [ -e "$STATE/is_card" ] && [ -e "$out/run.json" ]; then
  sed -i 's/"backend": "OpenMP"/"backend": "Cuda"/' "$out/run.json"
fi
if [ -e "$STATE/bit" ] && [ "${out##*/}" = again ]; then
  /usr/bin/python3 - "$out"/restart_*.h5 << 'BIT'
import sys
import h5py
import numpy as np
with h5py.File(sys.argv[1], "r+") as file:
    values = file["fluid/u_x"][...]
    values.view(np.uint64)[3, 3, 3] ^= np.uint64(1)
    file["fluid/u_x"][...] = values
BIT
fi
exit "$status"
PROGRAM
cat > "$build/barchan_bench" << 'PROGRAM'
#!/usr/bin/env bash
case "$*" in
  *--benchmark_list_tests*) printf 'dem/heap_10k/real_time\nkernel/wale/manual_time\n' ;;
  *) exec "$REAL/barchan_bench" "$@" ;;
esac
PROGRAM
cat > "$build/physics_tests" << 'PROGRAM'
#!/usr/bin/env bash
echo "$*" >> "$STATE/asked"
case "$*" in
  *--gtest_list_tests*)
    printf '%s.\n  One\n' Quick Slow Frail
    printf 'Dark.\n  OneNightly\nTyped/0.  # TypeParam\n  One\n' ;;
  *=Slow.*) [ ! -e "$STATE/slow" ] || sleep 300 ;;
  *=Frail.*) [ ! -e "$STATE/frail" ] ;;
esac
PROGRAM
ln -s "$real/unit_tests" "$build/unit_tests"
chmod +x "$build"/*

light() {  # light EXPECTED_STATUS FOLDER ARGUMENT...
  local status=0
  "$root/scripts/first_light.sh" --tiny --tests 'Checksum|physics' --build "$build" --out "$dir/$2" "${@:3}" \
    > "$dir/said" 2>&1 || status=$?
  [ "$status" = "$1" ] || fail "first_light ${*:2} ended with $status, not $1: $(cat "$dir/said")"
}

# step FOLDER NAME STATUS WORDS: page and JSON have this result of a step, with these words
step() {
  "$python" - "$dir/$1" "$2" "$3" "$4" << 'STEP' || fail "after: $(tail -n 3 "$dir/said")"
import json
import pathlib
import sys
folder, name, status, words = sys.argv[1:]
found = json.loads((pathlib.Path(folder) / "first_light.json").read_text())
step = next(step for step in found["steps"] if step["name"] == name)
lines = (pathlib.Path(folder) / "first_light.md").read_text().splitlines()
row = next(line.split(" | ") for line in lines if line.startswith(f"| {step['title']} |"))
if step["status"] != status or row[1] != status or words not in step["reason"] or words not in row[3]:
    sys.exit(f"FAILED: {name} is {step}, on the page {row}; expected {status} with '{words}'")
STEP
}

verdict() { grep -q "^\*\*$2\*\*: " "$dir/$1/first_light.md" || fail "not $2: $(sed -n 3p "$dir/$1/first_light.md")"; }
asked() {  # asked SUITE TIMES
  [ "$(grep -c -- "=$1\.\*" "$dir/asked")" = "$2" ] || fail "$1 was not run $2 times: $(cat "$dir/asked")"
}

# Wrong calls.
wrong() {  # wrong WORDS ARGUMENT...
  light 2 wrong "${@:2}"
  [ "$(wc -l < "$dir/said")" = 1 ] && grep -q -- "$1" "$dir/said" || fail "expected '$1', got $(cat "$dir/said")"
}
wrong "--limit soon: must be a number" --stand-in --limit soon
wrong "unknown option '--unknown'" --unknown
wrong "not a regular expression" --stand-in --tests '('
wrong "needs a value" --out
wrong "there is no program $dir/none/barchan" --stand-in --build "$dir/none"
mkdir "$dir/foreign"
touch "$dir/foreign/mine"
wrong "holds something else" --stand-in --out "$dir/foreign"
[ -e "$dir/foreign/mine" ] || fail "a foreign folder was changed"
command -v nvidia-smi > /dev/null || wrong "nvidia-smi finds no card" --cpu-build "$real"

# The CPU stands in; a slow suite of tests is cut by the limit, and the next call goes on behind what was done.
touch "$dir/slow"
light 3 cpu --stand-in --limit .2
step cpu tests open "not yet"
verdict cpu open
asked Quick 1
rm "$dir/slow"
light 0 cpu --stand-in
step cpu tests passed "5 passed"
for name in quickstart one_step statistics restart_on_card restart_on_cpu; do step cpu "$name" passed ""; done
step cpu repeat passed "with the same bits"
step cpu benchmarks passed "2 passed"
step cpu dune passed "steps with OpenMP"
step cpu memcheck "not run here" "no card"
verdict cpu passed
asked Quick 2  # once by each of the two steps
grep -q "^The CPU stands in: nothing of this was on a card. A rehearsal on tiny" "$dir/cpu/first_light.md" ||
  fail "the page does not say what it rests on"
grep -q "^| dem/heap_10k | [0-9]" "$dir/cpu/first_light.md" || fail "a benchmark is not on the page"
light 0 cpu --stand-in
! grep -q -- "--- tests" "$dir/said" || fail "what was done was done again"

# A made-up card.
printf '#!/bin/sh\necho "GPU 0: made up"\n' > "$tools/nvidia-smi"
chmod +x "$tools/nvidia-smi"
PATH="$tools:/usr/bin:/bin"
touch "$dir/is_card" "$dir/frail" "$dir/bit"
: > "$dir/asked"
light 1 card --cpu-build "$real"
verdict card failed
step card tests failed "of 5 failed: physics_tests Frail"
step card repeat failed "restart_0000000040.h5 differs: ['fluid/u_x"
step card quickstart_blocking passed "with the same bits"
step card dune passed "steps with Cuda"
command -v compute-sanitizer > /dev/null || step card memcheck failed "compute-sanitizer is not in PATH"
command -v ncu > /dev/null || step card occupancy "not run here" "ncu is not in PATH"

# The tools come, one of them with a finding, and what had failed is mended: only this is done again.
cat > "$tools/compute-sanitizer" << 'TOOL'
#!/usr/bin/env bash
[ "$2" != racecheck ] || { echo "========= RACECHECK SUMMARY: 1 hazard displayed"; exit 86; }
"${@:5}" > /dev/null 2>&1 && echo "========= ERROR SUMMARY: 0 errors"
TOOL
cat > "$tools/ncu" << 'TOOL'
#!/usr/bin/env bash
while [ "$1" != --log-file ]; do shift || exit 0; done
wale="void Kokkos::Impl::launch<Kokkos::Impl::ParallelFor<barchan::Wale, Kokkos::RangePolicy<Kokkos::Cuda>>>(T1)"
cat > "$2" << CSV
==PROF== Connected to process 1
"ID","Kernel Name","Section Name","Metric Name","Metric Unit","Metric Value"
"0","$wale","Occupancy","Achieved Occupancy","%","40.5"
"1","$wale","Occupancy","Achieved Occupancy","%","41.5"
"1","$wale","LaunchStats","Registers Per Thread","register/thread","1,024"
CSV
TOOL
chmod +x "$tools"/*
rm "$dir/frail" "$dir/bit"
light 1 card --cpu-build "$real"
step card tests passed "5 passed"
step card repeat passed "with the same bits"
step card memcheck passed "ERROR SUMMARY: 0 errors"
step card racecheck failed "exit code 86; ========= RACECHECK SUMMARY: 1 hazard"
step card occupancy passed ""
grep -q "^| Wale | 2 | 41 | - | 1024 |$" "$dir/card/first_light.md" || fail "the occupancy is not on the page"
asked Quick 2
asked Frail 4
! grep -q -- "--- quickstart" "$dir/said" || fail "what had passed was done again"

# Another program, which does not run on the card: all is open again, and it is noticed.
rm "$dir/is_card"
echo "# changed" >> "$build/barchan"
light 1 card --cpu-build "$real"
grep -q "have changed: all steps are open again" "$dir/said" || fail "a changed program was not noticed"
step card quickstart failed "the program that is to run on the card runs with OpenMP"
step card tests passed "5 passed"
light 1 card --cpu-build "$real" --fresh
grep -q -- "--- tests: passed" "$dir/said" || fail "--fresh did not start over"

# Its own builds, by a cmake and a ninja that only pretend: presets, each with its Kokkos; a target that fails leaves no
# old program behind, and without one all steps fail.
copy="$dir/copy"
mkdir -p "$copy/kokkos/bin" "$copy/build/cuda" "$copy/tests"
cp -r "$root/scripts" "$root/configs" "$copy"
cp -r "$root/tests/support" "$copy/tests"
cat > "$tools/cmake" << 'TOOL'
#!/bin/sh
echo "$* with $Kokkos_ROOT" >> "$STATE/configured"
TOOL
cat > "$tools/ninja" << 'TOOL'
#!/usr/bin/env bash
[ "${!#}" != barchan ] || { echo "barchan.cpp: an error"; exit 1; }
echo "#!/bin/false" > "$2/${!#}"
chmod +x "$2/${!#}"
TOOL
touch "$copy/build/cuda/barchan" "$copy/kokkos/bin/nvcc_wrapper"
chmod +x "$tools"/* "$copy/kokkos/bin/nvcc_wrapper"
status=0
Kokkos_ROOT="$copy/kokkos" CPU_KOKKOS_ROOT="$copy/other" "$copy/scripts/first_light.sh" --tiny --out "$dir/built" \
  > "$dir/said" 2>&1 || status=$?
[ "$status" = 1 ] || fail "without a program the exit code is $status"
step built build failed "not built: barchan (in "
[ ! -e "$copy/build/cuda/barchan" ] || fail "a program from before is left"
step built quickstart failed "exit code 127"
grep -q -- "--preset cuda .* with $copy/kokkos$" "$dir/configured" &&
  grep -q -- "--preset release .* with $copy/other$" "$dir/configured" || fail "not the presets: $(cat "$dir/configured")"
finish "first light: passes, fails and goes on as it should"
