#!/usr/bin/env bash
# All that a GPU on which the program never ran has to show, in one command; --help says how. Here are the options and
# the order of things. first_light_steps.sh has the steps, first_light_judge.py compares, first_light.py makes the page.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
speaker=first_light
# shellcheck source=scripts/progress.sh
. "$root/scripts/progress.sh"
# shellcheck source=scripts/first_light_steps.sh
. "$root/scripts/first_light_steps.sh"

usage() {
  cat << 'USAGE'
usage: Kokkos_ROOT=DIR scripts/first_light.sh [OPTION...]

Builds the program for a GPU, tests it, compares it with the CPU, measures it, and writes what it found to
first_light.md and first_light.json. Kokkos_ROOT: a Kokkos with CUDA, OpenMP and the card's architecture.
CPU_KOKKOS_ROOT: one with OpenMP for the program on the CPU (without: the one that the system has).

  --out DIR         its results and pages (default: runs/first-light)
  --limit MINUTES   stop after this time; the same call again goes on
  --fresh           start over
  --build DIR       a build for the card that is there, in place of an own one
  --cpu-build DIR   the same for the CPU
  --stand-in        no card: the OpenMP build stands in for it, and tools of the card are not run
  --tests REGEX     only the test suites whose name it is in
  --tiny            a small case and tiny benchmarks: a rehearsal, nothing to be measured
  --help

A step that fails does not end the others. A repeated call leaves out what was done with the same programs and cases;
when all steps have been tried, it tries those that failed again.

exit code: 0 all passed, 1 something failed, 2 wrong call, 3 the limit of time was reached, 130 stopped by a signal
USAGE
}

out="$root/runs/first-light" limit="" fresh=no build="" cpu_build="" stand_in=no tests=. tiny=no
wrong_call() { die 2 "$1; --help lists the options"; }
while [ $# -gt 0 ]; do
  case $1 in
    --out | --limit | --build | --cpu-build | --tests)
      [ $# -gt 1 ] && [ -n "$2" ] || wrong_call "$1 needs a value" ;;&
    --out) out="$(realpath -m -- "$2")"; shift ;;
    --limit) limit=$2; shift ;;
    --build) build="$(realpath -m -- "$2")"; shift ;;
    --cpu-build) cpu_build="$(realpath -m -- "$2")"; shift ;;
    --tests) tests=$2; shift ;;
    --fresh) fresh=yes ;;
    --stand-in) stand_in=yes ;;
    --tiny) tiny=yes ;;
    --help | -h) usage; exit 0 ;;
    *) wrong_call "unknown option '$1'" ;;
  esac
  shift
done
if [ -n "$limit" ] && [[ ! $limit =~ ^([1-9][0-9]{0,4}|0?\.[0-9]{1,2})$ ]]; then
  wrong_call "--limit $limit: must be a number of minutes"
fi
status=0
grep -qE -- "$tests" <<< "" 2> /dev/null || status=$?
[ "$status" -lt 2 ] || wrong_call "--tests $tests: not a regular expression"
for folder in ${build:+"$build"} ${cpu_build:+"$cpu_build"}; do
  [ -x "$folder/barchan" ] || die 2 "there is no program $folder/barchan"
done
if [ "$stand_in" = no ] && ! nvidia-smi -L > /dev/null 2>&1; then
  die 2 "nvidia-smi finds no card here; --stand-in rehearses on the CPU"
fi
if [ -z "$build" ] && [ "$stand_in" = no ] && [ ! -x "${Kokkos_ROOT:-}/bin/nvcc_wrapper" ]; then
  die 2 "Kokkos_ROOT must name a Kokkos built with CUDA (there is no '${Kokkos_ROOT:-}/bin/nvcc_wrapper')"
fi
if [ -d "$out" ] && [ ! -e "$out/key" ] && [ -n "$(ls -A "$out")" ]; then
  die 2 "$out holds something else; give another --out"
fi

case="$root/configs/quickstart.toml" dune_case="$root/configs/paper/barchan-100k.toml" dune_seconds=60
bench_options=(--benchmark_repetitions=5 --benchmark_min_time=1)
if [ "$tiny" = yes ]; then
  case="$root/tests/support/small_dune.toml" dune_case="$case" dune_seconds=1
  bench_options=(--tiny --benchmark_min_time=0.01)
fi
patience=7200  # s; nothing takes longer unless it hangs
deadline=$((SECONDS + 100000000))
[ -z "$limit" ] || deadline=$(awk -v m="$limit" -v s="$SECONDS" 'BEGIN { print int(s + 60 * m) }')
built=$build
cpu_built=$cpu_build
build="${build:-$root/build/$([ "$stand_in" = yes ] && echo release || echo cuda)}"
cpu_build="${cpu_build:-$([ "$stand_in" = yes ] && echo "$build" || echo "$root/build/release")}"
cpu_options=()
[ "$stand_in" = no ] || cpu_options=(--threads 1)  # other sums than with all threads, as another processor has
python=/usr/bin/python3
[ -x "$python" ] || python=python3
export OMP_PROC_BIND="${OMP_PROC_BIND:-false}" OMP_DISPLAY_ENV=false PYTHONDONTWRITEBYTECODE=1

# --- the order of things ---

take() {  # take STEP: runs it and stamps it; 75 if the limit cut it
  local status=0 start=$SECONDS words=(passed failed)
  step=$1 log="$out/steps/$1.log" reason=""
  say "--- $step"
  : > "$log"
  # Of a step that was cut, what is done stays; of one that failed, what failed is done again.
  if [ "$(stamp_of "$step")" = failed ] && [ -f "$out/steps/$step.done" ]; then
    sed -i '/^failed/d' "$out/steps/$step.done"
  fi
  rm -f "$out/steps/$step.stamp"
  "step_$step" || status=$?
  [ "$status" -ne 75 ] || return 75
  words[77]="not run here"
  printf '%s\t%s\t%s\n' "${words[$status]:-failed}" $((SECONDS - start)) "$(tr '\t\n' '  ' <<< "$reason")" \
    > "$out/steps/$step.stamp"
  say "--- $step: ${words[$status]:-failed}${reason:+ ($reason)}"
}

stamp_of() { if [ -f "$out/steps/$1.stamp" ]; then cut -f 1 "$out/steps/$1.stamp"; else echo open; fi; }

key_of() {  # of all that results rest on
  {
    find -L "$build" "$cpu_build" -maxdepth 1 -type f -executable -print0 2> /dev/null | sort -zu | xargs -0r sha256sum
    sha256sum "$case" "$dune_case" "$root"/configs/{channel-small,heap-3k,paper/channel-mesh-1}.toml
    sha256sum "$root"/scripts/first_light*
    echo "$stand_in $tiny $tests"
    nvidia-smi -L 2> /dev/null || true
  } | sha256sum
}

forget() { rm -rf "$out/steps" "$out/runs" "$out/heaps" "$out/bench.jsonl" "$out/ncu.csv" "$out/key"; }

page() {
  printf '%s\n' "${steps[@]}" > "$out/steps/list"
  local how=""
  [ "$stand_in" = no ] || how+="The CPU stands in: nothing of this was on a card. "
  [ "$tiny" = no ] || how+="A rehearsal on tiny cases: nothing of this is a measurement. "
  [ "$tests" = . ] || how+="Only the test suites that match $tests."
  "$python" "$root/scripts/first_light.py" "$out" "$build" "$cpu_build" "$how"
}

main() {
  local entry name cut=no key failed_before=() open=() status=0
  [ "$fresh" = no ] || forget
  mkdir -p "$out/steps"
  [ -e "$out/key" ] || echo none > "$out/key"
  trap 'page || true; exit 130' INT TERM
  for name in build build_cpu; do  # always, as only they know what has changed
    [ "$cut" = yes ] || take "$name" || cut=yes
  done
  key="$(key_of)"
  if [ "$key" != "$(cat "$out/key")" ]; then
    [ "$(cat "$out/key")" = none ] || say "programs or cases have changed: all steps are open again"
    find "$out/steps" -type f ! -name 'build*' -delete
    rm -rf "$out/runs" "$out/heaps" "$out/bench.jsonl" "$out/ncu.csv"
    echo "$key" > "$out/key"
  fi
  for entry in "${steps[@]:2}"; do
    name="${entry%%|*}"
    case $(stamp_of "$name") in
      open | "not run here") open+=("$name") ;;
      failed) failed_before+=("$name") ;;
    esac
  done
  for name in "${open[@]}" "${failed_before[@]}"; do
    [ "$cut" = yes ] || take "$name" || cut=yes
  done
  page || status=$?
  if [ "$cut" = yes ]; then
    say "the limit of $limit minutes is reached; the same call goes on"
    [ "$status" -ne 0 ] || status=3
  fi
  exit "$status"
}

main
