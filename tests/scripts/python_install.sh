#!/usr/bin/env bash
# The Python package as a wheel, built and installed without a network in an environment that has only Debian's packages.
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
dir="$(mktemp -d)"
trap 'rm -rf "$dir"' EXIT
fail() { echo "python_install: $*" >&2; exit 1; }
unset PYTHONPATH PYTHONSAFEPATH
cd "$dir"

cp -r "$root/python" source  # building leaves folders in the source
/usr/bin/python3 -m venv --system-site-packages there
there/bin/pip wheel --quiet --no-index --no-build-isolation --no-deps --wheel-dir wheels ./source > log 2>&1 ||
  fail "no wheel: $(tail -n 5 log)"
there/bin/pip install --quiet --no-index --no-deps wheels/*.whl > log 2>&1 || fail "not installed: $(tail -n 5 log)"

/usr/bin/python3 - wheels/*.whl "$root/python" << 'END' || fail "the wheel lacks files or has some too many"
import pathlib, sys, zipfile
held = {name for name in zipfile.ZipFile(sys.argv[1]).namelist() if ".dist-info/" not in name}
folder = pathlib.Path(sys.argv[2])
ours = {str(path.relative_to(folder)) for path in (folder / "barchan").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts}
print(*(f"{name}\n" for name in sorted(held ^ ours)))
sys.exit(held != ours)
END

/usr/bin/python3 "$root/tests/support/make_fake_run.py" "$dir/run" > /dev/null
there/bin/python - "$dir" << 'END' || fail "the installed package does not read a run"
import sys, barchan
assert barchan.__file__.startswith(sys.argv[1] + "/there/"), barchan.__file__
run = barchan.open(sys.argv[1] + "/run")
assert len(run.grains(t=1.0)) > 1000 and run.dunes.attrs["units"]["W"] == "m"
run.figure("morphology").savefig(sys.argv[1] + "/morphology.png")
import xarray
assert xarray.open_dataset(sys.argv[1] + "/run/fields.h5", engine="barchan").u.dims == ("time", "z", "y", "x")
END
[ -s morphology.png ] || fail "no picture"
there/bin/barchan-plot run topviews > log 2>&1 || fail "barchan-plot: $(tail -n 5 log)"
[ -s run/topviews.png ] || fail "barchan-plot draws nothing"
echo 'import barchan' > careful.py
there/bin/python -W error careful.py || fail "importing it warns"
