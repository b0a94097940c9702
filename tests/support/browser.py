"""A real browser without a screen (Chromium), which looks at a page as a reader does, in real time."""
import atexit
import base64
import functools
import itertools
import json
import os
import select
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SKIPPED = 77
# Seconds that one thing looked for in a page may take on a busy machine, and that the whole page may take.
LIMIT, PATIENCE = 50, 150
# What a page has done wrong is collected from the start.
BEFORE = """
window.faults = [];
addEventListener("error", (event) =>
  faults.push(event.message || `cannot load ${event.target.src || event.target.href}`), true);
addEventListener("unhandledrejection", (event) => faults.push(String(event.reason)));
"""
PROBE = """(async () => {
  const found = {}, wait = (ms) => new Promise((done) => setTimeout(done, ms));
  const until = async (met, seconds = LIMIT) => {
    for (const start = performance.now(); performance.now() - start < 1000 * seconds; await wait(50))
      if (met()) return true;
    return false;
  };
  await until(() => document.readyState === "complete");
  try { await (async () => { PROBE })(); } catch (error) { faults.push(`probe: ${error}`); }
  found.too_wide = document.documentElement.scrollWidth - innerWidth;
  found.from_elsewhere = performance.getEntriesByType("resource").map((entry) => entry.name)
    .filter((name) => name.startsWith("http"));
  found.faults = faults;
  return found;
})()
"""


def chromium():
    """The browser. Where there is none the test is skipped, or fails in continuous integration."""
    found = shutil.which("chromium") or shutil.which("google-chrome")
    if found is None:
        print("no chromium (Debian package chromium)")
        sys.exit(1 if os.environ.get("CI") == "true" else SKIPPED)
    return found


class Silent(Exception):
    """The browser has ended or hangs, whatever the page is."""


class Chromium:
    """A running browser that is spoken to in the DevTools protocol, over a pair of pipes."""

    def __init__(self, profile):
        # Shared memory is small in many containers, and ranks of MPI fill it.
        command = [chromium(), "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                   "--hide-scrollbars", "--no-first-run", f"--user-data-dir={profile}", "--remote-debugging-pipe"]
        # The browser reads from file 3 and writes into file 4.
        self.process = subprocess.Popen(["sh", "-c", 'exec "$@" 3<&0 4>&1 >/dev/null', "sh", *command],
                                        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
        self.numbers, self.heard, self.session = itertools.count(1), b"", {}

    def open_tab(self):
        self.session = {}
        target = self.ask("Target.createTarget", url="about:blank")["targetId"]
        self.session = {"sessionId": self.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]}

    def end(self):
        self.process.kill()
        self.process.communicate()

    def message(self, deadline):
        """The next message of the browser."""
        while b"\0" not in self.heard:
            if not select.select([self.process.stdout], [], [], max(0, deadline - time.monotonic()))[0]:
                raise Silent(f"the browser has said nothing for {PATIENCE} s")
            more = os.read(self.process.stdout.fileno(), 1 << 16)
            if not more:
                raise Silent("the browser has ended")
            self.heard += more
        first, _, self.heard = self.heard.partition(b"\0")
        return json.loads(first)

    def ask(self, method, **params):
        """The answer to one request."""
        number, deadline = next(self.numbers), time.monotonic() + PATIENCE
        request = {"id": number, "method": method, "params": params} | self.session
        self.process.stdin.write(json.dumps(request).encode() + b"\0")
        self.process.stdin.flush()
        while True:
            said = self.message(deadline)
            if said.get("method") == "Inspector.targetCrashed":
                raise Silent("the page's process has crashed")
            if said.get("id") == number:
                if "error" in said:
                    raise AssertionError(f"{method}: {said['error']}")
                return said["result"]


@functools.cache
def running():
    """The browser of all pages; it ends with the test."""
    profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
    atexit.register(profile.cleanup)
    browser = Chromium(profile.name)
    atexit.register(browser.end)
    return browser


def visit(page, probe, width=1280, height=1600, dark=False, picture=None):
    """What `probe` (JavaScript that fills `found`) finds in the page, with `faults`, `too_wide` (pixels that the page
    is wider than the window) and `from_elsewhere` (what it loads by http). The probe waits with `await until(() =>
    ...)`, which says whether it came, for what a page does after it is loaded. picture: where to put a screenshot. A
    browser that hangs or ends is started once more."""
    try:
        return look(page, probe, width, height, dark, picture)
    except Silent as why:
        print(f"{page}: {why}; once more")
        running().end()
        running.cache_clear()
    try:
        return look(page, probe, width, height, dark, picture)
    except Silent as why:
        raise AssertionError(f"{page}: {why}, twice") from why


def look(page, probe, width, height, dark, picture):
    browser = running()
    browser.open_tab()
    scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
    browser.ask("Page.enable")
    browser.ask("Inspector.enable")
    browser.ask("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
    browser.ask("Emulation.setFocusEmulationEnabled", enabled=True)
    browser.ask("Emulation.setEmulatedMedia", features=[scheme])
    browser.ask("Page.addScriptToEvaluateOnNewDocument", source=BEFORE)
    browser.ask("Page.navigate", url=Path(page).resolve().as_uri())
    text = PROBE.replace("PROBE", probe).replace("LIMIT", str(LIMIT))
    said = browser.ask("Runtime.evaluate", expression=text, awaitPromise=True, returnByValue=True)
    if "exceptionDetails" in said:
        raise AssertionError(f"{page}: {said['exceptionDetails']}")
    if picture:
        Path(picture).write_bytes(base64.b64decode(browser.ask("Page.captureScreenshot")["data"]))
    browser.ask("Page.close")
    return said["result"]["value"]


def problems(name, found):
    """What no page of ours may do, as sentences."""
    told = [f"{name}: {what}: {found[what]}" for what in ("faults", "from_elsewhere") if found[what]]
    if found["too_wide"] > 0:
        told.append(f"{name}: {found['too_wide']} pixels wider than the window")
    return told
