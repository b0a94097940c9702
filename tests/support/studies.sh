# shellcheck shell=bash
# Sourced by script tests of studies: in $dir, with $program and one thread.
# shellcheck source=tests/support/script.sh
. "$(dirname "${BASH_SOURCE[0]}")/script.sh"
program="${BARCHAN_PROGRAM:-$root/build/release/barchan}"
[ -x "$program" ] || { echo "no program at $program"; exit 77; }
cd "$dir" || exit 1
export OMP_NUM_THREADS="${BARCHAN_TEST_THREADS:-1}"

sweep() { "$python" -m barchan sweep "$program" "$@"; }
