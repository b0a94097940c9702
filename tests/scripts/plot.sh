#!/usr/bin/env bash
# Figures of synthetic run folders: whole, flow only, cut short by a kill; and what bad input says.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

fake "$dir/whole"
plot 0 "$dir/whole"
for figure in topviews height_map morphology midplane profiles history horns horn_origins morphodynamics; do is_picture "$dir/whole/$figure.png"; done
quiet
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

refused "profiles needs statistics.csv" "$dir/flow" profiles
refused "midplane needs fields.h5" "$dir/cut" midplane
refused "no such run folder: $dir/nowhere" "$dir/nowhere"
refused "not a run folder" "$dir/whole/run.json"
refused 'did you mean "topviews"?' "$dir/whole" topview
refused 'no figure "zzz"; figures: topviews' "$dir/whole" zzz
mkdir "$dir/empty"
refused "nothing to draw in $dir/empty" "$dir/empty"
echo "not HDF5" > "$dir/empty/grains.h5"
refused "cannot read $dir/empty/grains.h5" "$dir/empty" topviews

finish "all figures as expected"
