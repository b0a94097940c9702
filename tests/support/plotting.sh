# shellcheck shell=bash
# Sourced by script tests that draw: $root, $python with the plotting modules (else skipped), a folder
# $dir that goes away with the test, a count of failures.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
python=/usr/bin/python3
[ -x "$python" ] || python=python3
python="${BARCHAN_PYTHON:-$python}"
"$python" -c 'import h5py, matplotlib, numpy' 2> /dev/null || { echo "no h5py or matplotlib"; exit 77; }
export PYTHONDONTWRITEBYTECODE=1
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failures=0

fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

fake() { "$python" "$root/tests/support/make_fake_run.py" "$@" || fail "make_fake_run $*"; }

programs=$PATH  # where plot finds ffmpeg, if any
plot() {  # plot EXPECTED_STATUS ARGUMENT...
  local expected=$1 status=0
  shift
  PATH="$programs" "$python" "$root/analysis/plot.py" "$@" > "$dir/out" 2> "$dir/err" || status=$?
  [ "$status" = "$expected" ] || fail "plot $* ended with $status, not $expected: $(cat "$dir/err")"
  ! grep -q Traceback "$dir/err" || fail "plot $* shows a traceback"
}

says() {  # says TEXT: somewhere on the error stream
  grep -qF -- "$1" "$dir/err" || fail "expected '$1', got '$(cat "$dir/err")'"
}

says_only() {  # says_only TEXT: the same, and nothing else
  says "$1"
  [ "$(wc -l < "$dir/err")" = 1 ] || fail "expected one line, got: $(cat "$dir/err")"
}
