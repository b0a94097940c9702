#!/usr/bin/python3
"""The site of the documentation: it is built without a warning, every page is in its navigation, every link leads to a
page and a heading, nothing is loaded from elsewhere; in a browser formulas are typeset, the search finds words, and
pages fit a telephone. Screenshots stay in BARCHAN_SCREENSHOTS, if that is set."""
import html.parser
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path
from urllib.parse import unquote

ROOT = Path(__file__).resolve().parents[2]
SITE = ROOT / "build/site-tested"  # has the address of a clone that is public
sys.path.insert(0, str(ROOT / "tests/support"))
import browser  # noqa: E402

LOADED = {"script": "src", "img": "src", "video": "src", "source": "src", "iframe": "src"}
FORMULAS = """
const all = document.querySelectorAll(".arithmatex");
await until(() => all.length && [...all].every((one) => one.querySelector(".mjx-chtml")));
found.formulas = all.length;
found.typeset = [...all].filter((one) => one.querySelector(".mjx-chtml")).length;
found.errors = document.querySelectorAll(".mjx-merror, .merror").length;
"""
# A word that no page has empties the list, so that what is seen after it belongs to the word typed next. A word typed
# before the search listens is typed again.
SEARCH = """
const field = document.querySelector("[data-md-component=search-query]");
const links = () => [...document.querySelectorAll(".md-search-result__link")];
const type = (word) => {
  field.value = word;
  field.dispatchEvent(new Event("input", { bubbles: true }));
  field.dispatchEvent(new KeyboardEvent("keyup", { bubbles: true }));
};
document.getElementById("__search").checked = true;
field.focus();
found.results = {};
for (const word of WORDS) {
  let seen = false;
  for (let tries = 0; tries < 5 && !seen; ++tries) {
    type("qqqqq");
    await until(() => !links().length, 5);
    type(word);
    seen = await until(() => links().length, 5);
  }
  if (!seen) break;
  found.results[word] = links().map((link) => link.getAttribute("href").replace(/^.*\\/|[?#].*$/g, ""));
}
document.getElementById("__search").checked = false;
"""
# What users type, and a page that answers it among the first ANSWERS pages found.
WORDS = {"restitution": "keys", "resume": "cluster", "cite": "index", "STL": "field", "macOS": "install",
         "Windows": "install", "time step too large": "troubleshooting", "checkpoint": "cluster", "obstacle": "field",
         "ParaView": "results", "horn length": "dune-measures", "GPU": "install"}
ANSWERS = 5
PUBLIC = "https://git.example/barchan/barchan"


class Page(html.parser.HTMLParser):
    """The links, headings and loaded files of a page."""

    def __init__(self, path):
        super().__init__()
        self.links, self.anchors, self.loaded = [], set(), []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attrs):
        said = dict(attrs)
        self.anchors |= {said.get("id"), said.get("name")}
        if tag == "a" and said.get("href"):
            self.links.append(said["href"])
        if tag in LOADED and said.get(LOADED[tag]):
            self.loaded.append(said[LOADED[tag]])
        if tag == "link" and said.get("rel") != "canonical" and said.get("href"):
            self.loaded.append(said["href"])


def check_links(wrong):
    pages = {path: Page(path) for path in SITE.rglob("*.html") if path.name != "404.html"}
    for path, page in pages.items():
        name = path.relative_to(SITE)
        for target in page.loaded:
            if "://" in target:
                wrong.append(f"{name} loads {target}")
            elif not (path.parent / unquote(target)).exists():
                wrong.append(f"{name} loads {target}, which is not there")
        for target in page.links:
            if "://" in target or target.startswith("mailto:"):
                continue
            file, _, heading = unquote(target).partition("#")
            to = (path.parent / file).resolve() if file else path
            if to.is_dir():
                to /= "index.html"
            if not to.exists():
                wrong.append(f"{name} links to {target}, which is not there")
            elif heading and to in pages and heading not in pages[to].anchors:
                wrong.append(f"{name} links to {target}; there is no such heading")
    return len(pages)


def check_in_browser(wrong, kept):
    def visit(page, probe, width=1280, dark=False):
        name = f"site-{page}-{width}{'-dark' if dark else ''}"
        picture = Path(kept) / f"{name}.png" if kept else None
        found = browser.visit(SITE / f"{page}.html", probe, width, dark=dark, picture=picture)
        wrong.extend(browser.problems(name, found))
        return found

    for page, width, dark in (("theory", 1280, False), ("theory-coupling", 400, True)):
        found = visit(page, FORMULAS, width, dark)
        if not found["formulas"] or found["typeset"] != found["formulas"] or found["errors"]:
            counts = f"{found['typeset']} of {found['formulas']} formulas, {found['errors']} errors"
            wrong.append(f"{page}: typeset are {counts}")
    results = visit("index", SEARCH.replace("WORDS", str(list(WORDS))))["results"]
    for word, page in WORDS.items():
        first = list(dict.fromkeys(results.get(word, [])))[:ANSWERS]
        if f"{page}.html" not in first:
            wrong.append(f"the search for {word} finds {first}, not {page}.html")
    for page in ("index", "first-dune", "files", "validation"):
        visit(page, "", 400)
    if kept:
        visit("index", "", 1280, True)
        visit("keys", "", 400)


def build():
    known = {"GIT_CONFIG_COUNT": "1", "GIT_CONFIG_KEY_0": "remote.origin.url", "GIT_CONFIG_VALUE_0": PUBLIC}
    made = subprocess.run([sys.executable, ROOT / "scripts/build_site.py"], capture_output=True, text=True, check=False,
                          env=os.environ | known | {"BARCHAN_SITE": str(SITE)})
    if made.returncode:
        sys.exit(made.stdout + made.stderr)


def check_address(wrong):
    """Where the address is known, pages have links to edit them, and the front page says what to clone."""
    for page, source in (("index", "README.md"), ("keys", "docs/keys.md"), ("dev/scaling", "docs/dev/scaling.md"),
                         ("notebooks/laws", "notebooks/laws.ipynb")):
        text = (SITE / f"{page}.html").read_text()
        if f'href="{PUBLIC}/edit/main/{source}"' not in text:
            wrong.append(f"{page}.html has no link to edit {source}")
    if f"git clone {PUBLIC} barchan" not in re.sub(r"<[^>]*>", "", (SITE / "index.html").read_text()):
        wrong.append("the front page does not say where to clone from")


def main():
    if shutil.which("mkdocs") is None:
        print("no mkdocs: ./barchan setup --docs")
        return 1 if os.environ.get("CI") == "true" else browser.SKIPPED
    wrong = []
    build()
    check_address(wrong)
    n = check_links(wrong)
    check_in_browser(wrong, os.environ.get("BARCHAN_SCREENSHOTS"))
    print(*wrong or [f"{n} pages of the site as they should be"], sep="\n")
    return len(wrong) > 0


if __name__ == "__main__":
    sys.exit(main())
