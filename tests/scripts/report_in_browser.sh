#!/usr/bin/env bash
# The page about a run in a browser without a screen: its controls move the grains and the markers.
# Chromium is 300 MB with what it needs, so the project does not install it: skipped where it is missing.
set -u
browser=""
for name in chromium chromium-browser google-chrome chrome-headless-shell; do
  if [ -z "$browser" ]; then browser="$(command -v "$name" || true)"; fi
done
[ -n "$browser" ] || { echo "SKIPPED: no Chromium on this machine (Debian package chromium)"; exit 77; }
# shellcheck source=tests/support/plotting.sh
. "$(dirname "${BASH_SOURCE[0]}")/../support/plotting.sh"

"$python" "$root/tests/support/make_fake_run.py" "$dir/run" || fail "make_fake_run"
"$python" "$root/analysis/plot.py" "$dir/run" report > /dev/null || fail "no report"
{
  sed '/^<\/html>/d' "$dir/run/report.html"
  echo "<script>"
  cat "$root/tests/support/drive_report.js"
  echo "</script></html>"
} > "$dir/driven.html"

load() {  # load SCHEME_NUMBER SIZE: the page after its script has driven it
  timeout 120 "$browser" --headless=new --no-sandbox --disable-gpu --user-data-dir="$dir/profile" \
    --window-size="$2" --blink-settings=preferredColorScheme="$1" --virtual-time-budget=8000 \
    --dump-dom "file://$dir/driven.html" 2> "$dir/err"
}

for look in "1 1280,900" "0 500,900"; do  # light and wide, dark and narrow
  # shellcheck disable=SC2086  # two words
  load $look > "$dir/dom.html"
  verdict="$(sed -n 's/.*<pre id="verdict">\(.*\)<\/pre>.*/\1/p' "$dir/dom.html")"
  [ "$verdict" = "all as expected" ] ||
    fail "($look) ${verdict:-the page did not run: $(tail -n 3 "$dir/err")}"
done

[ "$failures" = 0 ] && echo "the page works in $("$browser" --version 2> /dev/null)"
exit $((failures > 0))
