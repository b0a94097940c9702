#!/usr/bin/env bash
# A flow over several ranks: the same results, also of one that turns, restarts on another number of ranks, a polite stop, the death
# of a rank, one that hangs, one that fails alone, and a case that one rank lacks.
# shellcheck disable=SC2086  # $ranks: one word a rank
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../support/over_ranks.sh"
ranks=""
trap 'kill -KILL $ranks 2> /dev/null || true; rm -rf "$work"' EXIT

cat > flow.toml <<'TOML'
[case]
title = "Small channel"
[time]
end = 0.03
fluid_step = 1e-3
[domain]
size = [0.05, 0.025, 0.02]
[fluid]
cells = [31, 16, 21]
first_cell_height = 5e-4
mean_velocity = 0.24
[initial]
fluid = "turbulent"
[output]
fields_interval = 0.01
history_interval = 0.005
[statistics]
start = 0.005
interval = 0.005
fields = true
TOML

run 1 flow.toml --out one
run 6 flow.toml --out six
grep -q '"ranks": 6' six/run.json || fail "run.json does not say how many ranks ran"
"$support/compare_runs.py" flow one six || fail "six ranks and one differ"

run 2 flow.toml --out parts --set time.end=0.01
run 3 flow.toml --out parts --set time.end=0.02 --restart parts/restart_0000000010.h5
run 1 flow.toml --out parts --restart parts/restart_0000000020.h5
"$support/compare_runs.py" flow one parts || fail "2, then 3, then 1 ranks and one differ"

# A start more along z than along x, and pieces that end within the ramp.
turning=(--set fluid.mean_velocity=0 --set "fluid.schedule=[{time = 0, velocity = [0.1, 0.2]}, {time = 0.005,
  velocity = [0.2, -0.1], ramp = 0.02, amplitude = [0.02, 0.05], period = 0.012}]")
turning=("${turning[@]//$'\n'/}")
run 1 flow.toml --out turn "${turning[@]}"
run 6 flow.toml --out turn_six "${turning[@]}"
"$support/compare_runs.py" flow turn turn_six || fail "six ranks and one differ in a flow that turns"
run 2 flow.toml --out turn_parts --set time.end=0.01 "${turning[@]}"
run 3 flow.toml --out turn_parts --set time.end=0.02 --restart turn_parts/restart_0000000010.h5 "${turning[@]}"
run 1 flow.toml --out turn_parts --restart turn_parts/restart_0000000020.h5 "${turning[@]}"
"$support/compare_runs.py" flow turn turn_parts || fail "2, then 3, then 1 ranks and one differ in a flow that turns"

status=0  # a case that only one node has
mpirun "${options[@]}" -np 1 "$BARCHAN_PROGRAM" run flow.toml --quiet --out node \
  : -np 1 "$BARCHAN_PROGRAM" run absent.toml --quiet --out node > out 2>&1 || status=$?
[ "$status" -eq 2 ] && [ "$(grep -c "error: rank 1: absent.toml" out)" -eq 1 ] ||
  { cat out; fail "a case that is missing on one rank: exit code $status"; }

long() {  # long FOLDER ARGUMENT...: starts a long run on two ranks; their process numbers in $ranks
  mpirun "${options[@]}" -np 2 bash -c "trap '' XFSZ; exec \"\$@\"" - "$BARCHAN_PROGRAM" run flow.toml --quiet \
    --set time.end=1000 --set statistics.fields=false --set output.fields_interval=0 --out "$@" \
    > "$1.out" 2>&1 < /dev/null &
  job=$!
  for _ in $(seq 100); do
    if [ -e "$1/history.csv" ] && [ "$(wc -l < "$1/history.csv")" -ge 3 ]; then break; fi
    sleep 0.1
  done
  ranks="$(cat "/proc/$job/task/$job/children")"
  [ "$(wc -w <<< "$ranks")" -eq 2 ] || { cat "$1.out"; fail "the long run is not there"; }
}
breaks() {  # breaks FOLDER WORDS: that run ends by itself, soon, with one line, which has these words
  local status=0
  SECONDS=0
  timeout 30 tail --pid="$job" -f /dev/null || kill -KILL $ranks
  wait "$job" || status=$?
  [ "$status" -eq 1 ] && [ "$SECONDS" -lt 20 ] && [ "$(grep -c "error: " "$1.out")" -eq 1 ] &&
    grep -q "$2" "$1.out" || { cat "$1.out"; fail "$1: exit code $status after $SECONDS s"; }
}
long stopped
kill -TERM "${ranks%% *}"  # one rank hears it, both stop
status=0
wait "$job" || status=$?
[ "$status" -eq 3 ] || { cat stopped.out; fail "exit code $status after SIGTERM, expected 3"; }
grep -q '"status": "stopped"' stopped/run.json || fail "run.json does not say that the run was stopped"
compgen -G "stopped/restart_*.h5" > /dev/null || fail "no restart file after SIGTERM"

long killed
kill -KILL "${ranks%% *}"
SECONDS=0
status=0
wait "$job" || status=$?
[ "$status" -ne 0 ] && [ "$SECONDS" -lt 20 ] || fail "a killed rank: exit code $status after $SECONDS s"

long suspended --patience 3
kill -STOP $ranks  # all of them: nobody waits for anybody
sleep 5
kill -CONT $ranks
sleep 1
kill -STOP "${ranks%% *}"  # rank 0 alone: MPI sees nothing
breaks suspended "rank 1 on .* has waited .* s while .* (fluid step .* t = .*)"

no_fields=(--set output.fields_interval=0)
run 2 flow.toml --out full --set time.end=0.01 "${no_fields[@]}"
mpirun "${options[@]}" -np 2 bash -c "trap '' XFSZ; [ \$OMPI_COMM_WORLD_RANK -eq 0 ] || ulimit -f 50; exec \"\$@\"" - \
  "$BARCHAN_PROGRAM" run flow.toml --quiet --out full --restart full/restart_0000000010.h5 "${no_fields[@]}" \
  > full.out 2>&1 &
job=$! ranks=$!  # the disk of rank 1 is full beyond 50 kB
breaks full "rank 1: cannot write full/restart_.*the last good restart is full/restart_0000000010.h5"
ranks=""
echo "ok"
