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
