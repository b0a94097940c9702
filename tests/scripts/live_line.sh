#!/usr/bin/env bash
# On a terminal a run keeps one live line, cut to the width and written over; the log stays free of it, and
# --quiet shows none.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
dir="$(mktemp -d)"
trap 'rm -rf "$dir"' EXIT
fail() { echo "FAILED: $*"; cat -v "$dir/shown"; exit 1; }
show() {  # show ARGUMENT...: a run of a second or more
  python3 "$root/tests/support/on_terminal.py" "$BARCHAN_PROGRAM" run "$root/tests/support/small_dune.toml" \
    --set time.end=0.8 --threads 1 --out "$dir/run" "$@" > "$dir/shown"
}

show || fail "exit code $?"
clear=$'\r\033[K'
# What stands between two clearings without a line end is a live line.
read -r pieces longest < <(python3 - "$dir/shown" << 'PYTHON'
import sys
pieces = open(sys.argv[1], newline="", encoding="utf-8").read().split("\r\033[K")[1:-1]
lengths = [len(p) for p in pieces if "\n" not in p]
print(len(lengths), max(lengths, default=0))
PYTHON
)
[ "$longest" -gt 20 ] && [ "$longest" -lt 40 ] || fail "a live line of $longest characters on 40 columns"
tail -c 2 "$dir/shown" | cmp -s - <(printf '\r\n') || fail "what follows would stand in the live line"
if grep -q $'[\r\033]' "$dir/run/log.txt"; then fail "log.txt has control characters"; fi

show --quiet || fail "exit code $? with --quiet"
if grep -q -F "$clear" "$dir/shown"; then fail "--quiet has a live line"; fi
echo "live line: $pieces lines were written over"
