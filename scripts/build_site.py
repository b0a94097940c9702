#!/usr/bin/python3
"""Builds the site of the documentation in build/site: ./barchan docs. Needs Debian's MkDocs and Material; no network.

The pages are those of docs/, the texts beside README.md, which is the front page, and the notebooks with their
outputs. They are gathered in build/site-pages with every link as the site needs it, and with the files that they link
to. A warning of MkDocs, such as a link to nothing, is an error. Pages of a clone from a public address have a link to
edit them there.
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import nbconvert

ROOT = pathlib.Path(__file__).resolve().parents[1]
PAGES = ROOT / "build/site-pages"
SITE = pathlib.Path(os.environ.get("BARCHAN_SITE", ROOT / "build/site"))
NEW = SITE.with_name(SITE.name + "-new")  # takes its place when it is whole
TEXTS = {name: name.lower() for name in ("ARCHITECTURE.md", "CONTRIBUTING.md", "CHANGELOG.md")}
TEXTS["README.md"] = "index.md"
WIDE = "template: home.html\nhide:\n  - navigation\n  - toc\n"  # the front page
MATHJAX = pathlib.Path("/usr/share/javascript/mathjax")
FONTS = pathlib.Path("/usr/share/fonts/opentype/inter")
OF_FONTS = "Inter-Regular.otf", "Inter-Italic.otf", "Inter-SemiBold.otf"
OF_MATHJAX = ("MathJax.js", "extensions/tex2jax.js", "extensions/TeX", "extensions/MathEvents.js", "jax/input/TeX",
              "jax/element", "jax/output/CommonHTML", "fonts/HTML-CSS/TeX/woff")
LINK = re.compile(r"(!?\[(?:[^\]\[]|\[[^\]]*\])*\]\()([^)\s#]+)(#[^)\s]*)?\)")
CODE = re.compile(r"(```.*?```|`[^`\n]*`)", re.S)


def address():
    """Where this clone came from, if that is public, else an empty text."""
    asked = subprocess.run(["git", "config", "remote.origin.url"], cwd=ROOT, capture_output=True, text=True,
                           check=False)
    return asked.stdout.strip().removesuffix(".git") if asked.stdout.startswith("https://") else ""


def target_on_site(target, folder, page):
    """Where a link of a page in `folder` of the repository leads on the site; copies a file that is no page."""
    if "://" in target or target.startswith("mailto:"):
        return target
    path = pathlib.Path(os.path.normpath(folder / target))
    name = str(path)
    if name in TEXTS:
        return TEXTS[name]
    if path.parts[0] == "notebooks" and path.suffix == ".ipynb":
        return f"{name.removesuffix('.ipynb')}.md"
    if path.parts[0] == "docs":
        return path.name if path.parts[1] == "site" and path.suffix == ".md" else str(path.relative_to("docs"))
    source = ROOT / path
    if not source.exists():
        sys.exit(f"{page}: links to {target}, which is not there")
    if source.is_dir():
        listing = "".join(f"{entry.name}\n" for entry in sorted(source.iterdir()) if entry.name[0] not in "._")
        copy, text = PAGES / "repository" / path / "files.txt", listing
    else:
        copy, text = PAGES / "repository" / path, source.read_text()
        if path.suffix in (".md", ".py", ".sh", ".toml", ".cpp", ".hpp", ".ipynb", ".def", ""):
            copy = copy.with_name(copy.name + ".txt")  # shown by a browser, and no page of MkDocs
    copy.parent.mkdir(parents=True, exist_ok=True)
    copy.write_text(text)
    return str(copy.relative_to(PAGES))


def titles():
    """Title of each page in the navigation of mkdocs.yml."""
    entries = re.findall(r"- ([^:\n]+): ([\w/-]+\.md)$", (ROOT / "mkdocs.yml").read_text(), re.M)
    return {page: title for title, page in entries}


def rewritten(source, on_site):
    """The text of a page with its links as the site has them, a page by its title where it is named by its file; code
    is left."""
    title = titles()
    text, folder = source.read_text(), source.parent.relative_to(ROOT)

    def link(found):
        target = target_on_site(found[2], folder, source.name)
        shown = f"[{title[target]}](" if target in title and found[1] == f"[{found[2]}](" else found[1]
        if "://" not in target and not target.startswith("mailto:"):
            target = os.path.relpath(target, on_site.parent)
        return f"{shown}{target}{found[3] or ''})"

    text = text.replace("<repository>", address() or "<repository>")
    return "".join(part if part.startswith("`") else LINK.sub(link, part) for part in CODE.split(text))


def put(text, on_site, source):
    """Writes a page; `source`: the file to edit."""
    page = PAGES / on_site
    page.parent.mkdir(parents=True, exist_ok=True)
    first = WIDE if str(on_site) == "index.md" else ""
    page.write_text(f"---\n{first}source: {source.relative_to(ROOT)}\n---\n\n{text}")


def gather_notebooks():
    for notebook in sorted((ROOT / "notebooks").glob("*.ipynb")):
        pictures = {"output_files_dir": f"{notebook.stem}_files"}
        text, made = nbconvert.MarkdownExporter().from_filename(notebook, resources=pictures)
        put(text, pathlib.Path("notebooks") / f"{notebook.stem}.md", notebook)
        for name, content in made["outputs"].items():
            (PAGES / "notebooks" / name).parent.mkdir(exist_ok=True)
            (PAGES / "notebooks" / name).write_bytes(content)


def gather():
    shutil.rmtree(PAGES, ignore_errors=True)
    shutil.copytree(ROOT / "docs", PAGES, ignore=shutil.ignore_patterns("*.md", "*.py", "site"))
    docs = ROOT / "docs"
    pages = {page: page.relative_to(docs) for page in (*docs.glob("*.md"), *docs.glob("dev/*.md"))}
    pages |= {ROOT / name: pathlib.Path(on_site) for name, on_site in TEXTS.items()}
    for page, on_site in pages.items():
        put(rewritten(page, on_site), on_site, page)
    gather_notebooks()
    for page in (ROOT / "docs/site").glob("*.md"):
        shutil.copy(page, PAGES)
    shutil.copytree(ROOT / "docs/site", PAGES / "site", ignore=shutil.ignore_patterns("*.md", "theme"))
    (PAGES / "site/fonts").mkdir()
    for name in OF_FONTS:
        shutil.copy(FONTS / name, PAGES / "site/fonts")
    for name in OF_MATHJAX:
        source, copy = MATHJAX / name, PAGES / "mathjax" / name
        copy.parent.mkdir(parents=True, exist_ok=True)
        if source.is_dir():
            shutil.copytree(source, copy)
        else:
            shutil.copy(source, copy)
    (PAGES / "search_index.js").touch()  # MkDocs wants it there; written below


def main():
    if len(sys.argv) > 1:
        print(f"usage: ./barchan docs\n\n{__doc__}")
        return 0 if sys.argv[1] in ("--help", "-h") else 2
    if shutil.which("mkdocs") is None or not MATHJAX.is_dir() or not FONTS.is_dir():
        sys.exit("MkDocs or a part of it is missing: ./barchan setup --docs")
    gather()
    python_path = os.pathsep.join([str(ROOT / "python"), os.environ.get("PYTHONPATH", "")])
    made = subprocess.run(["mkdocs", "build", "--strict", "--clean", "--config-file", ROOT / "mkdocs.yml",
                           "--site-dir", NEW],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          cwd=PAGES,  # in ROOT the API's reader takes the launcher for the package
                          env={**os.environ, "PYTHONPATH": python_path, "BARCHAN_ADDRESS": address()}, check=False)
    told = [line for line in made.stdout.splitlines() if "WARNING" in line or "ERROR" in line or "Abort" in line]
    print(*told, sep="\n", end="\n" if told else "", file=sys.stderr)
    if made.returncode:
        return 1
    # For pages opened as files, which may not fetch it.
    index = json.dumps(json.loads((NEW / "search/search_index.json").read_text()))
    (NEW / "search_index.js").write_text(
        f'if (location.protocol === "file:") window.__search = {{ index: Promise.resolve({index}) }};\n')
    shutil.rmtree(SITE, ignore_errors=True)
    NEW.rename(SITE)
    print(f"the site is in {os.path.relpath(SITE, ROOT)}: open {SITE / 'index.html'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
