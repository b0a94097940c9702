#!/usr/bin/env bash
# Horn grains, their origins and the force map of synthetic runs in which all of these are known: a dune
# along the axes, turned, across the periodic boundaries, with and without tracks.h5 and dune.csv.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

quiet() { [ ! -s "$dir/err" ] || fail "warnings: $(cat "$dir/err")"; }

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
plot 2 "$dir/turned" force-map --from 7 --to 8
says "force_map needs a frame with forces between t = 7 s and 8 s"
plot 2 "$dir/turned" fig12 --time 1
says "fig12 needs a dune with horns: none is longer than 2.5 grain diameters up to t = 1 s"

make_run "$dir/alone" --angle -5 --seam --without table
plot 0 "$dir/alone" horns force-map --from 0 --to 1
quiet
plot 0 "$dir/alone" sectors
quiet
check "$dir/alone" numbers force_100
plot 2 "$dir/alone" sectors --time -1
says "no frame at or before t = -1 s"
rm "$dir/alone/grains.h5"
plot 2 "$dir/alone" fig-14
says 'no figure "fig_14"'
plot 2 "$dir/alone" fig13
says "fig13 needs force_map.csv, or grains.h5 with force_total"
plot 2 "$dir/alone" horns
says "horns needs grains.h5 with at least one frame"

make_run "$dir/old" --without dune --tracks
plot 2 "$dir/old" horns
says "horns needs frames that say which dune each grain is of (output.dune_interval > 0); runs of an earlier version"

[ "$failures" = 0 ] && echo "horn grains, origins and forces as known"
exit $((failures > 0))
