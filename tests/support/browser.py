"""A real browser without a screen (Chromium), driven by a script that is added to a copy of a page."""
import html
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
# What a page has done wrong is collected from the start; what the probe finds is written into the page's text.
BEFORE = """<script>
window.faults = [];
addEventListener("error", (event) =>
  faults.push(event.message || `cannot load ${event.target.src || event.target.href}`), true);
addEventListener("unhandledrejection", (event) => faults.push(String(event.reason)));
</script>
"""
AFTER = """<script>
addEventListener("load", async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const found = {};
  try { await (async () => { PROBE })(); } catch (error) { faults.push(`probe: ${error}`); }
  found.too_wide = document.documentElement.scrollWidth - innerWidth;
  found.from_elsewhere = performance.getEntriesByType("resource").map((entry) => entry.name)
    .filter((name) => name.startsWith("http"));
  found.faults = faults;
  const text = document.createElement("pre");
  text.id = "found-by-probe";
  text.textContent = JSON.stringify(found);
  document.body.append(text);
});
</script>
"""


def chromium():
    """The browser. Where there is none the test is skipped, or fails in continuous integration."""
    found = shutil.which("chromium") or shutil.which("google-chrome")
    if found is None:
        print("no chromium (Debian package chromium)")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    return found


def visit(page, probe, width=1280, height=1600, dark=False, picture=None):
    """What `probe` (JavaScript that fills `found`) finds in the page, with `faults`, `too_wide` (pixels that the page
    is wider than the window) and `from_elsewhere` (what it loads by http). picture: where to put a screenshot."""
    page = Path(page)
    text = page.read_text()
    copy = page.with_name(f"probed-{page.name}")
    copy.write_text(re.sub(r"<head>", lambda head: head[0] + BEFORE, text, count=1)
                    .replace("</body>", AFTER.replace("PROBE", probe) + "</body>"))
    with tempfile.TemporaryDirectory() as profile:
        common = [chromium(), "--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
                  f"--user-data-dir={profile}", f"--window-size={width},{height}", "--virtual-time-budget=20000",
                  f"--blink-settings=preferredColorScheme={0 if dark else 1}"]
        try:
            dump = subprocess.run([*common, "--dump-dom", copy.as_uri()], capture_output=True, text=True, timeout=120,
                                  check=True).stdout
            if picture:
                subprocess.run([*common, f"--screenshot={picture}", page.as_uri()], capture_output=True, timeout=120,
                               check=True)
        finally:
            copy.unlink()
    said = re.search(r'<pre id="found-by-probe">(.*?)</pre>', dump, re.S)
    if said is None:
        raise AssertionError(f"{page}: the probe has not come to its end")
    return json.loads(html.unescape(said[1]))


def problems(name, found):
    """What no page of ours may do, as sentences."""
    told = [f"{name}: {what}: {found[what]}" for what in ("faults", "from_elsewhere") if found[what]]
    if found["too_wide"] > 0:
        told.append(f"{name}: {found['too_wide']} pixels wider than the window")
    return told
