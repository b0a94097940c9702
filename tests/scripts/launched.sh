#!/usr/bin/env bash
# What the launcher does around the program, which is stood in for: where it looks for results, what it says of a
# program that a signal has ended, and that nothing depends on who listens.
set -u
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/script.sh"
cd "$dir" || exit 1

# As installed: nothing is built.
mkdir -p bin libexec/barchan share/barchan && cp "$root/barchan" bin && cp "$root"/scripts/{progress,usage}.sh share/barchan ||
  exit 1
stand_in() { cat > "$1" && chmod +x "$1"; }  # stand_in FILE: the program that it is
stand_in libexec/barchan/barchan <<'SH'
#!/bin/sh
[ "$MODE" != stopped ] || exit 3
[ "$MODE" != killed ] || { mkdir -p runs/case; printf '{\n  "status": "running",\n  "message": ""\n}\n' > runs/case/run.json; kill -KILL $$; }
SH
stand_in draws <<'SH'
#!/bin/sh
[ "$1" = -c ] || { shift 4; echo "draws: $*"; }
SH
export BARCHAN_PYTHON="$dir/draws" OMP_NUM_THREADS=1 MODE=fine
launch() { bin/barchan run "$@"; }

count=0
while IFS=, read -r name folder; do
  case $name in '#'*) continue ;; esac
  count=$((count + 1))
  said="$(launch "some.where/$name" 2>&1)"
  [ "$said" = "draws: runs/$folder" ] || fail "$name: '$said', not runs/$folder"
done < "$root/tests/reference/run_names.csv"
[ "$count" -gt 10 ] || fail "only $count names"
[ "$(launch case.toml 2>&1)" = "draws: runs/case" ] || fail "a case in this folder"
[ "$(launch --out elsewhere case.toml 2>&1)" = "draws: elsewhere" ] || fail "--out is not heeded"

# Without matplotlib there is something to say; that it cannot be said is no failure of the run.
export BARCHAN_PYTHON=/bin/false
launch case.toml 2> /dev/full || fail "a full stderr: exit code $?"
launch case.toml 2>&- || fail "a closed stderr: exit code $?"
{ sleep 0.3; launch case.toml; echo $? > status; } 2>&1 | true
[ "$(cat status)" = 0 ] || fail "a reader that has gone: exit code $(cat status)"
said="$(launch case.toml 2>&1)"
[[ $said == *"no pictures"* && $said == *"warning: some pictures"* ]] || fail "it says '$said'"
status=0
said="$(MODE=stopped launch case.toml 2>&1)" || status=$?
[[ $status = 3 && $said != *"no pictures"* && $said == *"./barchan plot runs/case"* ]] || fail "stopped: '$said'"
mkdir -p runs/case && touch -d yesterday runs/case/run.json && touch runs/case/report.html
said="$(launch case.toml 2>&1)"
[[ $said != *pictures* ]] || fail "pictures newer than the run are drawn again: '$said'"
rm -r runs
status=0
bin/barchan nonsense 2> /dev/full || status=$?
[ "$status" -eq 2 ] || fail "an unknown command with a full stderr: exit code $status"

# A program that was killed: a word in run.json, which is not written through a link.
echo precious > victim
mkdir -p runs/case && ln -s "$dir/victim" runs/case/run.json.tmp
status=0
MODE=killed launch case.toml 2> said || status=$?
[ "$status" -eq 1 ] && grep -q "ended by SIGKILL" said || fail "killed: exit code $status: $(cat said)"
grep -q '"status": "failed"' runs/case/run.json && grep -q "ended by SIGKILL" runs/case/run.json ||
  fail "run.json of a killed run: $(cat runs/case/run.json)"
[ "$(cat victim)" = precious ] && [ "$(ls runs/case)" = run.json ] || fail "written through a link: $(cat victim)"

finish "launched: fine"
