# shellcheck shell=bash
# Sourced by script tests: $root, $python, a folder $dir that goes away with the test, a count of failures.
# shellcheck disable=SC2034  # for those scripts
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
python=/usr/bin/python3
[ -x "$python" ] || python=python3
python="${BARCHAN_PYTHON:-$python}"
export PYTHONDONTWRITEBYTECODE=1 PYTHONSAFEPATH=1
export PYTHONPATH="$root/python:$root/tests/support"
# The launcher takes the build that is tested, if that is one of its own.
preset="$(basename "$(dirname "$BARCHAN_PROGRAM")")"
[ "$root/build/$preset/barchan" != "$BARCHAN_PROGRAM" ] || export BARCHAN_PRESET="$preset"
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
failures=0

fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

finish() {  # finish WORDS: the end of a test; the words if all went well
  [ "$failures" = 0 ] && echo "$1"
  exit $((failures > 0))
}
