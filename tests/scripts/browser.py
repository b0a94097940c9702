#!/usr/bin/python3
"""The page about a run in a real browser: it draws, its controls move the grains, it loads nothing from elsewhere, and
it fits a telephone as well as a desk. The last screenshot stays in BARCHAN_SCREENSHOTS, if that is set."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/support"))
import browser  # noqa: E402

# The picture of a canvas, and how many colours it has.
PROBE = """
const element = (id) => document.getElementById(id);
const picture = (id) => element(id).toDataURL();
const colours = (id) => {
  const canvas = element(id), data = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data;
  return new Set(new Uint32Array(data.buffer)).size;
};
const at = (value) => {
  element("scrubber").value = value;
  element("scrubber").dispatchEvent(new Event("input"));
  return [picture("top"), picture("side"), element("time").textContent];
};
await until(() => element("scrubber").value > 0 && colours("top") >= 10);
const end = at(16), start = at(0), again = at(16);
found.colours = [colours("top"), colours("side")];
found.moved = end.map((shown, i) => shown !== start[i]);
found.same_again = end.every((shown, i) => shown === again[i]);
found.curves = [...document.querySelectorAll(".plot svg")].map((plot) => plot.getBoundingClientRect().width);
"""

# A run in a notebook is a frame in a page, as high as what is in it.
IN_A_CELL = """
const frame = document.querySelector("iframe"), canvas = () => frame.contentDocument.getElementById("top");
const colours = () => {
  const data = canvas().getContext("2d").getImageData(0, 0, canvas().width, canvas().height).data;
  return new Set(new Uint32Array(data.buffer)).size;
};
const hidden = () => frame.contentDocument.documentElement.scrollHeight - frame.clientHeight;
await until(() => canvas() && colours() >= 10 && hidden() <= 1);
found.colours = colours();
found.hidden = hidden();
"""


def cell_problems(run, picture):
    """Of the run at the end of a notebook's cell."""
    page = run / "cell.html"
    show = "import sys, barchan; print(barchan.Run(sys.argv[1])._repr_html_())"
    shown = subprocess.run([sys.executable, "-c", show, run], check=True, capture_output=True, text=True).stdout
    page.write_text(f'<!DOCTYPE html><html><head><meta charset="utf-8"></head><body>{shown}</body></html>')
    found = browser.visit(page, IN_A_CELL, 800, 900, picture=picture)
    wrong = browser.problems("cell", found)
    if found["colours"] < 10 or found["hidden"] > 1:
        wrong.append(f"cell: {found['colours']} colours, {found['hidden']} pixels hidden")
    return wrong


def main():
    browser.chromium()
    kept = os.environ.get("BARCHAN_SCREENSHOTS")
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder) / "run"
        subprocess.run([sys.executable, ROOT / "tests/support/make_fake_run.py", run], check=True)
        subprocess.run([sys.executable, "-m", "barchan", "plot", run, "report"], check=True, stdout=subprocess.DEVNULL)
        for width, dark in ((1280, False), (1280, True), (400, False)):
            name = f"report-{width}{'-dark' if dark else ''}"
            picture = Path(kept or folder) / f"{name}.png"
            found = browser.visit(run / "report.html", PROBE, width, dark=dark, picture=picture)
            wrong += browser.problems(name, found)
            if min(found["colours"]) < 10:
                wrong.append(f"{name}: the grains are not drawn: {found['colours']} colours")
            if not all(found["moved"]) or not found["same_again"]:
                wrong.append(f"{name}: the scrubber does not move the grains: {found['moved']}, {found['same_again']}")
            if not found["curves"] or min(found["curves"]) < 100:
                wrong.append(f"{name}: the curves are {found['curves']} wide")
            if picture.stat().st_size < 20000:
                wrong.append(f"{name}: the screenshot is empty")
        wrong += cell_problems(run, Path(kept or folder) / "cell.png")
    print(*wrong or ["the page about a run works in a browser, wide and narrow, light and dark"], sep="\n")
    return len(wrong) > 0


if __name__ == "__main__":
    sys.exit(main())
