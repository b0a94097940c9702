#!/usr/bin/env bash
# Broken and absurd input, 109 entries: each ends with one clear message, the right exit code and nothing written.
# --only TEXT, --show: tests/bad_input/run.py.
set -u
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
program="${BARCHAN_PROGRAM:-$root/build/release/barchan}"
python="${BARCHAN_PYTHON:-/usr/bin/python3}"
"$python" -c 'import h5py, numpy' 2> /dev/null || { echo "$python has no h5py"; exit 77; }
PYTHONDONTWRITEBYTECODE=1 exec "$python" "$root/tests/bad_input/run.py" "$program" "$@"
