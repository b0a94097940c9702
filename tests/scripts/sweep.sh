#!/usr/bin/env bash
# Studies: the cases they make, a failed case, a kill in the middle and going on. Mistakes: tests/bad_input.
set -u
# shellcheck source=tests/support/studies.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/studies.sh"

begin() {  # begin FOLDER: the study as process $pid, until its base case has written a restart file
  "$python" -m barchan sweep "$program" study.toml --no-pictures --out "$1" > "$1.txt" 2>&1 &
  pid=$!
  for _ in $(seq 300); do
    if ls "$1"/base/restart_*.h5 > /dev/null 2>&1; then break; fi
    sleep 0.05
  done
}

# A pile of a few grains in still water, with a start of its own.
cat > heap.toml << 'CASE'
[case]
title = "few grains"
[time]
end = 0.02
fluid_step = 1e-3
grain_step = 1e-5
[domain]
size = [0.02, 0.02, 0.02]
[grains]
youngs_modulus = 3e5
sliding_friction = 0.3
restitution = 0.1
sizes = [[2e-4, 200]]
[initial]
grains = { pour = { centre = [0.01, 0.01], radius = 0.003 } }
CASE
sed -e '/^sizes/d' -e 's/end = 0.02/end = 0.9/' -e 's/grains = { pour.*/grains = "heap.toml"/' heap.toml > case.toml
cat > study.toml << 'STUDY'
[study]
title = "few grains, rubbed"
base = "case.toml"
at_once = 2
threads = 1
[set]
restart.interval = 0.01
[vary]
grains.sliding_friction = [0.3, 0.6]
grains.restitution = [0.1, 0.5]
STUDY

# --- the cases of a study
sweep study.toml --list > list || fail "--list ended with $?"
[ "$(cut -d' ' -f1 list | tr '\n' ' ')" = "base sliding_friction-0.6 restitution-0.5 " ] || fail "cases: $(cat list)"
grep -q "^restitution-0.5 restart.interval=0.01 grains.sliding_friction=0.3 grains.restitution=0.5$" list ||
  fail "values: $(cat list)"
[ ! -e runs ] || fail "--list made a folder"
printf '[study]\nbase = "case.toml"\n[grid]\ngrains.restitution = [0.1, 0.2]\n"grains.density" = [2500, 2600, 2700]\n' > grid.toml
[ "$(sweep grid.toml --list | wc -l)" = 6 ] || fail "a grid of 2 x 3 has not 6 cases"

# --- killed in the middle; the same command goes on and gives the bits of an unbroken run
begin killed
kill -STOP "$pid"  # else it starts another case before its own kill comes
pkill -KILL -P "$pid" || fail "nothing ran when the kill came"
kill -KILL "$pid"
wait "$pid" 2> /dev/null
! grep -q '"status": "done"' killed/base/run.json || fail "the base case was done before the kill: the test is too short"
sweep study.toml --no-pictures --out killed > second 2>&1 || fail "going on ended with $?: $(cat second)"
grep -q "base: goes on from restart_" second || fail "the base case was not continued: $(cat second)"
sweep study.toml --no-pictures --out whole > third 2>&1 || fail "the unbroken study ended with $?: $(cat third)"
grep -Eq "3 of 3 cases done, [0-9.e+]+ runs an hour, whole/study.csv" third || fail "the last line: $(tail -n 1 third)"
for name in base sliding_friction-0.6 restitution-0.5; do
  cmp -s killed/$name/history.csv whole/$name/history.csv || fail "$name: the broken run differs from the unbroken one"
done
[ "$(cut -d, -f1-4 whole/study.csv | head -n 3 | tail -n 1)" = "sliding_friction-0.6,0.6,0.1,done" ] ||
  fail "table: $(cat whole/study.csv)"
"$python" -c 'import json; s = json.load(open("whole/study.json"))
assert [c["varied"] for c in s["cases"]] == [None, "grains.sliding_friction", "grains.restitution"], s' ||
  fail "study.json"

# --- done is done; a longer study goes on
sweep study.toml --no-pictures --out whole > again 2>&1
[ "$(grep -c 'done before' again)" = 3 ] || fail "a finished study was run again: $(cat again)"
sed -i 's/^restart.interval.*/&\ntime.end = 1/' study.toml
sweep study.toml --no-pictures --out whole > longer 2>&1 || fail "the longer study ended with $?"
[ "$(grep -c 'goes on from' longer)" = 3 ] || fail "a longer study does not go on: $(cat longer)"

# --- SIGTERM: status 3, and every running case has its restart file
sed -i 's/^time.end.*/time.end = 1.5/' study.toml  # no case is done before the signal comes
begin stopped
kill -TERM "$pid"
status=0
wait "$pid" || status=$?
[ "$status" = 3 ] || fail "a stopped sweep ended with $status: $(cat stopped.txt)"
grep -q '"status": "stopped"' stopped/base/run.json || fail "the base case was not stopped with grace"

# --- a case that fails does not stop the others
printf '[study]\nbase = "case.toml"\n[set]\nrestart.interval = 0.01\n[[case]]\nname = "broken"\nset = { initial.grains = "overlap.csv" }\n[[case]]\nname = "good"\n' > mixed.toml
printf 'id,diameter,x,y,z\n1,2e-4,0.01,5e-3,0.01\n1,2e-4,0.012,5e-3,0.01\n' > overlap.csv
status=0
sweep mixed.toml --no-pictures > mixed 2>&1 || status=$?
[ "$status" = 1 ] || fail "a study with a failed case ended with $status: $(cat mixed)"
grep -q '^broken,.*failed' runs/mixed/study.csv || fail "table: $(cat runs/mixed/study.csv)"
grep -q '^good,.*done' runs/mixed/study.csv || fail "the good case was not run: $(cat mixed)"

# --- an edited table: results of the old one are not done, and go only with --overwrite
sed -e 's/heap.toml/one.csv/' -e 's/end = 0.9/end = 0.002/' case.toml > one.toml
printf 'id,diameter,x,y,z\n1,2e-4,0.01,5e-3,0.01\n' > one.csv
printf '[study]\nbase = "one.toml"\n[[case]]\nname = "only"\n' > table.toml
sweep table.toml --no-pictures --out table > first 2>&1 || fail "a study of a table: $(cat first)"
sed -i 's/5e-3/6e-3/' one.csv
status=0
sweep table.toml --no-pictures --out table > edited 2>&1 || status=$?
[ "$status" = 1 ] || fail "an edited table: status $status: $(cat edited)"
grep -q 'only: to be run, .*one.csv has changed' edited || fail "the edited table is not told: $(cat edited)"
grep -q 'only: failed: .*from another content of .*one.csv' edited || fail "its results were taken: $(cat edited)"
sweep table.toml --no-pictures --out table --overwrite > anew 2>&1 || fail "anew: $(cat anew)"
grep -q '^only,.*done' table/study.csv || fail "table: $(cat table/study.csv)"

finish "sweep: fine"
