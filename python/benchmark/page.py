"""The page docs/benchmark.md and its pictures, made from the folders of benchmark/."""

import textwrap

import numpy as np

from barchan.figures import style
from benchmark import folders, scores
from validation import tables

PAGE = folders.ROOT / "docs/benchmark.md"
PICTURES = folders.ROOT / "docs/benchmark"
COLOURS = style.BLUE, style.VERMILLION, style.GREEN, style.ORANGE


def draw(case, programs, file):
    """Reference with errors and results of each program (name -> curves), one panel for each quantity, as SVG."""
    reference = {name: known for name, known in case.reference.items() if np.isfinite(known.value).any()}
    columns = min(3, len(reference))
    rows = -(-len(reference) // columns)
    figure, panels = style.panels(None, rows, columns, figsize=(style.FULL_WIDTH, 2.3 * rows), layout="constrained")
    flat = np.ravel(panels)
    for axes, (name, known) in zip(flat, reference.items()):
        single = np.isnan(known.at).all()
        at = np.zeros(known.at.size) if single else known.at
        axes.errorbar(at, known.value, known.error, fmt="o", color="0.35", ms=3, capsize=2, lw=0.8, label=known.source)
        for number, (program, curves) in enumerate(programs.items()):
            if name not in curves:
                continue
            own, colour = curves[name], COLOURS[number % len(COLOURS)]
            where = np.full(own.at.size, 0.2 * (number + 1)) if single else own.at
            few = single or own.at.size < 8
            axes.plot(where, own.value, "s" if few else "-", color=colour, ms=4, label=program)
            known_spread = np.isfinite(own.error)
            if known_spread.any():
                low, high = own.value - own.error, own.value + own.error
                if few:
                    axes.vlines(where[known_spread], low[known_spread], high[known_spread], color=colour)
                else:
                    axes.fill_between(where, low, high, color=colour, alpha=0.2, lw=0)
        if single:
            axes.set(xticks=[], xlim=(-0.5, 0.8))
        elif known.at.size > 4:
            axes.set_xlim(0, known.at[-1] * 1.05)
        unit = "" if known.unit in ("", "1") else f" ({known.unit})"
        axes.set_title(name.replace("_", " ") + unit, fontsize=8)
        axes.set_xlabel(known.against)
        axes.legend(fontsize=6)
    for axes in flat[len(reference):]:
        axes.set_visible(False)
    file.parent.mkdir(parents=True, exist_ok=True)
    style.save(figure, file.parent, file.stem, "Barchan, benchmark", kinds=("svg",))


def section(case):
    """Lines about one case."""
    reference = case.reference
    folder = f"../benchmark/{case.name}"
    text = [f"## {case.title}", "", f"`./barchan benchmark {case.name}`. [Statement]({folder}/statement.md),",
            f"[reference]({folder}/reference.csv).", ""]
    kept = {program: case.result(program) for program in case.programs}
    if not kept:
        return [*text, "No program has results yet.", ""]
    text += [f"![Reference and results](benchmark/{case.name}.svg)", "",
             "| quantity | program | distance | bias | points | |", "|---|---|---|---|---|---|"]
    found = {program: scores.scores(reference, curves) for program, (_, curves) in kept.items()}
    for name in next(iter(found.values())):
        for program, of in found.items():
            one = of[name]
            if one.given or program == folders.OWN:
                far = f"{one.distance:.1f} | {one.bias:+.1f}" if one.reached else "- | -"
                points = f"{one.reached} of {one.points}"
                text.append(f"| {name.replace('_', ' ')} | {program} | {far} | {points} | {one.word} |")
    for program, (notes, curves) in kept.items():
        total = scores.total(found[program])
        also = [told(name, curve, reference[name].unit) for name, curve in curves.items()
                if np.isnan(reference[name].value).all()]
        line = (f"**Score of {program}: {total:.1f}**, from {scores.share(found[program])}. "
                f"{notes.get('minutes', '?')} core minutes; "
                f"commit {notes.get('commit', '?')}." + f" Also: {', '.join(also)}." * bool(also))
        text += ["", *textwrap.wrap(line, 120, break_long_words=False, break_on_hyphens=False)]
        remarks = case.result_file(program).with_suffix(".md")
        if remarks.exists():
            text += ["", remarks.read_text(encoding="utf-8").rstrip()]
    return [*text, ""]


def told(name, curve, unit):
    """A single number with its spread."""
    spread = f" +- {curve.error[0]:.2g}" if np.isfinite(curve.error[0]) else ""
    return f"{name.replace('_', ' ')} {curve.value[0]:.3g}{spread} {unit}".rstrip()


def overview():
    """Lines of the table of all scores."""
    rows = ["| case | program | score | core minutes |", "|---|---|---|---|"]
    for case in map(folders.find, folders.names()):
        for program in case.programs:
            minutes, total = case.result(program)[0].get("minutes", "?"), total_of(case, program)
            rows.append(f"| [{case.name}](#{anchor(case.title)}) | {program} | {total:.1f} | {minutes} |")
    return rows


def total_of(case, program):
    """The score of a program that has results for a case."""
    return scores.total(scores.scores(case.reference, case.result(program)[1]))


def anchor(title):
    return "".join(letter for letter in title.lower().replace(" ", "-") if letter.isalnum() or letter == "-")


def text():
    """The page."""
    lines = ["<!-- Made by ./barchan benchmark --keep from benchmark/; do not edit. -->", "# Benchmark", "",
             "Six cases that any program can compute, and how far each is from what was measured, in errors of the",
             "reference ([statements, score, how to take part](../benchmark/README.md)).", "", *overview(), ""]
    for case in map(folders.find, folders.names()):
        lines += section(case)
    return "\n".join(lines).rstrip() + "\n"


def write():
    """Makes page and pictures again; the page's path."""
    for case in map(folders.find, folders.names()):
        if case.programs:
            draw(case, {program: case.result(program)[1] for program in case.programs}, PICTURES / f"{case.name}.svg")
    PAGE.write_text(text(), encoding="utf-8")
    return PAGE.relative_to(tables.ROOT)
