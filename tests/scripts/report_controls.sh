#!/usr/bin/env bash
# The controls of the page about a run move the grains and the markers on its curves.
set -u
export NODE_PATH=/usr/share/nodejs
node -e 'require("jsdom")' 2> /dev/null || { echo "SKIPPED: no jsdom (Debian packages nodejs and node-jsdom)"; exit 77; }
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

fake "$dir/run"
fake "$dir/names" --heaps --bodies
fake "$dir/clumps" --clumps
for kind in run names clumps; do
  plot 0 "$dir/$kind" report
  node "$root/tests/support/drive_report.js" "$dir/$kind/report.html" || fail "the page's controls: $kind"
done

[ "$failures" = 0 ] && echo "all controls as expected"
exit $((failures > 0))
