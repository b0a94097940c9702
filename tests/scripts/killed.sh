#!/usr/bin/env bash
# A run under the launcher that a signal ends, alone or one of two ranks: exit code 1, one line that says which signal
# and how to go on, and run.json does not say "running", nor the RO-Crate "active". What it says then works.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/script.sh"
export OMP_NUM_THREADS=1
cd "$dir" || exit 1
launcher="" program=""
trap 'kill -KILL $program $launcher 2> /dev/null; rm -rf "$dir"' EXIT
long=("$root/tests/support/small_dune.toml" --quiet --set time.end=1000 --set output.fields_interval=0
  --set output.grains_interval=0 --set output.history_interval=2.5e-4)

children() { cat "/proc/$1/task/$1/children"; }

# killed OUT RANKS FILE ARGUMENT...: starts a long run and ends one of its processes once such a file is there
killed() {
  local out=$1 ranks=$2 file=$3 status=0
  shift 3
  "$root/barchan" run "${long[@]}" --out "$out" --ranks "$ranks" "$@" > "$out.said" 2>&1 &
  launcher=$!
  for _ in $(seq 600); do
    ! compgen -G "$out/$file" > /dev/null || break
    sleep 0.1
  done
  program="$(children "$launcher")"
  if [ "$ranks" -gt 1 ]; then program="$(children "${program%% *}")"; fi
  program="${program%% *}"
  [ -n "$program" ] || { cat "$out.said"; fail "$out: the run is not there"; }
  kill -KILL "$program"
  wait "$launcher" || status=$?
  [ "$status" -eq 1 ] || fail "$out: exit code $status"
  grep -q '^  "status": "failed",$' "$out/run.json" || fail "$out: $(head -n 3 "$out/run.json")"
  grep -q "\"message\": \"ended by SIGKILL" "$out/run.json" || fail "$out: $(head -n 3 "$out/run.json")"
  grep -q '"@id": "http://schema.org/FailedActionStatus"' "$out/ro-crate-metadata.json" || fail "$out: crate not failed"
  for json in run ro-crate-metadata; do
    "$python" -m json.tool "$out/$json.json" > /dev/null || fail "$out/$json.json is broken"
  done
  # The rank that is left may have been reading from the other's memory: MPI itself says so, and cannot be told not to.
  [ "$(grep -c "ended by SIGKILL" "$out.said")" -eq 1 ] &&
    ! grep -v "^warning: \|^barchan: ended\|^\[.*\] Read -1, expected [0-9]*, errno = 3$" "$out.said" ||
    { cat "$out.said"; fail "$out: not one line about it"; }
}

"$root/barchan" build > /dev/null 2>&1  # so that the launcher has nothing to say about it later
for ranks in 1 2; do
  [ "$ranks" -eq 1 ] || command -v mpirun > /dev/null || continue
  killed "on $ranks" "$ranks" "restart_*.h5" --set restart.interval=0.01
  grep -q "perhaps because the memory is full; go on with .*/barchan run .* --resume" "on $ranks.said" ||
    { cat "on $ranks.said"; fail "it is not said how to go on"; }
done
# The line, taken as it stands, goes on (its end time is a thousand seconds away).
line="$(grep -m 1 "go on with" "on 1.said")"
bash -s <<< "timeout 60 ${line#*go on with } --set time.wall_clock_limit=0.5" > again 2>&1
[ $? -eq 3 ] || { cat again; fail "what the line says does not go on"; }

killed "no restart" 1 run.json --set restart.interval=0
grep -q "before it had written a restart file in no restart" "no restart.said" || fail "a restart file that is not there"
finish "killed runs are told, marked and can go on"
