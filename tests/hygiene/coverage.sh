#!/usr/bin/env bash
# Which lines of kernels/ and src/ the tests reach: builds with the preset `coverage`, runs what
# `./barchan test` runs, and lists every file, the least reached first. Ends with 1 if a test fails or
# either folder is under 90 %. Arguments go to ctest; REPORT_ONLY=1 reads what the last run left.
# Lines by file are in build/coverage/lines.json, page by page in build/coverage/html/index.html.
# Needs (Debian) gcovr. The part for cuFFT is not compiled here and not counted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

build=build/coverage
command -v gcovr > /dev/null || { echo "coverage: no gcovr (Debian: gcovr)" >&2; exit 1; }
status=0
if [ "${REPORT_ONLY:-0}" = 0 ]; then
  if [ -d $build ]; then find $build -name '*.gcda' -delete; fi
  # One thread: counters are not locked, and lines are the same.
  BARCHAN_PRESET=coverage OMP_NUM_THREADS=1 ./barchan test --timeout 3600 "$@" || status=1
fi
mkdir -p $build/html
# Only our objects: gcov of a test would list its own lines, too, but what it inlines of ours counts.
gcovr --root . --filter kernels/ --filter src/ --gcov-executable "${GCOV:-gcov}" --object-directory $build \
  --exclude-unreachable-branches --exclude-throw-branches --json-summary $build/lines.json \
  --html-details $build/html/index.html -j "${JOBS:-1}" $build > $build/gcovr.log 2>&1 ||
  { tail -n 20 $build/gcovr.log >&2; exit 1; }
/usr/bin/env python3 - $build/lines.json <<'PYTHON' || status=1
import json, sys
files = json.load(open(sys.argv[1]))["files"]
short = False
for file in sorted(files, key=lambda f: f["line_percent"] or 0):
    print(f'{file["line_percent"] or 0:6.1f} %  {file["line_covered"]:5d} of {file["line_total"]:5d}  {file["filename"]}')
for folder in ("kernels", "src"):
    here = [f for f in files if f["filename"].startswith(folder + "/")]
    covered, total = (sum(f[k] for f in here) for k in ("line_covered", "line_total"))
    print(f"coverage: {folder}/ {100 * covered / max(total, 1):.1f} % of {total} lines in {len(here)} files")
    short = short or covered < 0.9 * total or total == 0
if short:
    sys.exit("coverage: under 90 %")
PYTHON
exit $status
