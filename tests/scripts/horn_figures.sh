#!/usr/bin/env bash
# Horn grains, their origins and the force map of synthetic runs in which all of these are known: a dune
# along the axes, turned, across the periodic boundaries, with and without tracks.h5.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

make_run() { "$python" "$root/tests/support/make_horn_run.py" "$@" || fail "make_horn_run $*"; }

check() { "$python" "$root/tests/support/check_horn_run.py" "$@" || fail "check $*"; }

make_run "$dir/straight"
plot 0 "$dir/straight" fig11 horns fig13 sectors morphology
quiet
is_figure "$dir/straight/fig11"
is_figure "$dir/straight/fig13"
[ -s "$dir/straight/horns.png" ] || fail "no picture of the horns"
grep -q '80.0 % from 105-160 and 210-260 degrees (uniform 29.2 %' "$dir/out" || fail "no line on sectors"
grep -q -- '-1e-07 N on the crest (-), -1e-07 N between the horns (-)' "$dir/out" || fail "no line on forces"
check "$dir/straight" shape straight origins numbers force

make_run "$dir/turned" --angle 8 --seam --tracks --program-map --until 3
plot 0 "$dir/turned" horn-origins horns fig13 sectors morphology --time 3
quiet
check "$dir/turned" shape origins numbers map
refused "force_map needs a frame with forces between t = 7 s and 8 s" "$dir/turned" force-map --from 7 --to 8
refused "fig12 needs a dune with horns: none is longer than 2.5 grain diameters up to t = 1 s" "$dir/turned" fig12 --time 1

make_run "$dir/alone" --angle -5 --seam
plot 0 "$dir/alone" horns force-map --from 0 --to 1
quiet
plot 0 "$dir/alone" sectors
quiet
check "$dir/alone" numbers force_100
refused "no frame at or before t = -1 s" "$dir/alone" sectors --time -1
rm "$dir/alone/grains.h5"
refused 'no figure "fig_14"' "$dir/alone" fig-14
refused "fig13 needs force_map.csv, or grains.h5 with force_total" "$dir/alone" fig13
refused "horns needs grains.h5 with at least one frame" "$dir/alone" horns

make_run "$dir/tableless" --without table
refused "horns needs dune.csv with the main dune" "$dir/tableless" horns

make_run "$dir/old" --without dune --tracks
refused "horns needs frames that say which dune each grain is of (output.dune_interval > 0); runs of an earlier version" "$dir/old" horns

finish "horn grains, origins and forces as known"
