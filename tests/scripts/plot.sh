#!/usr/bin/env bash
# Figures of synthetic run folders: whole, flow only, cut short by a kill; and what bad input says.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

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
says_only "profiles needs statistics.csv"
plot 2 "$dir/cut" midplane
says_only "midplane needs fields.h5"
plot 2 "$dir/nowhere"
says_only "no such run folder: $dir/nowhere"
plot 2 "$dir/whole/run.json"
says_only "not a run folder"
plot 2 "$dir/whole" topview
says_only 'did you mean "topviews"?'
plot 2 "$dir/whole" zzz
says_only 'no figure "zzz"; figures: topviews'
mkdir "$dir/empty"
plot 2 "$dir/empty"
says_only "nothing to draw in $dir/empty"
echo "not HDF5" > "$dir/empty/grains.h5"
plot 2 "$dir/empty" topviews
says_only "cannot read $dir/empty/grains.h5"

[ "$failures" = 0 ] && echo "all figures as expected"
exit $((failures > 0))
