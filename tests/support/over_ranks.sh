# shellcheck shell=bash
# Sourced by scripts that run a case over several ranks: a folder to work in, run RANKS CASE ARGUMENT..., fail.
command -v mpirun > /dev/null || { echo "no mpirun"; exit 77; }
# shellcheck disable=SC2034  # for those scripts
support="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT
cd "$work" || exit
export OMP_NUM_THREADS="${BARCHAN_TEST_THREADS:-1}" OMP_PROC_BIND=false
options=(--quiet --bind-to none --oversubscribe)
[ "$(id -u)" -ne 0 ] || options+=(--allow-run-as-root)

fail() { echo "FAILED: $*"; exit 1; }
run() {  # run RANKS CASE ARGUMENT...
  local ranks=$1
  shift
  if [ "$ranks" -eq 1 ]; then
    "$BARCHAN_PROGRAM" run --quiet "$@"
  else
    mpirun "${options[@]}" -np "$ranks" "$BARCHAN_PROGRAM" run --quiet "$@"
  fi
}
