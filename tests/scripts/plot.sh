#!/usr/bin/env bash
# Figures of synthetic run folders: whole, flow only, cut short by a kill; and what bad input says.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

fake() { "$python" "$root/tests/support/make_fake_run.py" "$@" || fail "make_fake_run $*"; }

plot() {  # plot EXPECTED_STATUS ARGUMENT...
  local expected=$1 status=0
  shift
  "$python" "$root/analysis/plot.py" "$@" > "$dir/out" 2> "$dir/err" || status=$?
  [ "$status" = "$expected" ] || fail "plot $* ended with $status, not $expected: $(cat "$dir/err")"
  ! grep -q Traceback "$dir/err" || fail "plot $* shows a traceback"
}

is_picture() {  # a PNG under 300 kB
  [ "$(head -c 4 "$1" 2> /dev/null | tail -c 3)" = PNG ] || { fail "no picture $1"; return; }
  [ "$(wc -c < "$1")" -lt 300000 ] || fail "$1 is larger than 300 kB"
  [ "$(wc -c < "$1")" -gt 5000 ] || fail "$1 looks empty"
}

says() {  # says TEXT: one line on the error stream, with this text in it
  grep -qF -- "$1" "$dir/err" || fail "expected '$1', got '$(cat "$dir/err")'"
  [ "$(wc -l < "$dir/err")" = 1 ] || fail "expected one line, got: $(cat "$dir/err")"
}

fake "$dir/whole"
plot 0 "$dir/whole"
for figure in topviews height_map morphology midplane profiles history horns horn_origins; do is_picture "$dir/whole/$figure.png"; done
[ ! -s "$dir/err" ] || fail "a whole run draws without warnings, but: $(cat "$dir/err")"
[ -s "$dir/whole/report.html" ] || fail "no report of a whole run"
[ "$(wc -l < "$dir/out")" = "$(find "$dir/whole" -name '*.p[nd][gf]' -o -name report.html | wc -l)" ] || fail "each picture is named on a line of its own"
for curves in height_map morphology history; do
  [ "$(wc -l < "$dir/whole/figures_data/$curves.csv")" -gt 20 ] || fail "no curves of $curves"
done

fake "$dir/flow" --without grains --without tables
plot 0 "$dir/flow"
is_picture "$dir/flow/midplane.png"
[ ! -e "$dir/flow/topviews.png" ] || fail "no grains, but a picture of them"

fake "$dir/cut" --cut --without fields
plot 0 "$dir/cut" morphology height_map --pdf
is_picture "$dir/cut/morphology.png"
is_picture "$dir/cut/height_map.png"
[ "$(head -c 4 "$dir/cut/morphology.pdf")" = %PDF ] || fail "no PDF"

plot 2 "$dir/flow" profiles
says "profiles needs statistics.csv"
plot 2 "$dir/cut" midplane
says "midplane needs fields.h5"
plot 2 "$dir/nowhere"
says "no such run folder: $dir/nowhere"
plot 2 "$dir/whole/run.json"
says "not a run folder"
plot 2 "$dir/whole" topview
says 'did you mean "topviews"?'
plot 2 "$dir/whole" zzz
says 'no figure "zzz"; figures: topviews'
mkdir "$dir/empty"
plot 2 "$dir/empty"
says "nothing to draw in $dir/empty"
echo "not HDF5" > "$dir/empty/grains.h5"
plot 2 "$dir/empty" topviews
says "cannot read $dir/empty/grains.h5"

[ "$failures" = 0 ] && echo "all figures as expected"
exit $((failures > 0))
