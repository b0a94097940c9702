# The steps of scripts/first_light.sh, which reads this in: functions step_NAME. They return 0 passed, 1 failed, 75 cut
# by the limit of time, 77 not run here, and leave what they found in `reason`. Results are in $out/runs, what is said
# in $log. A step of many parts keeps a list of those that are done.
# shellcheck shell=bash
# shellcheck disable=SC2034,SC2154  # options are set there, the list is read there
# shellcheck disable=SC2317  # steps are called by their names

# Name of a step, and what it is called on the page, in their order.
steps=(
  "build|Build for the card (preset cuda)"
  "build_cpu|Build for the CPU (preset release)"
  "tests|Unit and physics tests"
  "quickstart|First dune"
  "tests_blocking|Unit and physics tests, one kernel at a time"
  "quickstart_blocking|First dune, one kernel at a time: the same bits"
  "repeat|First dune again: the same bits"
  "memcheck|compute-sanitizer memcheck"
  "racecheck|compute-sanitizer racecheck"
  "initcheck|compute-sanitizer initcheck"
  "synccheck|compute-sanitizer synccheck"
  "one_step|Card and CPU after one step"
  "statistics|Card and CPU after the whole run: means"
  "restart_on_card|A restart file of the CPU on the card"
  "restart_on_cpu|A restart file of the card on the CPU"
  "benchmarks|All benchmarks"
  "occupancy|Occupancy of the kernels"
  "dune|The paper's dune for a minute"
)

# --- what steps are made of ---

reason=""
fail() { reason=$1; return 1; }
not_here() { reason=$1; return 77; }

limited() {  # limited COMMAND...
  local left=$((deadline - SECONDS)) status=0
  [ "$left" -gt 0 ] || return 75
  timeout --foreground --kill-after=60 "$((left < patience ? left : patience))" "$@" || status=$?
  [ "$status" -eq 0 ] || [ "$SECONDS" -lt "$deadline" ] || return 75
  return "$status"
}

far() { [ ! -s "$out/steps/$step.done" ] || echo "$(wc -l < "$out/steps/$step.done") done"; }

within() {  # within WHAT COMMAND...
  local status=0
  progress "$1" "$log" far limited "${@:2}" || status=$?
  case $status in
    0 | 75) return "$status" ;;
    124) fail "$1: no end after $patience s" ;;
    *) fail "$1: exit code $status; $(last_words)" ;;
  esac
}

last_words() { grep -v '^ *$' "$log" | tail -n 1 | tr '\t' ' ' | cut -c 1-200; }

each() {  # each COMMAND < NAMES: runs COMMAND NAME for those not in the list of what is done, and adds them there
  local name status start done="$out/steps/$step.done"
  while IFS= read -r name <&3; do
    if [ -f "$done" ] && cut -f 2 "$done" | grep -qxF -- "$name"; then continue; fi
    status=0
    start=$SECONDS
    "$1" "$name" < /dev/null || status=$?
    [ "$status" -ne 75 ] || return 75
    printf '%s\t%s\t%s\n' "$([ "$status" -eq 0 ] && echo passed || echo failed)" "$name" $((SECONDS - start)) >> "$done"
  done 3<&0
}

all_of() {  # all_of WHAT NAMES COMMAND: each of NAMES, and that none failed
  local n status=0 failed
  n=$(wc -l < "$2")
  [ "$n" -gt 0 ] || { fail "$1: there are none"; return; }
  progress "$1 ($n)" "$log" far each "$3" < "$2" || status=$?
  [ "$status" -eq 0 ] || return "$status"
  failed="$(awk -F '\t' '$1 == "failed" { printf " %s", $2 }' "$out/steps/$step.done")"
  [ -z "$failed" ] || { fail "of $n failed:$failed"; return; }
  reason="$n passed"
}

run_case() {  # run_case card|cpu FOLDER ARGUMENT...: a new run of the case in runs/FOLDER
  local program="$build/barchan" options=()
  [ "$1" = card ] || { program="$cpu_build/barchan" options=("${cpu_options[@]}"); }
  within "$2 on the $1" "$program" run "$case" --quiet --overwrite --out "$out/runs/$2" "${options[@]}" "${@:3}" &&
    ran_on "$1" "$2"
}

ran_on() {  # ran_on card|cpu FOLDER
  local backend
  backend="$(sed -n 's/^ *"backend": "\(.*\)",$/\1/p' "$out/runs/$2/run.json")"
  case $1-$backend in
    *-) fail "run.json does not say where it ran" || return ;;
    card-Cuda | card-HIP | card-SYCL | cpu-OpenMP | cpu-Serial | cpu-Threads) ;;
    *) [ "$stand_in" = yes ] || fail "the program that is to run on the $1 runs with $backend" || return ;;
  esac
  reason="$(sed -n 's/^ *"steps": \(.*\),$/\1/p' "$out/runs/$2/run.json") steps with $backend"
}

judge() {  # judge bits|step|statistics FOLDER OTHER
  reason="$("$python" "$root/scripts/first_light_judge.py" "$1" "$out/runs/$2" "$out/runs/$3" 2>&1)" || return 1
}

until_step() { awk -v n="$1" -F '[= #]+' '/^fluid_step/ { printf "time.end=%.12g", n * $2 }' "$case"; }

newest_restart() { find "$out/runs/$1" -name 'restart_*.h5' 2> /dev/null | sort | tail -n 1; }

# --- the steps ---

build_preset() {  # build_preset PRESET FOLDER GIVEN: what a target leaves is removed if the target fails
  local target failed="" status=0
  [ -z "$3" ] || { not_here "given in $3"; return; }
  within "configuring the preset $1" cmake --preset "$1" -S "$root" -B "$2" || return
  for target in barchan unit_tests physics_tests barchan_bench; do
    status=0
    within "building $target" ninja -C "$2" -k 0 -j "${JOBS:-$(nproc)}" "$target" || status=$?
    [ "$status" -eq 0 ] || rm -f "$2/$target"
    [ "$status" -ne 75 ] || return 75
    [ "$status" -eq 0 ] || failed+=" $target"
  done
  [ -z "$failed" ] || fail "not built:$failed (in $log)"
}

step_build() { build_preset "$([ "$stand_in" = yes ] && echo release || echo cuda)" "$build" "$built"; }

step_build_cpu() {
  [ "$cpu_build" != "$build" ] || { not_here "the build above stands in for both"; return; }
  local -x Kokkos_ROOT="${CPU_KOKKOS_ROOT:-}"
  build_preset release "$cpu_build" "$cpu_built"
}

suites_of() {  # suites_of PROGRAM: "unit_tests Suite" a line, without those of the night
  local listing
  listing="$("$build/$1" --gtest_list_tests 2>> "$log")" || return
  awk -v program="$1" '/^[^ ]+\.( |$)/ { suite = $1; seen = 0 }
    /^ / && !seen && suite $0 !~ /Nightly/ { seen = 1; sub(/\.$/, "", suite); print program " " suite }' <<< "$listing"
}

one_suite() { limited "$build/${1% *}" "--gtest_filter=${1#* }.*-*Nightly*" --gtest_brief=1; }

step_tests() {
  local program names="$out/steps/$step.names"
  : > "$names"
  for program in unit_tests physics_tests; do
    suites_of "$program" >> "$names" || { fail "$program cannot list its tests; $(last_words)"; return; }
  done
  grep -E -- "$tests" "$names" > "$names.asked" || true
  all_of "test suites" "$names.asked" one_suite
}
step_tests_blocking() {
  local -x CUDA_LAUNCH_BLOCKING=1
  step_tests
}

step_quickstart() {
  within "the states that it starts from" "$build/barchan" run "$case" --quiet --starts-only \
    --out "$out/runs/quickstart" && run_case card quickstart
}
step_quickstart_blocking() {
  local -x CUDA_LAUNCH_BLOCKING=1
  run_case card blocking && judge bits quickstart blocking
}
step_repeat() { run_case card again && judge bits quickstart again; }

sanitizer() {
  if ! command -v compute-sanitizer > /dev/null; then
    if [ "$stand_in" = yes ]; then not_here "no card"; else fail "compute-sanitizer is not in PATH"; fi
    return
  fi
  [ "$stand_in" = no ] || { not_here "no card"; return; }
  within "$1 of three steps" compute-sanitizer --tool "$1" --error-exitcode 86 "$build/barchan" run "$case" --quiet \
    --overwrite --out "$out/runs/$1" --set "$(until_step 3)" || return
  reason="$(grep -o '[A-Z]* SUMMARY: .*' "$log" | tail -n 1)"
}
step_memcheck() { sanitizer memcheck; }
step_racecheck() { sanitizer racecheck; }
step_initcheck() { sanitizer initcheck; }
step_synccheck() { sanitizer synccheck; }

step_one_step() {
  run_case card one-card --set "$(until_step 1)" && run_case cpu one-cpu --set "$(until_step 1)" &&
    judge step one-card one-cpu
}
step_statistics() { run_case cpu whole-cpu && judge statistics quickstart whole-cpu; }

go_on() {  # go_on WROTE OTHER: one more step from WROTE's restart file, on both
  local restart
  restart="$(newest_restart "one-$1")"
  [ -n "$restart" ] || { fail "the $1 has written no restart file in the step one_step"; return; }
  run_case "$1" "$1-then-$1" --restart "$restart" --set "$(until_step 2)" &&
    run_case "$2" "$1-then-$2" --restart "$restart" --set "$(until_step 2)" && judge step "$1-then-$1" "$1-then-$2"
}
step_restart_on_card() { go_on cpu card; }
step_restart_on_cpu() { go_on card cpu; }

one_benchmark() {
  limited "$build/barchan_bench" "--benchmark_filter=^$1$" "${bench_options[@]}" "--records=$out/bench.jsonl" \
    "--heaps=$out/heaps" "--runs=$out/runs"
}

step_benchmarks() {
  local names="$out/steps/$step.names"
  "$build/barchan_bench" "--runs=$out/runs" --benchmark_list_tests 2>> "$log" > "$names" ||
    { fail "barchan_bench cannot list its cases; $(last_words)"; return; }
  OMP_PROC_BIND=true all_of "benchmarks" "$names" one_benchmark
}

step_occupancy() {
  [ "$stand_in" = no ] || { not_here "no card"; return; }
  command -v ncu > /dev/null || { not_here "ncu is not in PATH"; return; }
  within "one step under ncu" ncu --csv --section Occupancy --section LaunchStats --kernel-name-base demangled \
    --launch-count 500 --log-file "$out/ncu.csv" --force-overwrite "$build/barchan" run "$case" --quiet --overwrite \
    --out "$out/runs/occupancy" --set "$(until_step 1)"
}

step_dune() {
  local starts=() status=0
  if [ "$tiny" = no ]; then
    [ -s "$out/heaps/heap_100k.csv" ] || { fail "no heap of 100,000 grains: the benchmarks make it"; return; }
    starts=(--set initial.fluid=turbulent --set "initial.grains=$out/heaps/heap_100k.csv")
  fi
  progress "the dune" "$log" far limited "$build/barchan" run "$dune_case" --quiet --overwrite --out "$out/runs/dune" \
    "${starts[@]}" --set "time.end=1000" --set "time.wall_clock_limit=$dune_seconds" || status=$?
  [ "$status" -ne 75 ] || return 75
  [ "$status" -eq 3 ] || { fail "exit code $status, not 3 (its time is up); $(last_words)"; return; }
  ran_on card dune
}
