#!/usr/bin/env bash
# The page about a run: what it says of synthetic runs, whole, flow only, and broken with hostile text.
set -u
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

report() {  # report KIND FAKE_ARGUMENT...: a run folder of that name, its page, and what is in it
  local kind=$1
  shift
  fake "$dir/$kind" "$@"
  if [ "$kind" = nasty ]; then cp "$dir/nasty.json" "$dir/nasty/run.json"; fi
  plot 0 "$dir/$kind" report
  [ "$(cat "$dir/out")" = "$dir/$kind/report.html" ] || fail "$kind: said '$(cat "$dir/out")'"
  quiet
  "$python" "$root/tests/support/check_report.py" "$dir/$kind" "$kind" || fail "the page about $kind"
}

# Every number past its limit, or not finite (null); the title tries to leave its place.
cat > "$dir/nasty.json" << 'END'
{"status": "failed", "message": "CFL <1.2> is above 1",
 "title": "A </script><script>alert(1)</script> & \"dune\" {{css}}",
 "version": "0.0", "git_hash": "<none>", "max_cfl": 1.2, "max_continuity_residual": 10.0, "max_overlap": null,
 "pressure_iterations_max": 200, "grains_initial": 100, "grains_inside": 90, "grains_left": 9,
 "ledger": {"largest_volume_mismatch": 1e-13, "largest_exchange_mismatch": -1e-3}, "phases": {"<b>": 0.1}}
END

report whole
report flow --without grains
report nasty --cut --without tables

mkdir "$dir/empty"
refused "report needs" "$dir/empty" report

finish "all pages as expected"
